#include "anim/gltf/read_node_extensions.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace gridreel::anim::gltf {
namespace {

/// Numbers of one attribute, all instances'; empty when the file does not state it.
std::vector<float> read_attribute(Document& document, const Place& attributes, std::string_view name) {
    const auto place = attributes.find(name);
    if (!place) return {};
    std::vector<float> values = document.floats(place->index(), *place);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i])) place->refuse(fmt::format("component {} is {}", i, values[i]));
    return values;
}

glm::dquat read_rotation(const float* values, std::size_t instance, const Place& attributes) {
    const glm::dquat rotation{glm::make_quat(values)};  // x, y, z, w in both
    if (glm::dot(rotation, rotation) == 0.0)
        attributes.at("ROTATION")
            .refuse(fmt::format("the rotation of instance {} is a quaternion of length zero", instance));
    return rotation;
}

std::vector<Trs> read_instances(Document& document, const Place& extension) {
    const auto attributes = extension.find("attributes");
    if (!attributes) return {};
    const auto translations = read_attribute(document, *attributes, "TRANSLATION");
    const auto rotations = read_attribute(document, *attributes, "ROTATION");
    const auto scales = read_attribute(document, *attributes, "SCALE");
    const std::size_t count = std::max({translations.size() / 3, rotations.size() / 4, scales.size() / 3});

    document.budget().spend(count * sizeof(Trs), extension);
    std::vector<Trs> instances(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (!translations.empty())
            instances[i].translation = glm::dvec3(glm::make_vec3(translations.data() + 3 * i));
        if (!rotations.empty())
            instances[i].rotation = read_rotation(rotations.data() + 4 * i, i, *attributes);
        if (!scales.empty()) instances[i].scale = glm::dvec3(glm::make_vec3(scales.data() + 3 * i));
    }
    return instances;
}

}  // namespace

void read_node_extensions(Document& document, Scene& scene) {
    const auto places = document.all("nodes");
    for (std::size_t i = 0; i < places.size(); ++i) {
        Node& node = scene.nodes[i];
        if (const auto visibility = places[i].find_extension("KHR_node_visibility"))
            node.visible = visibility->boolean_or("visible", true);

        const auto instancing = places[i].find_extension("EXT_mesh_gpu_instancing");
        if (!instancing) continue;
        if (!node.mesh)
            document.warn(*instancing, "the node has instances but no mesh; nothing is drawn");
        else if (node.skin)
            document.warn(*instancing, "a skinned mesh cannot be instanced; it is drawn once");
        else
            node.instances = read_instances(document, *instancing);
    }
}

}  // namespace gridreel::anim::gltf
