#include "anim/gltf/undrawn_looks.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace gridreel::anim::gltf {
namespace {

struct Look {
    std::string_view property;
    std::string_view article;
};

constexpr std::array looks{Look{"normalTexture", "a"}, Look{"occlusionTexture", "an"}};

}  // namespace

void warn_of_undrawn_looks(Document& document) {
    for (const auto& [property, article] : looks) {
        std::optional<Place> first;
        std::size_t count = 0;
        for (const Place& material : document.all("materials")) {
            const auto texture = material.find(property);
            if (!texture) continue;
            if (!first) first = texture;
            ++count;
        }
        if (!first) continue;
        document.warn(*first, fmt::format("{} {} {} {}; it is not drawn yet", count,
                                          count == 1 ? "material has" : "materials have", article, property));
    }
}

}  // namespace gridreel::anim::gltf
