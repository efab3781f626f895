#pragma once
// Small scenes built in memory, and pictures of them.

#include "anim/scene.h"
#include "engine/film.h"
#include "engine/frame_renderer.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <string>

namespace gridreel::test {

/// A scene whose things all stand at the root. Every `add_` returns the new thing's index.
struct SceneBuilder {
    anim::Scene scene;

    SceneBuilder() { scene.scenes.resize(1); }

    anim::Index add_node(const anim::Node& node);
    anim::Index add_material(const anim::Material& material);

    /// A node with a mesh of one primitive; returns the node.
    anim::Index add_mesh(anim::Primitive primitive, const glm::dmat4& world = glm::dmat4(1.0));

    anim::Index add_light(const anim::Light& light, const glm::dvec3& position = glm::dvec3(0.0));

    /// A perspective camera with its eye at `eye` that looks at `target`, +y up or +z where that is the view.
    anim::Index add_camera(const glm::dvec3& eye, const glm::dvec3& target, double fov_y_rad);

    /// An orthographic camera of the given half height.
    anim::Index add_orthographic(const glm::dvec3& eye, const glm::dvec3& target, double half_height);
};

/// Two triangles a, b, c and a, c, d, counter-clockwise seen from their front; texture corners
/// (0,0) (1,0) (1,1) (0,1). Flat.
[[nodiscard]] anim::Primitive quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                                   const glm::vec3& d);

/// A quad in the plane y, facing up, spanning [-half, half] on x and z.
[[nodiscard]] anim::Primitive floor(float y, float half);

/// A closed sphere of latitude rings, smooth or flat.
[[nodiscard]] anim::Primitive sphere(const glm::vec3& center, float radius, int rings, bool smooth);

/// A closed box, flat.
[[nodiscard]] anim::Primitive box(const glm::vec3& low, const glm::vec3& high);

[[nodiscard]] anim::Material matte(const glm::vec3& color);

/// 32 x 32 pixels, one sample, background black and transparent, the file's lights, traced naively.
[[nodiscard]] engine::RenderSettings small_picture();

[[nodiscard]] engine::Film render(const anim::Scene& scene, const engine::RenderSettings& settings);

}  // namespace gridreel::test
