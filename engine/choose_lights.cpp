#include "engine/choose_lights.h"

#include <glm/geometric.hpp>

#include <numbers>

namespace gridreel::engine {

std::vector<anim::Index> light_nodes(const anim::Scene& scene, const anim::Clip& clip) {
    std::vector<anim::Index> nodes = anim::nodes_in_order(scene, clip);
    std::erase_if(nodes, [&](anim::Index node) { return !scene.nodes[node].light; });
    return nodes;
}

Lighting file_lighting(const anim::Scene& scene, const std::vector<anim::Index>& nodes,
                       const anim::Pose& pose) {
    Lighting lighting;
    lighting.lights.reserve(nodes.size());
    for (const anim::Index node : nodes) {
        if (!pose.visible[node]) continue;
        if (const auto light = posed_light(pose.lights[*scene.nodes[node].light], pose.world[node])) {
            lighting.lights.push_back(*light);
        }
    }
    return lighting;
}

Lighting default_lighting(const glm::vec3& box_min, const glm::vec3& box_max) {
    // Facing the key light, white reflects 0.65 of it and 0.29 of the dome; facing up, 0.47 and 0.32.
    constexpr float key_reflected = 0.65f;
    const glm::vec3 towards_key = glm::normalize(glm::vec3{0.45f, 0.8f, 0.6f});
    const glm::vec3 center = 0.5f * box_min + 0.5f * box_max;
    const float diagonal = glm::length(box_max - box_min);
    const float distance = diagonal > 0.0f ? 10.0f * diagonal : 10.0f;
    return {.lights = {{.kind = anim::Light::Kind::point,
                        .falloff = Falloff::none,
                        .intensity = glm::vec3(key_reflected * std::numbers::pi_v<float>),
                        .position = center + distance * towards_key}},
            .dome = {.sky = glm::vec3{0.35f, 0.36f, 0.38f}, .ground = glm::vec3{0.14f, 0.13f, 0.12f}}};
}

}  // namespace gridreel::engine
