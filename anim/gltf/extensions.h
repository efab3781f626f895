#pragma once
// Which extensions of glTF are understood, and what becomes of each.

#include "anim/gltf/document.h"

#include <span>
#include <string_view>

namespace gridreel::anim::gltf {

/// What becomes of an extension.
enum class Treatment {
    honoured,      ///< as its specification says
    approximated,  ///< accepted even when required; what differs is warned of where it shows
    ignored,       ///< accepted without a word: no picture could show it
    refused,       ///< when a file requires it; where one merely uses it, a warning
};

struct Extension {
    std::string_view name;
    Treatment treatment = Treatment::honoured;
    std::string_view note{};  ///< approximated: how; refused: what the user can do
};

/// Every extension that is known, by name.
[[nodiscard]] std::span<const Extension> known_extensions();

/// The entry of that name; null for an extension that is not known.
[[nodiscard]] const Extension* find_extension(std::string_view name);

/// Refuses files that require more than is understood, and warns of what is used but ignored (glTF 2.0,
/// section 3.12). Needs nothing validated but that the root is an object.
///
/// @throws Error naming every extension that is required and refused or unknown, with all remedies
void check_extensions(Document& document);

/// Whether the file lists the extension as required; or as used or required.
[[nodiscard]] bool requires_extension(const Place& root, std::string_view name);
[[nodiscard]] bool lists_extension(const Place& root, std::string_view name);

}  // namespace gridreel::anim::gltf
