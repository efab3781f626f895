#include "anim/gltf/describe_scene.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <tiny_gltf.h>

#include <array>
#include <cmath>

// tinygltf is handed only the sections that carry neither bytes nor looks. Buffers, accessors, meshes,
// animations, images, textures and materials are read by ours: tinygltf checks no ranges, drops channels of
// KHR_animation_pointer, fails on images it cannot decode and leaves extensions to materials as JSON.

namespace gridreel::anim::gltf {
namespace {

// --- Through tinygltf --------------------------------------------------------------------------

/// A copy without application data and without extensions that are not read here.
Json stripped(const Json& json) {
    if (const auto* const array = std::get_if<Json::Array>(&json.value)) {
        Json::Array items;
        items.reserve(array->size());
        for (const Json& item : *array) items.push_back(stripped(item));
        return {std::move(items)};
    }
    const auto* const object = std::get_if<Json::Object>(&json.value);
    if (!object) return json;

    Json::Object properties;
    for (const auto& [name, value] : *object) {
        if (name == "extras") continue;
        if (name != "extensions") {
            properties.emplace_back(name, stripped(value));
        } else if (const Json* const lights = value.find("KHR_lights_punctual")) {
            Json::Object extension;
            extension.emplace_back("KHR_lights_punctual", stripped(*lights));
            properties.emplace_back(name, Json{std::move(extension)});
        }
    }
    return {std::move(properties)};
}

tinygltf::Model parse_model(const Place& root) {
    Json::Object sections;
    for (const auto name : {"asset", "scene", "scenes", "nodes", "skins", "cameras"})
        if (const Json* const section = root.json().find(name))
            sections.emplace_back(name, stripped(*section));
    if (const auto extensions = root.find("extensions")) {
        Json::Object only_extensions;
        only_extensions.emplace_back("extensions", extensions->json());
        Json kept = stripped({std::move(only_extensions)});
        for (auto& entry : std::get<Json::Object>(kept.value)) sections.push_back(std::move(entry));
    }
    const std::string text = write_json({std::move(sections)});

    tinygltf::Model model;
    tinygltf::TinyGLTF parser;
    std::string error, warning;
    if (!parser.LoadASCIIFromString(&model, &error, &warning, text.c_str(),
                                    static_cast<unsigned>(text.size()), ""))
        root.refuse(fmt::format("the scene description cannot be read ({})", error));
    return model;
}

std::optional<Index> optional_index(int index) {
    if (index < 0) return {};
    return static_cast<Index>(index);
}

std::vector<Index> indices(const std::vector<int>& list) {
    return {list.begin(), list.end()};
}

// --- Nodes -------------------------------------------------------------------------------------

Node read_node(const tinygltf::Node& source) {
    Node node;
    node.name = source.name;
    node.children = indices(source.children);
    if (!source.translation.empty()) node.trs.translation = glm::make_vec3(source.translation.data());
    if (!source.rotation.empty()) {
        const auto& q = source.rotation;  // x, y, z, w
        node.trs.rotation = glm::dquat(q[3], q[0], q[1], q[2]);
    }
    if (!source.scale.empty()) node.trs.scale = glm::make_vec3(source.scale.data());
    if (!source.matrix.empty()) node.matrix = glm::make_mat4(source.matrix.data());
    node.mesh = optional_index(source.mesh);
    node.skin = optional_index(source.skin);
    node.camera = optional_index(source.camera);
    if (const auto light = source.extensions.find("KHR_lights_punctual"); light != source.extensions.end())
        node.light = static_cast<Index>(light->second.Get("light").GetNumberAsInt());
    for (const double weight : source.weights) node.weights.push_back(static_cast<float>(weight));
    return node;
}

void read_nodes(const tinygltf::Model& model, Scene& scene) {
    for (const auto& node : model.nodes) scene.nodes.push_back(read_node(node));
    for (Index parent = 0; parent < scene.nodes.size(); ++parent)
        for (const Index child : scene.nodes[parent].children) scene.nodes[child].parent = parent;
}

void read_scenes(const tinygltf::Model& model, Document& document, Scene& scene) {
    for (const auto& source : model.scenes) scene.scenes.push_back(indices(source.nodes));
    scene.default_scene = optional_index(model.defaultScene).value_or(0);
    if (!scene.scenes.empty()) return;

    document.warn(document.root(), "the file has no scene; all its nodes are shown");
    auto& everything = scene.scenes.emplace_back();
    for (Index node = 0; node < scene.nodes.size(); ++node)
        if (!scene.nodes[node].parent) everything.push_back(node);
}

void read_skins(const tinygltf::Model& model, Document& document, Scene& scene) {
    for (std::size_t i = 0; i < model.skins.size(); ++i) {
        const auto& source = model.skins[i];
        Skin& skin = scene.skins.emplace_back();
        skin.name = source.name;
        skin.joints = indices(source.joints);
        skin.inverse_bind.assign(skin.joints.size(), glm::dmat4(1.0));
        const auto accessor = optional_index(source.inverseBindMatrices);
        if (!accessor) continue;

        const Place place = document.root().at("skins", i).at("inverseBindMatrices");
        const auto values = document.floats(*accessor, place);
        for (std::size_t joint = 0; joint < skin.joints.size(); ++joint) {
            const float* const matrix = values.data() + 16 * joint;
            for (std::size_t k = 0; k < 16; ++k)
                if (!std::isfinite(matrix[k]))
                    place.refuse(
                        fmt::format("the inverse bind matrix of joint {} holds {}", joint, matrix[k]));
            skin.inverse_bind[joint] = glm::dmat4(glm::make_mat4(matrix));
        }
    }
}

// --- Cameras and lights ------------------------------------------------------------------------

Camera read_camera(const tinygltf::Camera& source) {
    Camera camera;
    camera.name = source.name;
    if (source.type == "orthographic") {
        camera.kind = Camera::Kind::orthographic;
        camera.x_mag = source.orthographic.xmag;
        camera.y_mag = source.orthographic.ymag;
        camera.near_m = source.orthographic.znear;
        camera.far_m = source.orthographic.zfar;
        return camera;
    }
    camera.fov_y_rad = source.perspective.yfov;
    camera.near_m = source.perspective.znear;
    // tinygltf writes 0 for what the file leaves out.
    if (source.perspective.aspectRatio > 0.0) camera.aspect = source.perspective.aspectRatio;
    if (source.perspective.zfar > 0.0) camera.far_m = source.perspective.zfar;
    return camera;
}

Light read_light(const tinygltf::Light& source) {
    Light light;
    light.name = source.name;
    light.kind = source.type == "directional" ? Light::Kind::directional
                 : source.type == "spot"      ? Light::Kind::spot
                                              : Light::Kind::point;
    if (source.color.size() == 3) light.color = glm::vec3(glm::make_vec3(source.color.data()));
    light.intensity = static_cast<float>(source.intensity);
    if (source.range > 0.0) light.range_m = static_cast<float>(source.range);
    light.inner_cone_rad = static_cast<float>(source.spot.innerConeAngle);
    light.outer_cone_rad = static_cast<float>(source.spot.outerConeAngle);
    return light;
}

// --- The file ----------------------------------------------------------------------------------

std::vector<Place> variants_of(const Place& root) {
    std::vector<Place> variants;
    const auto extension = root.find_extension("KHR_materials_variants");
    if (!extension) return variants;
    const Place list = extension->at("variants");
    for (std::size_t i = 0; i < list.size(); ++i) variants.push_back(list[i]);
    return variants;
}

std::vector<std::string> names_in(const Document& document, std::string_view array) {
    std::vector<std::string> names;
    for (const Place& name : document.all(array)) names.push_back(name.text());
    return names;
}

}  // namespace

Scene describe_scene(Document& document) {
    const tinygltf::Model model = parse_model(document.root());
    Scene scene;
    read_nodes(model, scene);
    read_scenes(model, document, scene);
    read_skins(model, document, scene);
    for (const auto& camera : model.cameras) scene.cameras.push_back(read_camera(camera));
    for (const auto& light : model.lights) scene.lights.push_back(read_light(light));
    for (const Place& variant : variants_of(document.root()))
        scene.variants.push_back(variant.at("name").text());
    scene.extensions_used = names_in(document, "extensionsUsed");
    scene.extensions_required = names_in(document, "extensionsRequired");
    return scene;
}

}  // namespace gridreel::anim::gltf
