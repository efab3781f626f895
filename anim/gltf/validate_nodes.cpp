#include "anim/gltf/validate.h"

#include <fmt/format.h>

#include <optional>
#include <span>
#include <vector>

namespace gridreel::anim::gltf {
namespace {

/// Every node has at most one parent, and following parents ends at a root.
std::vector<std::optional<std::size_t>> check_tree(const Place& root) {
    const std::size_t count = root.count("nodes");
    std::vector<std::optional<std::size_t>> parents(count);
    std::vector<std::vector<std::size_t>> children(count);
    for (std::size_t node = 0; node < count; ++node) {
        const auto list = root.at("nodes", node).find("children");
        for (std::size_t i = 0; list && i < list->size(); ++i) {
            const std::size_t child = (*list)[i].index();
            if (child == node) (*list)[i].refuse(fmt::format("node {} is its own child", node));
            if (parents[child])
                (*list)[i].refuse(fmt::format("node {} is already a child of node {}: nodes must form trees",
                                              child, *parents[child]));
            parents[child] = node;
            children[node].push_back(child);
        }
    }

    // With one parent each, whatever cannot be reached from a root lies on or under a cycle.
    std::vector<bool> reached(count, false);
    std::vector<std::size_t> open;
    for (std::size_t node = 0; node < count; ++node)
        if (!parents[node]) open.push_back(node);
    while (!open.empty()) {
        const std::size_t node = open.back();
        open.pop_back();
        reached[node] = true;
        open.insert(open.end(), children[node].begin(), children[node].end());
    }
    for (std::size_t node = 0; node < count; ++node)
        if (!reached[node]) root.at("nodes", node).refuse(fmt::format("node {} is its own ancestor", node));
    return parents;
}

void check_scenes(const Place& root, const std::vector<std::optional<std::size_t>>& parents) {
    // One list for all scenes, as there may be as many of them as nodes.
    std::vector<std::optional<std::size_t>> listed_in(parents.size());
    for (std::size_t scene = 0; scene < root.count("scenes"); ++scene) {
        const auto nodes = root.at("scenes", scene).find("nodes");
        for (std::size_t i = 0; nodes && i < nodes->size(); ++i) {
            const std::size_t node = (*nodes)[i].index();
            if (parents[node])
                (*nodes)[i].refuse(
                    fmt::format("node {} is not a root: it is a child of node {}", node, *parents[node]));
            if (listed_in[node] == scene) (*nodes)[i].refuse(fmt::format("node {} is listed twice", node));
            listed_in[node] = scene;
        }
    }
}

void check_transform(const Place& node) {
    for (const auto property : {"translation", "rotation", "scale"})
        if (node.has("matrix") && node.has(property))
            node.refuse(fmt::format("the node has both a matrix and a {}; only one can hold", property));

    const auto rotation = node.find("rotation");
    bool is_zero = rotation.has_value();
    for (std::size_t i = 0; rotation && i < 4; ++i) is_zero = is_zero && (*rotation)[i].number() == 0.0;
    if (is_zero) rotation->refuse("the rotation is a quaternion of length zero");
}

/// For each mesh, its first primitive that no skin can move, if there is one.
std::vector<std::optional<std::size_t>> find_unskinned(const Place& root) {
    std::vector<std::optional<std::size_t>> unskinned(root.count("meshes"));
    for (std::size_t mesh = 0; mesh < unskinned.size(); ++mesh) {
        const Place primitives = root.at("meshes", mesh).at("primitives");
        for (std::size_t i = 0; i < primitives.size() && !unskinned[mesh]; ++i)
            if (!primitives[i].at("attributes").has("JOINTS_0")) unskinned[mesh] = i;
    }
    return unskinned;
}

void check_mesh_of(const Place& node, const Place& root,
                   std::span<const std::optional<std::size_t>> unskinned) {
    const auto mesh = node.find_index("mesh");
    const auto weights = node.find("weights");
    if (weights && weights->size() > 0) {
        if (!mesh) weights->refuse("the node has morph weights but no mesh");
        const std::size_t count = root.at("meshes", *mesh).at("primitives", 0).count("targets");
        if (weights->size() != count)
            weights->refuse(fmt::format("the node has {} morph weights; mesh {} has {} targets",
                                        weights->size(), *mesh, count));
    }

    const auto skin = node.find("skin");
    if (!skin) return;
    if (!mesh) skin->refuse("the node has a skin but no mesh");
    if (const auto primitive = unskinned[*mesh])
        skin->refuse(fmt::format("primitive {} of mesh {} has no JOINTS_0 for the skin", *primitive, *mesh));
}

void check_skin(const Place& skin, std::span<const Accessor> accessors) {
    const auto matrices = skin.find("inverseBindMatrices");
    if (!matrices) return;
    const Accessor& accessor = accessors[matrices->index()];
    if (!accessor.is("MAT4") || !accessor.is_float())
        matrices->refuse(fmt::format("inverse bind matrices are {} of {}; they must be MAT4 of FLOAT",
                                     accessor.element.name, name_of(accessor.component)));
    const std::size_t joint_count = skin.at("joints").size();
    if (accessor.count < joint_count)
        matrices->refuse(
            fmt::format("there are {} inverse bind matrices for {} joints", accessor.count, joint_count));
}

}  // namespace

void validate_nodes(const Place& root, std::span<const Accessor> accessors) {
    const auto parents = check_tree(root);
    check_scenes(root, parents);
    const auto unskinned = find_unskinned(root);
    for (std::size_t i = 0; i < root.count("nodes"); ++i) {
        const Place node = root.at("nodes", i);
        check_transform(node);
        check_mesh_of(node, root, unskinned);
    }
    for (std::size_t i = 0; i < root.count("skins"); ++i) check_skin(root.at("skins", i), accessors);
}

}  // namespace gridreel::anim::gltf
