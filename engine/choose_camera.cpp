#include "engine/choose_camera.h"

#include "anim/error.h"
#include "anim/parse_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace gridreel::engine {
namespace {

std::vector<anim::Index> camera_nodes(const anim::Scene& scene, const anim::Clip& clip) {
    std::vector<anim::Index> nodes = anim::nodes_in_order(scene, clip);
    std::erase_if(nodes, [&](anim::Index node) { return !scene.nodes[node].camera; });
    return nodes;
}

const std::string& camera_name(const anim::Scene& scene, anim::Index node) {
    return scene.cameras[*scene.nodes[node].camera].name;
}

std::string list(const anim::Scene& scene, const std::vector<anim::Index>& nodes) {
    if (nodes.empty()) return "the scene has no cameras: use \"fit\"";
    std::string text = "choose \"fit\" or one of";
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        text += fmt::format("{} {} (node \"{}\", camera \"{}\")", i == 0 ? "" : ",", i,
                            scene.nodes[nodes[i]].name, camera_name(scene, nodes[i]));
    }
    return text;
}

}  // namespace

std::optional<anim::Index> choose_camera(const anim::Scene& scene, const anim::Clip& clip,
                                         std::string_view choice) {
    if (choice == "fit") return std::nullopt;
    const std::vector<anim::Index> nodes = camera_nodes(scene, clip);
    if (choice == "auto") return nodes.empty() ? std::nullopt : std::optional(nodes.front());

    const auto by_node_name =
        std::ranges::find_if(nodes, [&](anim::Index node) { return scene.nodes[node].name == choice; });
    if (by_node_name != nodes.end()) return *by_node_name;
    const auto by_camera_name =
        std::ranges::find_if(nodes, [&](anim::Index node) { return camera_name(scene, node) == choice; });
    if (by_camera_name != nodes.end()) return *by_camera_name;
    if (const auto number = parse_number<std::size_t>(choice); number && *number < nodes.size()) {
        return nodes[*number];
    }

    throw Error(fmt::format("there is no camera \"{}\"", choice), "--camera", list(scene, nodes));
}

double preferred_aspect(const anim::Scene& scene, std::optional<anim::Index> node) {
    constexpr double usual = 16.0 / 9.0;
    if (!node) return usual;
    const anim::Camera& camera = scene.cameras[*scene.nodes[*node].camera];
    if (camera.kind == anim::Camera::Kind::orthographic) return std::abs(camera.x_mag / camera.y_mag);
    return camera.aspect.value_or(usual);
}

}  // namespace gridreel::engine
