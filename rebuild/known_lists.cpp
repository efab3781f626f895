#include "rebuild/known_lists.h"

#include <algorithm>

namespace gridreel::rebuild {

std::uint32_t copy_known(const KnownLists& known, const GridLevel& level, std::size_t begin, std::size_t end,
                         std::uint32_t* to, std::uint32_t* counts) {
    const std::uint32_t* const begins = level.cell_begin.data() + known.first_cell;
    const std::uint32_t* const references = level.references.data();
    if (known.only == nullptr) {
        const std::uint32_t all = begins[end] - begins[begin];
        std::copy_n(references + begins[begin], all, to);
        for (std::size_t c = begin; c < end; ++c) counts[c] += begins[c + 1] - begins[c];
        return all;
    }
    std::uint32_t kept = 0;
    for (std::size_t c = begin; c < end; ++c) {
        const std::uint32_t before = kept;
        for (std::uint32_t i = begins[c]; i < begins[c + 1]; ++i) {
            to[kept] = references[i];  // overwritten by the next if not kept
            kept += std::uint32_t{known.only->is_still(references[i])};
        }
        counts[c] += kept - before;
    }
    return kept;
}

void merge_known(const std::uint32_t* known, std::size_t begin, std::size_t end, const std::uint32_t* begins,
                 const std::uint32_t* behind_found, std::uint32_t* references) {
    for (std::size_t c = begin; c < end; ++c) {
        const std::uint32_t *const first = known, *const first_found = references + begins[c];
        known += begins[c + 1] - behind_found[c];
        // From the end, where nothing is that is still to be read.
        const std::uint32_t* found = references + behind_found[c];
        std::uint32_t* to = references + begins[c + 1];
        for (const std::uint32_t* next = known; next != first;) {
            const bool found_is_last = found != first_found && found[-1] > next[-1];
            *--to = found_is_last ? *--found : *--next;
        }
    }
}

}  // namespace gridreel::rebuild
