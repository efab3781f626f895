#include "anim/gltf/undrawn_looks.h"

#include "anim/animated_properties.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

namespace gridreel::anim::gltf {
namespace {

struct Look {
    std::string_view place;  ///< property or extension of a material
    std::string_view words;
    bool (*shows)(const Material&) = [](const Material&) { return true; };
    /// What animations may drive to switch it on, as pointers below the material name it.
    std::array<std::string_view, 2> switches{};
    std::string_view fate = "it is not drawn yet";
};

constexpr std::array looks{
    Look{"normalTexture",
         "a normal map",
         [](const Material& m) { return m.normal_scale != 0.0f; },
         {"normalTexture/scale"}},
    Look{"occlusionTexture",
         "an occlusion map",
         [](const Material& m) { return m.occlusion_strength != 0.0f; },
         {"occlusionTexture/strength"}},
    Look{"KHR_materials_ior",
         "an index of refraction other than 1.5",
         [](const Material& m) { return m.ior != 1.5f; },
         {"extensions/KHR_materials_ior/ior"}},
    Look{"KHR_materials_specular",
         "reflections of a strength or colour other than the default",
         [](const Material& m) {
             const Specular& s = m.specular;
             return s.factor != 1.0f || s.color != glm::vec3(1.0f) || s.texture || s.color_texture;
         },
         {"extensions/KHR_materials_specular/specularFactor",
          "extensions/KHR_materials_specular/specularColorFactor"}},
    Look{"KHR_materials_clearcoat",
         "a clearcoat",
         [](const Material& m) { return m.clearcoat.factor > 0.0f; },
         {"extensions/KHR_materials_clearcoat/clearcoatFactor"}},
    Look{"KHR_materials_sheen",
         "a sheen",
         [](const Material& m) { return m.sheen.color != glm::vec3(0.0f); },
         {"extensions/KHR_materials_sheen/sheenColorFactor"}},
    Look{"KHR_materials_transmission",
         "transmission",
         [](const Material& m) { return m.transmission.factor > 0.0f; },
         {"extensions/KHR_materials_transmission/transmissionFactor"},
         "until it is drawn, such surfaces are opaque"},
    Look{"KHR_materials_volume",
         "a volume",
         [](const Material& m) { return m.volume.thickness_m > 0.0f; },
         {"extensions/KHR_materials_volume/thicknessFactor"}},
    Look{"KHR_materials_anisotropy", "anisotropy"},
    Look{"KHR_materials_diffuse_transmission", "diffuse transmission"},
    Look{"KHR_materials_dispersion", "dispersion"},
    Look{"KHR_materials_iridescence", "iridescence"},
};

std::optional<Place> find_look(const Place& material, std::string_view place) {
    return place.starts_with("KHR_") ? material.find_extension(place) : material.find(place);
}

/// What animations drive of each material, as pointers below it.
std::vector<std::set<std::string_view>> driven_properties(const Scene& scene) {
    std::vector<std::set<std::string_view>> driven(scene.materials.size());
    for (const Animation& animation : scene.animations)
        for (const Channel& channel : animation.channels)
            if (channel.path == ChannelPath::material)
                driven[channel.object].insert(material_properties()[channel.property].pointer);
    return driven;
}

bool can_switch_on(const Look& look, const std::set<std::string_view>& driven) {
    return std::ranges::any_of(look.switches,
                               [&](std::string_view pointer) { return driven.contains(pointer); });
}

}  // namespace

void warn_of_undrawn_looks(Document& document, const Scene& scene) {
    const std::vector<Material>& materials = scene.materials;
    const auto places = document.all("materials");
    const auto driven = driven_properties(scene);
    for (const Look& look : looks) {
        std::optional<Place> first;
        std::size_t count = 0;
        for (std::size_t i = 0; i < materials.size(); ++i) {
            const auto place = find_look(places[i], look.place);
            if (!place || materials[i].unlit) continue;
            if (!look.shows(materials[i]) && !can_switch_on(look, driven[i])) continue;
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
