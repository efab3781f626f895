#include "sequences/scene_info.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>

namespace gridreel::sequences {
namespace {

using Json = nlohmann::ordered_json;

std::string label(const std::string& name, std::size_t number) {
    return name.empty() ? fmt::format("(unnamed {})", number) : name;
}

/// "1 node", "2 nodes".
std::string count(std::size_t number, std::string_view thing, std::string_view plural = "s") {
    return fmt::format("{} {}{}", number, thing, number == 1 ? "" : plural);
}

/// One labelled entry of the page.
template <class... Args>
void line(std::string& page, std::string_view title, fmt::format_string<Args...> format, Args&&... args) {
    std::string text = fmt::format(format, std::forward<Args>(args)...);
    std::replace(text.begin(), text.end(), '\n', ' ');  // names may hold anything
    fmt::format_to(std::back_inserter(page), "{:<12}{}\n", title, text);
}

std::string names(const std::vector<std::string>& list) {
    if (list.empty()) return "none";
    std::vector<std::string> labels;
    for (std::size_t i = 0; i < list.size(); ++i) labels.push_back(label(list[i], i));
    return fmt::format("{}", fmt::join(labels, ", "));
}

/// As many of the names as a few lines hold, and how many more there are.
void list_lines(std::string& page, std::string_view title, const std::vector<std::string>& list) {
    constexpr std::size_t widest = 88, most_lines = 4;
    if (list.empty()) line(page, title, "none");
    std::size_t lines = 0;
    for (std::size_t i = 0; i < list.size(); ++lines) {
        const std::string_view head = lines == 0 ? title : "";
        if (lines == most_lines) {
            line(page, head, "and {} more", list.size() - i);
            return;
        }
        std::string text;
        do {
            text += label(list[i], i) + (i + 1 < list.size() ? ", " : "");
            ++i;
        } while (i < list.size() && text.size() + label(list[i], i).size() < widest);
        line(page, head, "{}", std::string_view(text).substr(0, text.find_last_not_of(' ') + 1));
    }
}

void placed_lines(std::string& page, std::string_view title, const std::vector<PlacedInfo>& list) {
    if (list.empty()) line(page, title, "none");
    for (std::size_t i = 0; i < list.size(); ++i) {
        const PlacedInfo& placed = list[i];
        line(page, i == 0 ? title : "", "{} {} ({}{})", i, label(placed.node, i), placed.kind,
             placed.name.empty() ? "" : fmt::format(" '{}'", placed.name));
    }
}

Json to_json(const std::vector<PlacedInfo>& list) {
    Json json = Json::array();
    for (const PlacedInfo& placed : list) {
        json.push_back({{"node", placed.node}, {"name", placed.name}, {"kind", placed.kind}});
    }
    return json;
}

void memory_line(std::string& page, const SceneInfo& info) {
    const MemoryEstimate& memory = info.memory;
    const auto mebibytes = [](std::size_t bytes) { return (bytes + (1u << 20) - 1) >> 20; };
    line(page, "memory",
         "about {} MiB to render {}x{}: program {}, scene {}, geometry {}, textures {}, grid {}, films {}, "
         "rays {} (assuming {:.2g} references a triangle)",
         mebibytes(memory.total()), info.settings.width, info.settings.height.value(),
         mebibytes(memory.program), mebibytes(memory.scene), mebibytes(memory.geometry),
         mebibytes(memory.textures), mebibytes(memory.grid), mebibytes(memory.films), mebibytes(memory.rays),
         memory.references_per_triangle);
}

/// Bytes, and what was assumed.
Json memory_json(const SceneInfo& info) {
    const MemoryEstimate& memory = info.memory;
    return {{"total", memory.total()},
            {"program", memory.program},
            {"scene", memory.scene},
            {"geometry", memory.geometry},
            {"textures", memory.textures},
            {"grid", memory.grid},
            {"films", memory.films},
            {"rays", memory.rays},
            {"assumed",
             {{"size", {info.settings.width, info.settings.height.value()}},
              {"spp", info.settings.samples},
              {"lambda", info.settings.tracer.resolution.lambda},
              {"references_per_triangle", memory.references_per_triangle},
              {"threads", info.threads}}}};
}

Json to_json(const anim::Box& box) {
    if (box.empty()) return nullptr;
    return {{"min", {box.min.x, box.min.y, box.min.z}}, {"max", {box.max.x, box.max.y, box.max.z}}};
}

}  // namespace

std::string to_text(const SceneInfo& info) {
    std::string page;
    const std::string fps = to_string(info.rate);
    line(page, "file", "{}", info.file.string());
    line(page, "scene", "{} of {}", info.scene, info.scenes);
    if (info.animations.empty()) line(page, "animations", "none");
    for (std::size_t i = 0; i < info.animations.size(); ++i) {
        const AnimationInfo& animation = info.animations[i];
        line(page, i == 0 ? "animations" : "", "{} {}: {:.4g} s, frames 0-{} at {} fps{}", i,
             label(animation.name, i), animation.duration_s, animation.last_frame, fps,
             animation.plays ? ", plays" : "");
    }
    line(page, "clip", "{:.4g} s, frames 0-{} at {} fps", info.duration_s, info.last_frame, fps);
    placed_lines(page, "cameras", info.cameras);
    placed_lines(page, "lights", info.lights);
    line(page, "triangles", "{} moving, {} still, {} vertices", info.moving_triangles, info.still_triangles,
         info.vertices);
    if (info.bounds.empty()) {
        line(page, "bounds", "empty");
    } else {
        line(page, "bounds", "({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m over the clip",
             info.bounds.min.x, info.bounds.min.y, info.bounds.min.z, info.bounds.max.x, info.bounds.max.y,
             info.bounds.max.z);
    }
    line(page, "contents", "{}, {}, {}, {}, {}, {}", count(info.nodes, "node"),
         count(info.meshes, "mesh", "es"), count(info.skins, "skin"),
         count(info.morph_targets, "morph target"), count(info.textures, "texture"),
         count(info.images, "image"));
    list_lines(page, "materials", info.materials);
    for (std::size_t i = 0; i < info.variants.size(); ++i) {
        line(page, i == 0 ? "variants" : "", "{} {}{}", i, label(info.variants[i], i),
             info.variant == i ? ", shown" : "");
    }
    line(page, "extensions", "used {}", names(info.extensions_used));
    if (!info.extensions_used.empty()) {
        line(page, "", "required {}", names(info.extensions_required));
        line(page, "", "supported {}", names(info.extensions_supported));
    }
    memory_line(page, info);
    for (const anim::Warning& warning : info.warnings) line(page, "warning", "{}", describe(warning));
    for (const std::string& note : info.notes) line(page, "note", "{}", note);
    return page;
}

std::string to_json_text(const SceneInfo& info) {
    Json animations = Json::array();
    for (const AnimationInfo& animation : info.animations) {
        animations.push_back({{"name", animation.name},
                              {"duration_s", animation.duration_s},
                              {"frames", {0, animation.last_frame}},
                              {"plays", animation.plays}});
    }
    Json warnings = Json::array();
    for (const anim::Warning& warning : info.warnings) {
        warnings.push_back({{"where", warning.where}, {"text", warning.text}});
    }
    const Json json{{"schema", "gridreel.info/1"},
                    {"file", info.file.string()},
                    {"sha256", info.sha256},
                    {"scenes", info.scenes},
                    {"scene", info.scene},
                    {"fps", to_string(info.rate)},
                    {"animations", std::move(animations)},
                    {"duration_s", info.duration_s},
                    {"frames", {0, info.last_frame}},
                    {"cameras", to_json(info.cameras)},
                    {"lights", to_json(info.lights)},
                    {"triangles", {{"moving", info.moving_triangles}, {"still", info.still_triangles}}},
                    {"vertices", info.vertices},
                    {"bounds", to_json(info.bounds)},
                    {"nodes", info.nodes},
                    {"meshes", info.meshes},
                    {"skins", info.skins},
                    {"morph_targets", info.morph_targets},
                    {"textures", info.textures},
                    {"images", info.images},
                    {"materials", info.materials},
                    {"variants", info.variants},
                    {"variant", info.variant ? Json(*info.variant) : Json()},
                    {"extensions_used", info.extensions_used},
                    {"extensions_required", info.extensions_required},
                    {"extensions_supported", info.extensions_supported},
                    {"memory_estimate", memory_json(info)},
                    {"warnings", std::move(warnings)},
                    {"notes", info.notes}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace gridreel::sequences
