#pragma once
// A glTF 2.0 document as plain data: what the scenes fill in and `glb_writer` writes down.

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gridreel::gallery {

using Id = std::uint32_t;  ///< into one of the vectors of `Document`

/// glTF's componentType numbers.
enum class Component : int { u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

/// What the bytes are for: the target of their buffer view.
enum class Use { vertices, indices, data };

/// Packed little-endian elements, each a multiple of 4 bytes except indices. One buffer view each.
struct Accessor {
    Component component = Component::f32;
    std::string type = "SCALAR";  ///< SCALAR, VEC3, VEC4 or MAT4
    bool normalized = false;
    Use use = Use::data;
    std::size_t count = 0;
    std::vector<std::byte> bytes{};
    std::vector<double> min{}, max{};  ///< per component, or empty
};

using Attributes = std::vector<std::pair<std::string, Id>>;  ///< semantic, accessor

/// A mesh of one primitive.
struct Mesh {
    std::string name{};
    Attributes attributes{};
    Id indices = 0;
    Id material = 0;
    std::vector<Attributes> targets{};  ///< morph targets
    std::vector<double> weights{};      ///< of the targets at rest; empty: all zero
};

/// Linear RGB. `glow` is an emission of that many times the base colour: the scenes' soft fill light.
struct Material {
    std::string name{};
    glm::dvec3 base_color{1.0};
    double metallic = 0.0;
    double roughness = 0.6;
    double glow = 0.05;
    bool double_sided = false;
};

struct Camera {
    double fov_y_rad = 0.6;
    double aspect = 16.0 / 9.0;
    double near_m = 0.1;
    double far_m = 100.0;
};

struct PointLight {
    std::string name{};
    glm::dvec3 color{1.0};       ///< linear RGB
    double intensity_cd = 10.0;  ///< candela
};

struct Node {
    std::string name{};
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< w, x, y, z
    std::vector<Id> children{};
    std::optional<Id> mesh{}, skin{}, camera{}, light{};
};

struct Skin {
    std::vector<Id> joints{};  ///< nodes; the first is the root of the skeleton
    Id inverse_bind = 0;
};

enum class Interpolation { linear, cubic_spline };
enum class Path { translation, rotation, weights };

struct Channel {
    Id node = 0;
    Path path = Path::translation;
    Id times = 0;   ///< accessor
    Id values = 0;  ///< accessor
    Interpolation interpolation = Interpolation::linear;
};

/// One scene, whose roots are the nodes without a parent, and one animation.
struct Document {
    std::string name{};  ///< of the scene and its animation
    std::vector<Accessor> accessors{};
    std::vector<Mesh> meshes{};
    std::vector<Material> materials{};
    std::vector<Camera> cameras{};
    std::vector<PointLight> lights{};
    std::vector<Skin> skins{};
    std::vector<Node> nodes{};
    std::vector<Channel> channels{};
};

/// Appends and returns the new element's index.
template <typename T>
Id append(std::vector<T>& list, T element) {
    list.push_back(std::move(element));
    return static_cast<Id>(list.size() - 1);
}

/// Triangles shown: every node counts its mesh.
[[nodiscard]] std::size_t triangle_count(const Document& document);

}  // namespace gridreel::gallery
