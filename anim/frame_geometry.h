#pragma once
// The world-space triangles of one pose.

#include "anim/clip.h"
#include "anim/deform_scratch.h"
#include "anim/pose.h"
#include "anim/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace gridreel::anim {

/// One primitive of one node, or of one of its instances: a run of vertices and triangles in `FrameGeometry`.
struct Part {
    Index node = 0;
    Index mesh = 0;
    Index primitive = 0;              ///< into `Mesh::primitives`
    std::optional<Index> instance{};  ///< into `Node::instances`
    std::optional<Index> material;
    std::size_t first_vertex = 0, vertex_count = 0;
    std::size_t first_triangle = 0, triangle_count = 0;  ///< none while it is hidden
    bool skinned = false;  ///< joints place its vertices, and its node's own matrix is ignored
    bool moves = false;    ///< its vertices can differ between two times of the clip
    bool blinks = false;   ///< is shown at some times of the clip only
    bool smooth = false;   ///< has vertex normals; otherwise shade with the triangle's own
    bool has_tangents = false;
    std::array<bool, 2> has_texcoords{};
    bool has_colors = false;
};

/// What the file says of the part.
[[nodiscard]] const Primitive& primitive_of(const Scene& scene, const Part& part);

/// World-space triangles of one pose, all parts one after another: nodes depth first in file order, a node's
/// instances in order, primitives in file order, vertices in accessor order. Parts that are hidden at the
/// time keep their vertices but have no triangles; those that are never shown are left out. Buffers are laid
/// out once and reused.
struct FrameGeometry {
    std::vector<glm::vec3> positions;  ///< world space, metres
    std::vector<glm::vec3> normals;    ///< world space, unit length; zero where a part is not smooth
    std::vector<glm::vec4> tangents;   ///< world space, w handedness; empty when no part has any
    /// Per vertex, zero where absent; empty when no part has any.
    std::array<std::vector<glm::vec2>, 2> texcoords;
    std::vector<glm::vec4> colors;             ///< per vertex, white where absent; empty when no part has any
    std::vector<glm::uvec3> triangles;         ///< into `positions`; wound as in the file, mirrored or not
    std::vector<std::uint32_t> triangle_part;  ///< into `parts`, one per triangle
    std::vector<Part> parts;
    /// One per part: its node's matrix (of a skinned part, most of its joints') has a negative
    /// determinant, so the front is where the winding is clockwise.
    std::vector<bool> mirrored;
    std::vector<bool> is_shown;  ///< one per part: its triangles are listed
    bool posed = false;          ///< `deform` has run once: still parts are in place
    DeformScratch scratch;       ///< for `deform` alone

    [[nodiscard]] std::size_t moving_triangles() const;
};

/// The buffers for a clip; positions come with `deform`. Throws Error for too much memory (frame_size.h).
[[nodiscard]] FrameGeometry lay_out(const Scene& scene, const Clip& clip);

/// Lists the triangles of all parts that `is_shown` for (one flag per part), in the order of parts.
void list_triangles(const Scene& scene, const std::vector<bool>& is_shown, FrameGeometry& geometry);

/// Writes the world-space vertices of `pose` into `geometry`, in parallel, and the triangles of the parts
/// that it shows.
///
/// Morph targets before skins before the node's matrix (glTF 2.0, section 3.7.3); a skinned part
/// ignores its own node's matrix. The first call fills every part, later ones only those that move.
/// Bit-identical for any number of threads; allocates nothing once warm.
///
/// @param geometry  from `lay_out` of the same scene and the clip that `pose` was made with
void deform(const Scene& scene, const Pose& pose, FrameGeometry& geometry);

}  // namespace gridreel::anim
