#include "tools/gallery/glb_writer.h"

#include "anim/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <ostream>
#include <stdexcept>

namespace gridreel::gallery {

namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "accessors are written as they lie in memory");

std::size_t padded(std::size_t bytes) {
    return (bytes + 3) / 4 * 4;
}

Json to_json(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json to_json(const Attributes& attributes) {
    Json json = Json::object();
    for (const auto& [semantic, accessor] : attributes) json[semantic] = accessor;
    return json;
}

// --- Data ----------------------------------------------------------------------------------------

void add_accessors(Json& root, const Document& document) {
    std::size_t offset = 0;
    for (Id id = 0; id < document.accessors.size(); ++id) {
        const Accessor& accessor = document.accessors[id];
        Json view{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", accessor.bytes.size()}};
        if (accessor.use == Use::vertices) view["target"] = 34962;
        if (accessor.use == Use::indices) view["target"] = 34963;
        root["bufferViews"].push_back(std::move(view));
        offset += padded(accessor.bytes.size());

        Json json{{"bufferView", id},
                  {"componentType", static_cast<int>(accessor.component)},
                  {"count", accessor.count},
                  {"type", accessor.type}};
        if (accessor.normalized) json["normalized"] = true;
        if (!accessor.min.empty()) {
            json["min"] = accessor.min;
            json["max"] = accessor.max;
        }
        root["accessors"].push_back(std::move(json));
    }
    root["buffers"] = Json::array({{{"byteLength", offset}}});
}

// --- Looks ---------------------------------------------------------------------------------------

void add_looks(Json& root, const Document& document) {
    for (const Material& material : document.materials) {
        Json json{
            {"name", material.name},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {material.base_color.x, material.base_color.y, material.base_color.z, 1.0}},
              {"metallicFactor", material.metallic},
              {"roughnessFactor", material.roughness}}}};
        if (material.glow > 0.0) json["emissiveFactor"] = to_json(material.base_color * material.glow);
        if (material.double_sided) json["doubleSided"] = true;
        root["materials"].push_back(std::move(json));
    }
    for (const Camera& camera : document.cameras)
        root["cameras"].push_back({{"type", "perspective"},
                                   {"perspective",
                                    {{"aspectRatio", camera.aspect},
                                     {"yfov", camera.fov_y_rad},
                                     {"znear", camera.near_m},
                                     {"zfar", camera.far_m}}}});
    for (const PointLight& light : document.lights)
        root["extensions"]["KHR_lights_punctual"]["lights"].push_back({{"name", light.name},
                                                                       {"type", "point"},
                                                                       {"color", to_json(light.color)},
                                                                       {"intensity", light.intensity_cd}});
}

// --- Shapes and nodes ----------------------------------------------------------------------------

void add_meshes(Json& root, const Document& document) {
    for (const Mesh& mesh : document.meshes) {
        Json primitive{
            {"attributes", to_json(mesh.attributes)}, {"indices", mesh.indices}, {"material", mesh.material}};
        for (const Attributes& target : mesh.targets) primitive["targets"].push_back(to_json(target));
        Json json{{"name", mesh.name}, {"primitives", Json::array({std::move(primitive)})}};
        if (!mesh.weights.empty())
            json["weights"] = mesh.weights;
        else if (!mesh.targets.empty())
            json["weights"] = std::vector<int>(mesh.targets.size(), 0);
        root["meshes"].push_back(std::move(json));
    }
    for (const Skin& skin : document.skins)
        root["skins"].push_back({{"inverseBindMatrices", skin.inverse_bind},
                                 {"skeleton", skin.joints.front()},
                                 {"joints", skin.joints}});
}

void add_nodes(Json& root, const Document& document) {
    std::vector<bool> is_child(document.nodes.size(), false);
    for (const Node& node : document.nodes) {
        Json json{{"name", node.name}};
        if (node.translation != glm::dvec3(0.0)) json["translation"] = to_json(node.translation);
        const glm::dquat& q = node.rotation;
        if (q != glm::dquat(1.0, 0.0, 0.0, 0.0)) json["rotation"] = {q.x, q.y, q.z, q.w};
        if (!node.children.empty()) json["children"] = node.children;
        for (const Id child : node.children) is_child[child] = true;
        if (node.mesh) json["mesh"] = *node.mesh;
        if (node.skin) json["skin"] = *node.skin;
        if (node.camera) json["camera"] = *node.camera;
        if (node.light) json["extensions"]["KHR_lights_punctual"]["light"] = *node.light;
        root["nodes"].push_back(std::move(json));
    }
    Json roots = Json::array();
    for (Id id = 0; id < document.nodes.size(); ++id)
        if (!is_child[id]) roots.push_back(id);
    root["scene"] = 0;
    root["scenes"] = Json::array({{{"name", document.name}, {"nodes", std::move(roots)}}});
}

const char* name_of(Path path) {
    switch (path) {
        case Path::translation:
            return "translation";
        case Path::rotation:
            return "rotation";
        case Path::weights:
            return "weights";
    }
    throw std::logic_error("no such path");
}

void add_animation(Json& root, const Document& document) {
    Json samplers = Json::array();
    Json channels = Json::array();
    for (const Channel& channel : document.channels) {
        Json sampler{{"input", channel.times}, {"output", channel.values}};
        if (channel.interpolation == Interpolation::cubic_spline) sampler["interpolation"] = "CUBICSPLINE";
        channels.push_back({{"sampler", samplers.size()},
                            {"target", {{"node", channel.node}, {"path", name_of(channel.path)}}}});
        samplers.push_back(std::move(sampler));
    }
    root["animations"] = Json::array(
        {{{"name", document.name}, {"samplers", std::move(samplers)}, {"channels", std::move(channels)}}});
}

std::string json_chunk(const Document& document) {
    Json root{
        {"asset", {{"version", "2.0"}, {"generator", "gridreel make_gallery"}, {"copyright", "CC0 1.0"}}}};
    if (!document.lights.empty()) root["extensionsUsed"] = {"KHR_lights_punctual"};
    add_nodes(root, document);
    add_meshes(root, document);
    add_looks(root, document);
    add_animation(root, document);
    add_accessors(root, document);
    return root.dump();
}

// --- Bytes ---------------------------------------------------------------------------------------

void put(std::ostream& out, std::size_t value) {
    const auto number = static_cast<std::uint32_t>(value);
    out.write(reinterpret_cast<const char*>(&number), sizeof number);
}

}  // namespace

std::size_t triangle_count(const Document& document) {
    std::size_t count = 0;
    for (const Node& node : document.nodes)
        if (node.mesh) count += document.accessors[document.meshes[*node.mesh].indices].count / 3;
    return count;
}

void write_glb_head(std::string json, std::size_t binary_size, std::string_view name, std::ostream& out) {
    json.resize(padded(json.size()), ' ');
    const std::size_t size = 12 + 8 + json.size() + 8 + binary_size;
    if (size > std::numeric_limits<std::uint32_t>::max())
        throw Error(fmt::format("the scene takes {} bytes, and a .glb holds less than 4 GiB", size), name,
                    "ask for fewer triangles or copies");

    constexpr std::uint32_t gltf_magic = 0x46546C67, json_type = 0x4E4F534A, binary_type = 0x004E4942;
    for (const std::size_t word : {std::size_t{gltf_magic}, std::size_t{2}, size}) put(out, word);
    put(out, json.size());
    put(out, json_type);
    out << json;
    put(out, binary_size);
    put(out, binary_type);
}

void write_glb(const Document& document, std::ostream& out) {
    std::size_t binary_size = 0;
    for (const Accessor& accessor : document.accessors) binary_size += padded(accessor.bytes.size());
    write_glb_head(json_chunk(document), binary_size, document.name, out);
    for (const Accessor& accessor : document.accessors) {
        out.write(reinterpret_cast<const char*>(accessor.bytes.data()),
                  static_cast<std::streamsize>(accessor.bytes.size()));
        constexpr std::array<char, 4> zeros{};
        out.write(zeros.data(),
                  static_cast<std::streamsize>(padded(accessor.bytes.size()) - accessor.bytes.size()));
    }
}

}  // namespace gridreel::gallery
