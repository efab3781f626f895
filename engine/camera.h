#pragma once
// From a picture's pixels to rays in the world.

#include "anim/scene.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string_view>

namespace gridreel::engine {

/// The camera of one frame. The picture plane lies one metre before the eye (perspective) or through it
/// (orthographic); rays advance one metre along the view axis per unit of t, so t is the depth Z.
///
/// Vertical extent is the file's; the horizontal one follows from the picture, so pixels are square and a
/// picture of another shape than the camera's shows more or less at the sides.
struct View {
    anim::Camera::Kind kind = anim::Camera::Kind::perspective;
    glm::dvec3 eye{0.0};
    glm::dvec3 right{1.0, 0.0, 0.0}, up{0.0, 1.0, 0.0}, forward{0.0, 0.0, -1.0};  ///< orthonormal
    double half_width = 1.0, half_height = 1.0;  ///< of the picture plane, metres
    double near_m = 0.0, far_m = 0.0;            ///< along the view axis; far may be infinite
    double pixels_down = 1.0;                    ///< the picture's height

    /// Point of the picture plane relative to the eye; `place` in pixels from the top left corner.
    [[nodiscard]] glm::dvec3 on_picture_plane(const glm::dvec2& place) const;

    [[nodiscard]] glm::vec3 ray_origin(const glm::dvec2& place) const;
    [[nodiscard]] glm::vec3 ray_direction(const glm::dvec2& place) const;

    /// Distance of a point from the eye along the view axis, metres.
    [[nodiscard]] double depth(const glm::dvec3& point) const;

    /// Unit vector from `point` towards the viewer.
    [[nodiscard]] glm::vec3 towards_viewer(const glm::dvec3& point) const;

    /// Width of a pixel at a depth, metres: how wide the cone of a camera ray has grown.
    [[nodiscard]] double pixel_width(double depth) const;
};

/// The view of a camera node.
///
/// The node's scale and shear are ignored, only its place, its -z and its +y count (glTF 2.0, section 3.10).
///
/// @param world          the camera node's world matrix
/// @param width, height  of the picture, pixels
/// @param node           what errors call the node
/// @throws Error when the matrix has no direction left (a scale of zero)
[[nodiscard]] View view_of(const anim::Camera& camera, const glm::dmat4& world, std::int32_t width,
                           std::int32_t height, std::string_view node = {});

}  // namespace gridreel::engine
