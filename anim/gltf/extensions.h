#pragma once
// Which versions and extensions of glTF are understood.

#include "anim/gltf/document.h"

namespace gridreel::anim::gltf {

/// Refuses files that ask for more than is understood, and warns about extensions that are used but ignored
/// (glTF 2.0, sections 3.2 and 3.12). Needs nothing validated but that the text is JSON.
///
/// @throws Error naming the version, or every extension that is required and unsupported
void check_version_and_extensions(Document& document);

/// Whether the file lists the extension as used or required.
[[nodiscard]] bool lists_extension(const Place& root, std::string_view name);

}  // namespace gridreel::anim::gltf
