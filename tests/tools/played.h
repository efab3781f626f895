#pragma once
// A scene of the generator as the renderer sees it: written, read back, played.

#include "anim/clip.h"
#include "anim/frame_geometry.h"
#include "anim/load.h"
#include "anim/pose.h"
#include "anim/scene.h"
#include "tools/gallery/document.h"
#include "tools/gallery/glb_writer.h"

#include <glm/vec3.hpp>

#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace gridreel::gallery {

class Played {
public:
    explicit Played(const Document& document) : Played(bytes_of(document)) {}

    explicit Played(const std::string& glb)
        : scene_(anim::load_bytes(std::as_bytes(std::span(glb)), "played.glb")),
          clip_(anim::choose_clip(scene_)),
          geometry_(anim::lay_out(scene_, clip_)) {}

    [[nodiscard]] double duration_s() const { return clip_.duration_s; }
    [[nodiscard]] const anim::Scene& scene() const { return scene_; }
    [[nodiscard]] const std::vector<glm::uvec3>& triangles() const { return geometry_.triangles; }

    [[nodiscard]] const std::vector<anim::Part>& parts() const { return geometry_.parts; }

    /// World positions at a time, one per vertex.
    [[nodiscard]] std::vector<glm::vec3> positions(double time_s) {
        anim::deform(scene_, anim::pose(scene_, clip_, time_s), geometry_);
        return {geometry_.positions.begin(), geometry_.positions.end()};
    }

    /// How many triangles have all their corners where they were, from one time to another.
    [[nodiscard]] std::size_t standing_still(double from_s, double to_s) {
        const auto before = positions(from_s), after = positions(to_s);
        std::size_t still = 0;
        for (const glm::uvec3& t : triangles())
            if (before[t.x] == after[t.x] && before[t.y] == after[t.y] && before[t.z] == after[t.z]) ++still;
        return still;
    }

private:
    static std::string bytes_of(const Document& document) {
        std::ostringstream out;
        write_glb(document, out);
        return out.str();
    }

    anim::Scene scene_;
    anim::Clip clip_;
    anim::FrameGeometry geometry_;
};

}  // namespace gridreel::gallery
