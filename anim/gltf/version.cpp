#include "anim/gltf/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace gridreel::anim::gltf {
namespace {

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

}  // namespace

void check_version(const Place& root) {
    if (!std::holds_alternative<Json::Object>(root.json().value))
        root.refuse("the JSON is not an object", "this does not look like glTF: check the file");
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

}  // namespace gridreel::anim::gltf
