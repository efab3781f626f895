#include "anim/gltf/extensions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace gridreel::anim::gltf {
namespace {

constexpr std::array<std::string_view, 8> supported{"EXT_mesh_gpu_instancing", "EXT_meshopt_compression",
                                                    "KHR_animation_pointer",   "KHR_draco_mesh_compression",
                                                    "KHR_lights_punctual",     "KHR_mesh_quantization",
                                                    "KHR_meshopt_compression", "KHR_node_visibility"};

bool is_supported(std::string_view name) {
    return std::find(supported.begin(), supported.end(), name) != supported.end();
}

/// What to do about a required extension.
std::string_view remedy_for(std::span<const std::string> names) {
    const auto has = [&](std::string_view part) {
        return std::any_of(names.begin(), names.end(),
                           [&](const std::string& name) { return name.find(part) != name.npos; });
    };
    if (has("basisu") || has("webp")) return "export the model with PNG or JPEG textures";
    return "export the model without these extensions";
}

struct Version {
    int major = 0, minor = 0;
};

/// "<major>.<minor>", both digits only.
Version read_version(const Place& place) {
    const std::string& text = place.text();
    const auto is_number = [](std::string_view part) {
        return !part.empty() && part.size() <= 4 &&
               std::all_of(part.begin(), part.end(), [](unsigned char c) { return std::isdigit(c); });
    };
    const auto dot = text.find('.');
    if (dot == text.npos || !is_number(text.substr(0, dot)) || !is_number(text.substr(dot + 1)))
        place.refuse(fmt::format("\"{}\" is not a version like \"2.0\"", text),
                     "export the model as glTF 2.0");
    return {.major = std::stoi(text.substr(0, dot)), .minor = std::stoi(text.substr(dot + 1))};
}

std::vector<Place> names_in(const Place& root, std::string_view array) {
    std::vector<Place> names;
    const auto found = root.find(array);
    for (std::size_t i = 0; found && i < found->size(); ++i) names.push_back((*found)[i]);
    return names;
}

void check_version(const Place& root) {
    const Place asset = root.at("asset");
    if (const auto least = asset.find("minVersion")) {
        const Version version = read_version(*least);
        if (version.major != 2 || version.minor > 0)
            least->refuse(
                fmt::format("the file needs a reader of glTF {}; this one reads 2.0", least->text()),
                "export the model as glTF 2.0");
    }
    const Place version = asset.at("version");
    if (read_version(version).major != 2)
        version.refuse(fmt::format("the file is glTF {}; glTF 2 is read", version.text()),
                       "export the model as glTF 2.0");
}

}  // namespace

void check_version_and_extensions(Document& document) {
    const Place root = document.root();
    if (!std::holds_alternative<Json::Object>(root.json().value))
        root.refuse("the JSON is not an object", "this does not look like glTF: check the file");
    check_version(root);

    // Required.
    std::vector<std::string> missing;
    for (const Place& name : names_in(root, "extensionsRequired"))
        if (!is_supported(name.text())) missing.push_back(name.text());
    if (!missing.empty()) {
        root.at("extensionsRequired")
            .refuse(fmt::format("the model requires {}, which {} not supported", fmt::join(missing, ", "),
                                missing.size() == 1 ? "is" : "are"),
                    remedy_for(missing));
    }

    // Used.
    for (const Place& name : names_in(root, "extensionsUsed"))
        if (!is_supported(name.text())) document.warn(name, fmt::format("{} is ignored", name.text()));
}

bool lists_extension(const Place& root, std::string_view name) {
    for (const auto array : {"extensionsUsed", "extensionsRequired"})
        for (const Place& place : names_in(root, array))
            if (place.text() == name) return true;
    return false;
}

}  // namespace gridreel::anim::gltf
