#include "anim/gltf/undrawn_looks.h"

#include "anim/animated_properties.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace gridreel::anim::gltf {
namespace {

struct Look {
    std::string_view place;  ///< property or extension of a material
    std::string_view words;
    bool (*shows)(const Material&) = [](const Material&) { return true; };
    std::string_view fate = "it is not drawn yet";
};

/// Whether a value that pointers drive can switch a look on: a roughness, say, cannot.
bool is_switch(std::string_view property) {
    constexpr std::array<std::string_view, 9> switches{"scale",
                                                       "strength",
                                                       "ior",
                                                       "specularFactor",
                                                       "specularColorFactor",
                                                       "clearcoatFactor",
                                                       "sheenColorFactor",
                                                       "transmissionFactor",
                                                       "thicknessFactor"};
    return std::find(switches.begin(), switches.end(), property) != switches.end();
}

constexpr std::array looks{
    Look{"normalTexture", "a normal map", [](const Material& m) { return m.normal_scale != 0.0f; }},
    Look{"occlusionTexture", "an occlusion map",
         [](const Material& m) { return m.occlusion_strength != 0.0f; }},
    Look{"KHR_materials_ior", "an index of refraction other than 1.5",
         [](const Material& m) { return m.ior != 1.5f; }},
    Look{"KHR_materials_specular", "reflections of a strength or colour other than the default",
         [](const Material& m) {
             const Specular& s = m.specular;
             return s.factor != 1.0f || s.color != glm::vec3(1.0f) || s.texture || s.color_texture;
         }},
    Look{"KHR_materials_clearcoat", "a clearcoat",
         [](const Material& m) { return m.clearcoat.factor > 0.0f; }},
    Look{"KHR_materials_sheen", "a sheen",
         [](const Material& m) { return m.sheen.color != glm::vec3(0.0f); }},
    Look{"KHR_materials_transmission", "transmission",
         [](const Material& m) { return m.transmission.factor > 0.0f; },
         "until it is drawn, such surfaces are opaque"},
    Look{"KHR_materials_volume", "a volume", [](const Material& m) { return m.volume.thickness_m > 0.0f; }},
    Look{"KHR_materials_anisotropy", "anisotropy"},
    Look{"KHR_materials_diffuse_transmission", "diffuse transmission"},
    Look{"KHR_materials_dispersion", "dispersion"},
    Look{"KHR_materials_iridescence", "iridescence"},
};

bool is_extension(std::string_view place) {
    return place.starts_with("KHR_");
}

std::optional<Place> find_look(const Place& material, std::string_view place) {
    return is_extension(place) ? material.find_extension(place) : material.find(place);
}

/// Whether a pointer drives what switches the look on.
bool switches(std::string_view pointer, std::string_view place) {
    constexpr std::string_view extensions = "extensions/";
    if (is_extension(place) && pointer.starts_with(extensions)) pointer.remove_prefix(extensions.size());
    return pointer.starts_with(place) && pointer.substr(place.size()).starts_with('/') &&
           is_switch(pointer.substr(place.size() + 1));
}

/// The materials whose look an animation drives, one flag each.
std::vector<bool> animated(const Scene& scene, const Look& look) {
    std::vector<bool> is_animated(scene.materials.size(), false);
    for (const Animation& animation : scene.animations)
        for (const Channel& channel : animation.channels)
            if (channel.path == ChannelPath::material &&
                switches(material_properties()[channel.property].pointer, look.place))
                is_animated[channel.object] = true;
    return is_animated;
}

}  // namespace

void warn_of_undrawn_looks(Document& document, const Scene& scene) {
    const std::vector<Material>& materials = scene.materials;
    const auto places = document.all("materials");
    for (const Look& look : looks) {
        const std::vector<bool> is_animated = animated(scene, look);
        std::optional<Place> first;
        std::size_t count = 0;
        for (std::size_t i = 0; i < materials.size(); ++i) {
            const auto place = find_look(places[i], look.place);
            if (!place || materials[i].unlit || !(look.shows(materials[i]) || is_animated[i])) continue;
            if (!first) first = place;
            ++count;
        }
        if (!first) continue;
        document.warn(*first,
                      fmt::format("{} {} {}; {}", count, count == 1 ? "material has" : "materials have",
                                  look.words, look.fate));
    }
}

}  // namespace gridreel::anim::gltf
