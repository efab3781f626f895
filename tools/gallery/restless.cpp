#include "tools/gallery/restless.h"

#include "tools/gallery/packing.h"
#include "tools/gallery/turns.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace gridreel::gallery {

namespace {

std::vector<std::optional<Id>> parents(const Document& document) {
    std::vector<std::optional<Id>> parent(document.nodes.size());
    for (Id id = 0; id < document.nodes.size(); ++id)
        for (const Id child : document.nodes[id].children) parent[child] = id;
    return parent;
}

/// Roots above the meshes that stand still, each once.
std::vector<Id> still_roots(const Document& document) {
    std::vector<bool> animated(document.nodes.size(), false);
    for (const Channel& channel : document.channels) animated[channel.node] = true;
    const auto parent = parents(document);

    std::vector<Id> roots;
    for (Id id = 0; id < document.nodes.size(); ++id) {
        if (!document.nodes[id].mesh || document.nodes[id].skin) continue;
        bool moves = animated[id];
        Id root = id;
        while (parent[root]) {
            root = *parent[root];
            moves = moves || animated[root];
        }
        if (!moves && std::ranges::find(roots, root) == roots.end()) roots.push_back(root);
    }
    return roots;
}

}  // namespace

void keep_moving(Document& document) {
    double duration_s = 0.0;
    for (const Channel& channel : document.channels)
        duration_s = std::max(duration_s, document.accessors[channel.times].max.front());
    std::vector<Id> roots = still_roots(document);
    if (roots.empty() || duration_s <= 0.0) return;

    constexpr int steps = 36;
    constexpr double radius_m = 0.01;
    std::vector<float> times;
    std::vector<glm::dvec3> places;
    for (int key = 0; key <= steps; ++key) {
        const double part = double(key) / steps;
        times.push_back(static_cast<float>(part * duration_s));
        places.push_back(radius_m * glm::dvec3(cos_turns(part), 0.0, sin_turns(part)));
    }
    const Id node = append(document.nodes, {.name = "sway", .children = std::move(roots)});
    animate_translation(document, node, add_times(document, times), places);
}

}  // namespace gridreel::gallery
