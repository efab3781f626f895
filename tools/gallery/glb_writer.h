#pragma once
// A document as the bytes of a .glb file (glTF 2.0, chapter 4).

#include "tools/gallery/document.h"

#include <iosfwd>

namespace gridreel::gallery {

/// Writes the header, the JSON chunk and the binary chunk. The bytes depend on the document alone.
/// @throws Error when the file would reach 4 GiB, the most that a .glb can hold
void write_glb(const Document& document, std::ostream& out);

}  // namespace gridreel::gallery
