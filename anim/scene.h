#pragma once
// What a glTF file says, as plain immutable data. Everything is checked: every index in here is in range.

#include "anim/index.h"
#include "anim/material.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace gridreel::anim {

// --- Nodes -------------------------------------------------------------------------------------

/// A node's local transform as translation, rotation and scale (glTF 2.0, section 3.5.3).
struct Trs {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< w, x, y, z; need not be unit length in the file
    glm::dvec3 scale{1.0};
};

struct Node {
    std::string name;
    std::optional<Index> parent;
    std::vector<Index> children;
    Trs trs;                           ///< ignored when `matrix` is set
    std::optional<glm::dmat4> matrix;  ///< such a node cannot be animated
    std::optional<Index> mesh;
    std::optional<Index> skin;
    std::optional<Index> camera;
    std::optional<Index> light;
    std::vector<float> weights;  ///< one per morph target of `mesh`, or empty: the mesh's own
    bool visible = true;         ///< at rest; false hides the nodes below it, too (KHR_node_visibility)
    /// Where copies of `mesh` stand, seen from the node (EXT_mesh_gpu_instancing); empty: one, at the node.
    std::vector<Trs> instances;
};

// --- Meshes ------------------------------------------------------------------------------------

/// Displacements of one morph target. Each vector is empty or has one entry per vertex.
struct MorphTarget {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> tangents;
};

/// Joint influences of every vertex, all JOINTS_n/WEIGHTS_n pairs side by side; weights sum to 1.
struct Influences {
    std::uint32_t per_vertex = 0;       ///< 4, 8, …; 0: no JOINTS_n
    std::vector<std::uint16_t> joints;  ///< vertex-major, index into `Skin::joints`
    std::vector<float> weights;         ///< vertex-major
};

/// A material that takes the place of a primitive's own in one variant of the file.
struct VariantMaterial {
    Index variant = 0;  ///< into `Scene::variants`
    Index material = 0;
};

/// One primitive; strips and fans are taken apart as in glTF 2.0, section 3.7.2.1.
/// Points and lines are not kept (a warning says so).
struct Primitive {
    std::vector<glm::vec3> positions;  ///< every vertex of POSITION, used or not, in accessor order
    std::vector<glm::vec3> normals;    ///< per vertex; empty: flat shading, as section 3.7.2.1 asks
    std::vector<glm::vec4> tangents;   ///< per vertex, w is the handedness; or empty
    std::array<std::vector<glm::vec2>, 2> texcoords;  ///< TEXCOORD_0 and _1, each per vertex or empty
    std::vector<glm::vec4> colors;                    ///< COLOR_0, linear RGBA; per vertex or empty
    std::vector<glm::uvec3> triangles;
    Influences influences;
    std::vector<MorphTarget> targets;
    std::optional<Index> material;                   ///< absent: `Material{}`
    std::vector<VariantMaterial> variant_materials;  ///< at most one for each variant
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<float> weights;  ///< default morph weights, one per target (zeros when the file has none)
};

struct Skin {
    std::string name;
    std::vector<Index> joints;             ///< nodes
    std::vector<glm::dmat4> inverse_bind;  ///< one per joint; identity when the file has none
};

// --- Animation ---------------------------------------------------------------------------------

enum class Interpolation { step, linear, cubic_spline };

/// What a channel drives: something of a node, or a value of a camera, a light or a material.
enum class ChannelPath {
    translation,
    rotation,
    scale,
    weights,     ///< all morph weights of a node
    weight,      ///< one of them
    visibility,  ///< of a node; what is not zero shows it
    camera,
    light,
    material,
};

/// Keys of one animated property (glTF 2.0, section 3.11 and appendix C).
struct Sampler {
    std::vector<float> times_s;  ///< strictly increasing, at least one
    std::vector<float> values;   ///< per key: `width` numbers, or in-tangent, value, out-tangent (cubic)
    std::uint32_t width = 0;     ///< numbers per key: 3, 4 (x, y, z, w), the number of morph targets, …
    Interpolation interpolation = Interpolation::linear;
};

struct Channel {
    Index object = 0;  ///< node, camera, light or material, as `path` says
    ChannelPath path = ChannelPath::translation;
    /// Which value of a camera, light or material (into its list in animated_properties.h), or which weight.
    Index property = 0;
    Index sampler = 0;     ///< into `Animation::samplers`
    bool of_mesh = false;  ///< weights of the node's mesh, which the node's own take the place of
};

struct Animation {
    std::string name;
    std::vector<Sampler> samplers;
    std::vector<Channel> channels;
};

// --- Looks -------------------------------------------------------------------------------------

/// A camera looks down its node's -z, y up.
struct Camera {
    enum class Kind { perspective, orthographic };
    std::string name;
    Kind kind = Kind::perspective;
    double fov_y_rad = 0.8;           ///< perspective
    std::optional<double> aspect;     ///< perspective, width / height; absent: the picture's
    double x_mag = 1.0, y_mag = 1.0;  ///< orthographic: half width and height, metres
    double near_m = 0.0;
    double far_m = std::numeric_limits<double>::infinity();
};

/// KHR_lights_punctual. Shines along its node's -z.
struct Light {
    enum class Kind { directional, point, spot };
    std::string name;
    Kind kind = Kind::point;
    glm::vec3 color{1.0f};   ///< linear RGB
    float intensity = 1.0f;  ///< candela (point, spot) or lux (directional)
    std::optional<float> range_m;
    float inner_cone_rad = 0.0f;
    float outer_cone_rad = 0.785398163f;
};

enum class Wrap { repeat, mirrored_repeat, clamp_to_edge };
enum class Filter { nearest, linear };
enum class MipFilter { none, nearest, linear };

/// An image as it stands in the file; `engine` decodes it.
struct Image {
    std::string name;                ///< the file's name for it, for messages
    std::string mime_type;           ///< may be empty
    std::vector<std::byte> encoded;  ///< empty: it could not be read (a warning says so)
};

struct Texture {
    std::optional<Index> image;
    Wrap wrap_s = Wrap::repeat, wrap_t = Wrap::repeat;
    Filter mag_filter = Filter::linear, min_filter = Filter::linear;
    MipFilter mip_filter = MipFilter::linear;
};

// --- The file ----------------------------------------------------------------------------------

/// Something the reader did not, or not wholly, honour; never silent.
struct Warning {
    std::string where;  ///< JSON pointer
    std::string text;
};

struct Scene {
    std::string name;  ///< the file's stem
    std::vector<Node> nodes;
    std::vector<Mesh> meshes;
    std::vector<Skin> skins;
    std::vector<Animation> animations;
    std::vector<Camera> cameras;
    std::vector<Light> lights;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<Image> images;
    std::vector<std::string> variants;       ///< names (KHR_materials_variants); see `show_variant`
    std::vector<std::vector<Index>> scenes;  ///< root nodes of each scene; at least one scene
    Index default_scene = 0;
    std::vector<std::string> extensions_used;
    std::vector<std::string> extensions_required;
    std::vector<std::string> extensions_supported;  ///< of those used: the ones that pictures show in full
    std::vector<Warning> warnings;
};

}  // namespace gridreel::anim
