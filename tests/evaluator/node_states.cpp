#include "node_states.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>

namespace gridreel::evaluator {
namespace {

using nlohmann::json;

/// Animated properties by pointer.
using Values = std::map<std::string, std::vector<double>>;

constexpr auto visibility = "/extensions/KHR_node_visibility/visible";

/// The array `name` of an object, empty where it has none.
const json& array_of(const json& object, const char* name) {
    static const json none = json::array();
    const auto found = object.find(name);
    return found != object.end() ? *found : none;
}

Values values_at(const Clip& clip, double time_s) {
    Values values;
    for (const Channel& channel : clip.channels) values[channel.pointer] = sample(channel.keys, time_s);
    return values;
}

template <std::size_t N>
std::array<double, N> vector_of(const std::vector<double>& values) {
    std::array<double, N> vector{};
    for (std::size_t i = 0; i < N; ++i) vector[i] = values.at(i);
    return vector;
}

/// The property `name` of the object at `place`: animated, or else as the file states it.
std::vector<double> property(const json& object, const std::string& place, const char* name,
                             const Values& values, const std::vector<double>& absent) {
    const auto animated = values.find(place + "/" + name);
    return animated != values.end() ? animated->second : object.value(name, absent);
}

/// A list of weights, of which each element may be animated on its own.
std::vector<double> weights_of(const json& object, const std::string& place, const Values& values,
                               std::size_t count) {
    std::vector<double> weights = property(object, place, "weights", values, std::vector<double>(count, 0.0));
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto animated = values.find(place + "/weights/" + std::to_string(i));
        if (animated != values.end()) weights[i] = animated->second.at(0);
    }
    return weights;
}

std::vector<double> morph_weights(const File& file, const json& node, const std::string& place,
                                  const Values& values) {
    if (!node.contains("mesh")) return {};
    const std::size_t index = node["mesh"];
    const json& mesh = file.json.at("meshes").at(index);
    const std::size_t count = array_of(mesh.at("primitives").at(0), "targets").size();
    const std::string own = place + "/weights";
    const bool animated = std::any_of(values.begin(), values.end(),
                                      [&](const auto& value) { return value.first.starts_with(own); });
    const auto of_mesh = weights_of(mesh, "/meshes/" + std::to_string(index), values, count);
    if (!animated && !node.contains("weights")) return of_mesh;
    // Single weights may be animated over a node that states none: the others are still the mesh's.
    json with_weights = node;
    if (!node.contains("weights")) with_weights["weights"] = of_mesh;
    return weights_of(with_weights, place, values, count);
}

Matrix local_matrix(const json& node, const std::string& place, const Values& values) {
    if (node.contains("matrix")) return vector_of<16>(node["matrix"]);
    return compose(vector_of<3>(property(node, place, "translation", values, {0, 0, 0})),
                   vector_of<4>(property(node, place, "rotation", values, {0, 0, 0, 1})),
                   vector_of<3>(property(node, place, "scale", values, {1, 1, 1})));
}

bool is_visible(const json& node, const std::string& place, const Values& values) {
    const auto animated = values.find(place + visibility);
    if (animated != values.end()) return animated->second.at(0) != 0;
    return node.value(json::json_pointer(visibility), true);
}

std::vector<std::size_t> roots(const json& nodes) {
    std::set<std::size_t> children;
    for (const json& node : nodes)
        for (const json& child : array_of(node, "children")) children.insert(child.get<std::size_t>());
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!children.contains(i)) result.push_back(i);
    return result;
}

}  // namespace

std::vector<NodeState> nodes_at(const File& file, const Clip& clip, double time_s) {
    const json& nodes = array_of(file.json, "nodes");
    const Values values = values_at(clip, time_s);
    std::vector<NodeState> states(nodes.size());
    const std::function<void(std::size_t, const Matrix&, bool)> visit =
        [&](std::size_t index, const Matrix& above, bool visible_above) {
            const json& node = nodes.at(index);
            const std::string place = "/nodes/" + std::to_string(index);
            NodeState& state = states[index];
            state.world = above * local_matrix(node, place, values);
            state.visible = visible_above && is_visible(node, place, values);
            state.weights = morph_weights(file, node, place, values);
            for (const json& child : array_of(node, "children"))
                visit(child.get<std::size_t>(), state.world, state.visible);
        };
    for (const std::size_t root : roots(nodes)) visit(root, identity, true);
    return states;
}

std::vector<bool> nodes_ever_visible(const File& file, const Clip& clip) {
    // Visibility steps from key to key.
    std::map<std::string, bool> ever_set;
    for (const Channel& channel : clip.channels) {
        const auto is_set = [](double value) { return value != 0; };
        if (channel.pointer.ends_with(visibility))
            ever_set[channel.pointer] =
                std::any_of(channel.keys.values.begin(), channel.keys.values.end(), is_set);
    }
    const json& nodes = array_of(file.json, "nodes");
    std::vector<bool> ever(nodes.size(), false);
    const std::function<void(std::size_t)> visit = [&](std::size_t index) {
        const auto animated = ever_set.find("/nodes/" + std::to_string(index) + visibility);
        ever[index] = animated != ever_set.end() ? animated->second : is_visible(nodes.at(index), "", {});
        if (!ever[index]) return;
        for (const json& child : array_of(nodes.at(index), "children")) visit(child.get<std::size_t>());
    };
    for (const std::size_t root : roots(nodes)) visit(root);
    return ever;
}

std::vector<std::size_t> nodes_of_scene(const File& file, std::size_t scene) {
    const json& nodes = array_of(file.json, "nodes");
    const std::vector<std::size_t> tops =
        file.json.contains("scenes")
            ? file.json["scenes"].at(scene).value("nodes", std::vector<std::size_t>{})
            : roots(nodes);
    std::vector<std::size_t> order;
    const std::function<void(std::size_t)> visit = [&](std::size_t index) {
        order.push_back(index);
        for (const json& child : array_of(nodes.at(index), "children")) visit(child.get<std::size_t>());
    };
    for (const std::size_t top : tops) visit(top);
    return order;
}

std::size_t default_scene(const File& file) {
    return file.json.value("scene", std::size_t{0});
}

}  // namespace gridreel::evaluator
