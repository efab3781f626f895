#include "anim/gltf/describe_scene.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <tiny_gltf.h>

#include <array>
#include <cmath>

// tinygltf is handed only the sections that carry no bytes. Buffers, accessors, meshes, animations and images
// are read by ours: tinygltf checks no ranges, drops channels of KHR_animation_pointer and fails on images it
// cannot decode.

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
    for (const auto name :
         {"asset", "scene", "scenes", "nodes", "skins", "cameras", "materials", "textures", "samplers"})
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

// --- Looks -------------------------------------------------------------------------------------

Wrap read_wrap(int code) {
    if (code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp_to_edge;
    return code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirrored_repeat : Wrap::repeat;
}

Texture read_texture(const tinygltf::Texture& source, const tinygltf::Model& model) {
    Texture texture;
    texture.image = optional_index(source.source);
    if (source.sampler < 0) return texture;

    const auto& sampler = model.samplers[static_cast<std::size_t>(source.sampler)];
    texture.wrap_s = read_wrap(sampler.wrapS);
    texture.wrap_t = read_wrap(sampler.wrapT);
    if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) texture.mag_filter = Filter::nearest;
    switch (sampler.minFilter) {
        case TINYGLTF_TEXTURE_FILTER_NEAREST:
            texture.min_filter = Filter::nearest;
            texture.mip_filter = MipFilter::none;
            break;
        case TINYGLTF_TEXTURE_FILTER_LINEAR:
            texture.mip_filter = MipFilter::none;
            break;
        case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
            texture.min_filter = Filter::nearest;
            texture.mip_filter = MipFilter::nearest;
            break;
        case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
            texture.mip_filter = MipFilter::nearest;
            break;
        case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
            texture.min_filter = Filter::nearest;
            break;
        default:
            break;
    }
    return texture;
}

std::optional<TextureRef> read_texture_ref(const tinygltf::TextureInfo& info, const Place& material,
                                           Document& document) {
    const auto texture = optional_index(info.index);
    if (!texture) return {};
    if (info.texCoord > 1) {
        document.warn(material,
                      fmt::format("texture {} uses TEXCOORD_{}; only 0 and 1 are read, so it is left out",
                                  *texture, info.texCoord));
        return {};
    }
    return TextureRef{.texture = *texture, .texcoord = static_cast<std::uint32_t>(info.texCoord)};
}

Material read_material(const tinygltf::Material& source, const Place& place, Document& document) {
    Material material;
    const auto& pbr = source.pbrMetallicRoughness;
    material.name = source.name;
    material.base_color = glm::vec4(glm::make_vec4(pbr.baseColorFactor.data()));
    material.base_color_texture = read_texture_ref(pbr.baseColorTexture, place, document);
    material.metallic = static_cast<float>(pbr.metallicFactor);
    material.roughness = static_cast<float>(pbr.roughnessFactor);
    material.metallic_roughness_texture = read_texture_ref(pbr.metallicRoughnessTexture, place, document);
    material.emissive = glm::vec3(glm::make_vec3(source.emissiveFactor.data()));
    material.emissive_texture = read_texture_ref(source.emissiveTexture, place, document);
    material.alpha_mode = source.alphaMode == "MASK"    ? AlphaMode::mask
                          : source.alphaMode == "BLEND" ? AlphaMode::blend
                                                        : AlphaMode::opaque;
    material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
    material.double_sided = source.doubleSided;
    return material;
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
    for (const auto& texture : model.textures) scene.textures.push_back(read_texture(texture, model));
    for (std::size_t i = 0; i < model.materials.size(); ++i)
        scene.materials.push_back(
            read_material(model.materials[i], document.root().at("materials", i), document));
    scene.extensions_used = names_in(document, "extensionsUsed");
    scene.extensions_required = names_in(document, "extensionsRequired");
    return scene;
}

}  // namespace gridreel::anim::gltf
