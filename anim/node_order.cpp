#include "anim/node_order.h"

namespace gridreel::anim {

std::vector<Index> depth_first(const Scene& scene, std::span<const Index> roots) {
    std::vector<Index> order;
    order.reserve(scene.nodes.size());

    // The stack is ours and not the call stack, so a chain of a million nodes is no danger.
    // It is filled backwards: the first child comes off first.
    std::vector<Index> waiting(roots.rbegin(), roots.rend());
    while (!waiting.empty()) {
        const Index node = waiting.back();
        waiting.pop_back();
        order.push_back(node);
        const std::vector<Index>& children = scene.nodes[node].children;
        waiting.insert(waiting.end(), children.rbegin(), children.rend());
    }
    return order;
}

std::vector<Index> all_parents_first(const Scene& scene) {
    std::vector<Index> roots;
    for (Index node = 0; node < scene.nodes.size(); ++node) {
        if (!scene.nodes[node].parent) roots.push_back(node);
    }
    return depth_first(scene, roots);
}

}  // namespace gridreel::anim
