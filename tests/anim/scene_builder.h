#pragma once
// Small scenes, built in memory.

#include "anim/clip.h"
#include "anim/frame_geometry.h"
#include "anim/scene.h"

#include <glm/vec3.hpp>

#include <initializer_list>
#include <optional>
#include <vector>

namespace gridreel::anim::testing {

/// No nodes, and one scene to put them in.
[[nodiscard]] Scene empty_scene();

/// Adds a node under `parent`; one without a parent becomes a root of scene 0.
Index add_node(Scene& scene, Node node, std::optional<Index> parent = {});

/// Adds a root that belongs to no scene of the file.
Index add_hidden_root(Scene& scene, Node node);

/// A node with this transform, and this mesh if any.
[[nodiscard]] Node placed(const Trs& trs, std::optional<Index> mesh = {});

/// Adds a mesh of one primitive; default morph weights zero unless given.
Index add_mesh(Scene& scene, Primitive primitive, std::vector<float> weights = {});

/// Adds a skin, inverse bind matrices identity unless given.
Index add_skin(Scene& scene, std::vector<Index> joints, std::vector<glm::dmat4> inverse_bind = {});

/// Vertices without triangles or normals.
[[nodiscard]] Primitive points(std::vector<glm::vec3> positions);

/// The triangle (0,0,0) (1,0,0) (0,1,0) with normals along +z.
[[nodiscard]] Primitive triangle();

/// A target that displaces positions only.
[[nodiscard]] MorphTarget shift(std::vector<glm::vec3> positions);

/// Gives every vertex of `primitive` the same influences.
void bind(Primitive& primitive, std::vector<std::uint16_t> joints, std::vector<float> weights);

/// Keys of `width` numbers each (three times as many for cubic splines).
[[nodiscard]] Sampler keys(Interpolation interpolation, std::uint32_t width, std::vector<float> times_s,
                           std::vector<float> values);

/// Adds an empty animation.
Index add_animation(Scene& scene, std::string name = {});

/// Lets `sampler` drive a property of `node` in `animation`.
void drive(Scene& scene, Index animation, Index node, ChannelPath path, Sampler sampler);

/// Where `node` is moved to, with no rotation or scale.
[[nodiscard]] Trs moved(double x, double y, double z);
[[nodiscard]] Trs scaled(double x, double y, double z);
/// Turned by `degrees` about `axis`, counterclockwise seen from the axis' tip.
[[nodiscard]] Trs turned(double degrees, const glm::dvec3& axis);

/// Everything that plays under "all", at `time_s`, into a new geometry.
[[nodiscard]] FrameGeometry frame_at(const Scene& scene, double time_s);

/// Largest difference of any component; infinity when one is NaN.
[[nodiscard]] double distance(const glm::vec3& a, const glm::vec3& b);
[[nodiscard]] double distance(const glm::vec4& a, const glm::vec4& b);
[[nodiscard]] double distance(const glm::dvec3& a, const glm::dvec3& b);
[[nodiscard]] double distance(const glm::dmat4& a, const glm::dmat4& b);

}  // namespace gridreel::anim::testing
