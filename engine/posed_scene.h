#pragma once
// Everything shading reads of one frame.

#include "anim/frame_geometry.h"
#include "anim/pose.h"
#include "anim/scene.h"
#include "engine/textures.h"

#include <cstdint>

namespace gridreel::engine {

/// One frame's triangles with their looks. All that it refers to outlives it.
struct PosedScene {
    const anim::FrameGeometry& geometry;
    const anim::Pose& pose;
    const Textures& textures;

    [[nodiscard]] const anim::Part& part_of(std::uint32_t triangle) const {
        return geometry.parts[geometry.triangle_part[triangle]];
    }

    /// The triangle's material as posed; glTF's default where it names none.
    [[nodiscard]] const anim::Material& material_of(std::uint32_t triangle) const {
        static const anim::Material plain;
        const auto& material = part_of(triangle).material;
        return material ? pose.materials[*material] : plain;
    }
};

}  // namespace gridreel::engine
