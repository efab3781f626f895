#pragma once
// A document as the bytes of a .glb file (glTF 2.0, chapter 4).

#include "tools/gallery/document.h"

#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>

namespace gridreel::gallery {

/// Writes the header, the JSON chunk and the binary chunk. The bytes depend on the document alone.
/// @throws Error when the file would reach 4 GiB, the most that a .glb can hold
void write_glb(const Document& document, std::ostream& out);

/// The same for JSON that is a text already: writes the header, the JSON chunk and the binary chunk's
/// head. The caller then writes `binary_size` bytes, a multiple of 4.
///
/// @param name  of the scene, for the error
void write_glb_head(std::string json, std::size_t binary_size, std::string_view name, std::ostream& out);

}  // namespace gridreel::gallery
