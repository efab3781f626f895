#include "anim/gltf/extensions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace gridreel::anim::gltf {
namespace {

using enum Treatment;

constexpr std::string_view plain_images = "export the model with PNG or JPEG textures";
constexpr std::string_view left_out = "export the model without what is not supported";
constexpr std::string_view undrawn = "read, and not drawn yet";
constexpr std::string_view unread = "not read: surfaces are drawn without it";

constexpr std::array extensions{
    Extension{"EXT_mesh_gpu_instancing", honoured},
    Extension{"EXT_meshopt_compression", honoured},
    Extension{"EXT_texture_avif", refused, plain_images},
    Extension{"EXT_texture_webp", honoured},
    Extension{"KHR_animation_pointer", honoured},
    Extension{"KHR_draco_mesh_compression", honoured},
    Extension{"KHR_interactivity", refused, left_out},
    Extension{"KHR_lights_punctual", honoured},
    Extension{"KHR_materials_anisotropy", approximated, unread},
    Extension{"KHR_materials_clearcoat", approximated, undrawn},
    Extension{"KHR_materials_diffuse_transmission", approximated, unread},
    Extension{"KHR_materials_dispersion", approximated, unread},
    Extension{"KHR_materials_emissive_strength", honoured},
    Extension{"KHR_materials_ior", approximated, undrawn},
    Extension{"KHR_materials_iridescence", approximated, unread},
    Extension{"KHR_materials_pbrSpecularGlossiness", refused,
              "convert the materials: npx @gltf-transform/cli metalrough IN.glb OUT.glb"},
    Extension{"KHR_materials_sheen", approximated, undrawn},
    Extension{"KHR_materials_specular", approximated, undrawn},
    Extension{"KHR_materials_transmission", approximated, "read, and drawn opaque until it is shaded"},
    Extension{"KHR_materials_unlit", honoured},
    Extension{"KHR_materials_variants", honoured},
    Extension{"KHR_materials_volume", approximated, undrawn},
    Extension{"KHR_mesh_quantization", honoured},
    Extension{"KHR_meshopt_compression", approximated,
              "but for the second version of attributes and the colour filter, which are refused"},
    Extension{"KHR_node_hoverability", ignored},
    Extension{"KHR_node_selectability", ignored},
    Extension{"KHR_node_visibility", honoured},
    Extension{"KHR_texture_basisu", approximated,
              "drawn from the texture's other image; refused where there is none"},
    Extension{"KHR_texture_transform", honoured},
    Extension{"KHR_xmp", ignored},
    Extension{"KHR_xmp_json_ld", ignored},
    Extension{"MSFT_texture_dds", refused, plain_images},
};

std::vector<Place> names_in(const Place& root, std::string_view array) {
    std::vector<Place> names;
    const auto found = root.find(array);
    for (std::size_t i = 0; found && i < found->size(); ++i) names.push_back((*found)[i]);
    return names;
}

bool lists(const Place& root, std::string_view array, std::string_view name) {
    const std::vector<Place> names = names_in(root, array);
    return std::any_of(names.begin(), names.end(), [&](const Place& place) { return place.text() == name; });
}

void check_required(const Place& root) {
    std::vector<std::string> missing;
    std::vector<std::string_view> remedies;
    for (const Place& name : names_in(root, "extensionsRequired")) {
        const Extension* const extension = find_extension(name.text());
        if (extension && extension->treatment != refused) continue;
        missing.push_back(name.text());
        const std::string_view remedy = extension ? extension->note : left_out;
        if (std::find(remedies.begin(), remedies.end(), remedy) == remedies.end()) remedies.push_back(remedy);
    }
    if (missing.empty()) return;
    root.at("extensionsRequired")
        .refuse(fmt::format("the model requires {}, which {} not supported", fmt::join(missing, ", "),
                            missing.size() == 1 ? "is" : "are"),
                fmt::format("{}", fmt::join(remedies, "; ")));
}

}  // namespace

std::span<const Extension> known_extensions() {
    return extensions;
}

const Extension* find_extension(std::string_view name) {
    const auto* const found = std::find_if(extensions.begin(), extensions.end(),
                                           [&](const Extension& entry) { return entry.name == name; });
    return found == extensions.end() ? nullptr : found;
}

void check_extensions(Document& document) {
    const Place root = document.root();
    check_required(root);
    for (const Place& name : names_in(root, "extensionsUsed")) {
        const Extension* const extension = find_extension(name.text());
        if (!extension) {
            document.warn(name, fmt::format("{} is not known; it is ignored", name.text()));
        } else if (extension->treatment == refused) {
            document.warn(
                name, fmt::format("{} is not supported; it is ignored ({})", name.text(), extension->note));
        }
    }
}

bool requires_extension(const Place& root, std::string_view name) {
    return lists(root, "extensionsRequired", name);
}

bool lists_extension(const Place& root, std::string_view name) {
    return lists(root, "extensionsUsed", name) || requires_extension(root, name);
}

}  // namespace gridreel::anim::gltf
