#pragma once
// The looks between which a file offers a choice (KHR_materials_variants).

#include "anim/scene.h"

#include <string_view>

namespace gridreel::anim {

/// The variant of that name; else, when it is a number, the one so numbered.
/// @throws Error listing the variants when there is none
[[nodiscard]] Index choose_variant(const Scene& scene, std::string_view choice);

/// Gives every primitive its material in the variant; those that it does not mention keep their own.
void show_variant(Scene& scene, Index variant);

}  // namespace gridreel::anim
