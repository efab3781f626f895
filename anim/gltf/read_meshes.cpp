#include "anim/gltf/read_meshes.h"

#include "anim/gltf/influences.h"
#include "anim/gltf/triangles.h"

#include <fmt/format.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <set>

namespace gridreel::anim::gltf {
namespace {

enum class NotFinite { refused, becomes_zero };

/// Not-a-numbers and infinities would reach every pixel: in positions they are refused, in attributes that
/// only colour the picture they become zero, with a warning.
void check_finite(std::span<float> values, NotFinite policy, Document& document, const Place& place) {
    std::size_t bad = 0;
    for (float& value : values) {
        if (std::isfinite(value)) continue;
        if (policy == NotFinite::refused)
            place.refuse(fmt::format("component {} is {}", &value - values.data(), value));
        value = 0.0f;
        ++bad;
    }
    if (bad > 0) document.warn(place, fmt::format("{} components are not finite and were set to zero", bad));
}

/// An attribute as vectors of the accessor's own size.
template <class Vector>
std::vector<Vector> read_vectors(Document& document, const Place& place, NotFinite policy) {
    auto values = document.floats(place.index(), place);
    check_finite(values, policy, document, place);
    static_assert(sizeof(Vector) == Vector::length() * sizeof(float));
    document.budget().spend(values.size() * sizeof(float), place);
    std::vector<Vector> vectors(values.size() / Vector::length());
    std::memcpy(vectors.data(), values.data(), values.size() * sizeof(float));
    return vectors;
}

template <class Vector>
std::vector<Vector> read_optional(Document& document, const Place& attributes, std::string_view name,
                                  NotFinite policy) {
    const auto place = attributes.find(name);
    return place ? read_vectors<Vector>(document, *place, policy) : std::vector<Vector>{};
}

std::vector<glm::vec4> read_colors(Document& document, const Place& attributes) {
    const auto place = attributes.find("COLOR_0");
    if (!place) return {};
    if (document.accessors()[place->index()].is("VEC4"))
        return read_vectors<glm::vec4>(document, *place, NotFinite::becomes_zero);

    const auto opaque = read_vectors<glm::vec3>(document, *place, NotFinite::becomes_zero);
    std::vector<glm::vec4> colors;
    colors.reserve(opaque.size());
    for (const glm::vec3& color : opaque) colors.emplace_back(color, 1.0f);
    return colors;
}

std::vector<std::uint32_t> read_indices(Document& document, const Place& primitive,
                                        std::size_t vertex_count) {
    const auto place = primitive.find("indices");
    if (!place) {
        document.budget().spend(vertex_count * sizeof(std::uint32_t), primitive);
        std::vector<std::uint32_t> indices(vertex_count);
        std::iota(indices.begin(), indices.end(), 0u);
        return indices;
    }

    auto indices = document.integers(place->index(), *place);
    const auto type = document.accessors()[place->index()].component;
    const auto restart = static_cast<std::uint32_t>((std::uint64_t{1} << 8 * byte_count(type)) - 1);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] == restart)
            place->refuse(
                fmt::format("index {} is {}, the primitive restart value, which glTF forbids", i, restart));
        if (indices[i] >= vertex_count)
            place->refuse(fmt::format("index {} is {}, but the primitive has {} vertices", i, indices[i],
                                      vertex_count));
    }
    return indices;
}

std::vector<MorphTarget> read_targets(Document& document, const Place& primitive, const Primitive& base) {
    std::vector<MorphTarget> targets;
    const auto places = primitive.find("targets");
    for (std::size_t i = 0; places && i < places->size(); ++i) {
        const Place place = (*places)[i];
        MorphTarget& target = targets.emplace_back();
        target.positions = read_optional<glm::vec3>(document, place, "POSITION", NotFinite::refused);
        // A displacement of something that is not there displaces nothing.
        if (!base.normals.empty())
            target.normals = read_optional<glm::vec3>(document, place, "NORMAL", NotFinite::becomes_zero);
        if (!base.tangents.empty())
            target.tangents = read_optional<glm::vec3>(document, place, "TANGENT", NotFinite::becomes_zero);
    }
    return targets;
}

/// KHR_materials_variants. Where two mappings name one variant, which the extension forbids, the first
/// counts.
std::vector<VariantMaterial> read_variant_materials(const Place& place) {
    std::vector<VariantMaterial> materials;
    const auto extension = place.find_extension("KHR_materials_variants");
    if (!extension) return materials;
    const Place mappings = extension->at("mappings");
    std::set<Index> mapped;
    for (std::size_t i = 0; i < mappings.size(); ++i) {
        const Place variants = mappings[i].at("variants");
        for (std::size_t k = 0; k < variants.size(); ++k)
            if (mapped.insert(variants[k].index()).second)
                materials.push_back(
                    {.variant = variants[k].index(), .material = mappings[i].at("material").index()});
    }
    return materials;
}

/// Absent, with a warning, for what cannot be drawn as triangles.
std::optional<Primitive> read_primitive(Document& document, const Place& place) {
    const auto topology = static_cast<Topology>(place.integer_or("mode", 4));
    const Place attributes = place.at("attributes");
    const auto position = attributes.find("POSITION");
    if (!position) {
        document.warn(place, "the primitive has no positions and is not drawn");
        return {};
    }
    const auto indices = read_indices(document, place, document.accessors()[position->index()].count);
    if (!has_triangles(topology)) {
        document.warn(place, "points and lines are not drawn");
        return {};
    }

    Primitive primitive;
    primitive.positions = read_vectors<glm::vec3>(document, *position, NotFinite::refused);
    primitive.normals = read_optional<glm::vec3>(document, attributes, "NORMAL", NotFinite::becomes_zero);
    // Without normals the triangles are flat, and tangents are to be ignored (section 3.7.2.1).
    if (!primitive.normals.empty())
        primitive.tangents =
            read_optional<glm::vec4>(document, attributes, "TANGENT", NotFinite::becomes_zero);
    for (std::size_t set = 0; set < primitive.texcoords.size(); ++set)
        primitive.texcoords[set] = read_optional<glm::vec2>(
            document, attributes, fmt::format("TEXCOORD_{}", set), NotFinite::becomes_zero);
    primitive.colors = read_colors(document, attributes);
    primitive.influences = read_influences(document, attributes);
    primitive.targets = read_targets(document, place, primitive);
    primitive.material = place.find_index("material");
    primitive.variant_materials = read_variant_materials(place);

    if (!is_whole(topology, indices.size()))
        document.warn(place, fmt::format("{} indices do not make whole triangles", indices.size()));
    document.budget().spend(indices.size() * sizeof(glm::uvec3), place);
    primitive.triangles = assemble_triangles(topology, indices);
    return primitive;
}

std::vector<float> default_weights(const Place& mesh) {
    std::vector<float> weights(mesh.at("primitives", 0).count("targets"), 0.0f);
    if (const auto stated = mesh.find("weights"))
        for (std::size_t i = 0; i < stated->size(); ++i)
            weights[i] = static_cast<float>((*stated)[i].number());
    return weights;
}

}  // namespace

std::vector<Mesh> read_meshes(Document& document) {
    std::vector<Mesh> meshes;
    for (const Place& place : document.all("meshes")) {
        Mesh& mesh = meshes.emplace_back();
        mesh.name = place.text_or("name", "");
        mesh.weights = default_weights(place);
        const Place primitives = place.at("primitives");
        for (std::size_t i = 0; i < primitives.size(); ++i)
            if (auto primitive = read_primitive(document, primitives[i]))
                mesh.primitives.push_back(std::move(*primitive));
    }
    return meshes;
}

void pay_for_morph_weights(Document& document, const Scene& scene) {
    constexpr std::size_t poses = 4;  // at rest, at the time, and of frames that are rendered meanwhile
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const auto mesh = scene.nodes[i].mesh;
        if (!mesh || scene.meshes[*mesh].weights.empty()) continue;
        document.budget().spend(scene.meshes[*mesh].weights.size() * poses * sizeof(float),
                                document.root().at("nodes", i));
    }
}

}  // namespace gridreel::anim::gltf
