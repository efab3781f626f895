#include "anim/variants.h"

#include "anim/error.h"
#include "anim/parse_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace gridreel::anim {
namespace {

std::string names_of(const std::vector<std::string>& variants) {
    if (variants.empty()) return "the file has no variants: leave the option out";
    std::string names = "choose one of";
    for (std::size_t i = 0; i < variants.size(); ++i) {
        names += fmt::format("{} {} \"{}\"", i == 0 ? "" : ",", i, variants[i]);
    }
    return names;
}

}  // namespace

Index choose_variant(const Scene& scene, std::string_view choice) {
    // As with animations, a name wins over a number.
    const auto named = std::find(scene.variants.begin(), scene.variants.end(), choice);
    if (named != scene.variants.end()) return static_cast<Index>(named - scene.variants.begin());
    if (const auto number = parse_number<std::size_t>(choice); number && *number < scene.variants.size()) {
        return static_cast<Index>(*number);
    }
    throw Error(fmt::format("no variant \"{}\"", choice), "--variant", names_of(scene.variants));
}

void show_variant(Scene& scene, Index variant) {
    for (Mesh& mesh : scene.meshes) {
        for (Primitive& primitive : mesh.primitives) {
            for (const VariantMaterial& look : primitive.variant_materials) {
                if (look.variant == variant) primitive.material = look.material;
            }
        }
    }
}

}  // namespace gridreel::anim
