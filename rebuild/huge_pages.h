#pragma once
// Memory in pages of megabytes instead of kilobytes.

#include <cstddef>

namespace gridreel::rebuild {

/// Asks the system to back what is written from now on to this memory by huge pages, where it has such: a
/// processor remembers where a few thousand pages are, and a counting sort of a million triangles writes to
/// all of them in turn. A hint, without which nothing but time is lost; less than a few such pages stay as
/// they are.
void ask_for_huge_pages(void* memory, std::size_t bytes);

}  // namespace gridreel::rebuild
