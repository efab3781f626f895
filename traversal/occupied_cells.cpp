#include "traversal/occupied_cells.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace gridreel::traversal {

void OccupiedCells::rebuild(const rebuild::Grid& grid) {
    constexpr std::size_t words_per_task = 1024;
    for (std::size_t depth = 0; depth < words_.size(); ++depth) {
        const rebuild::Buffer<std::uint32_t>& begin = grid.levels[depth].cell_begin;
        const std::size_t cells = begin.size() == 0 ? 0 : begin.size() - 1;
        words_[depth].resize((cells + 63) / 64);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, words_[depth].size(), words_per_task),
                          [&](const auto& range) {
                              for (std::size_t i = range.begin(); i < range.end(); ++i) {
                                  const std::uint32_t* const first = begin.data() + 64 * i;
                                  const std::size_t count = std::min<std::size_t>(64, cells - 64 * i);
                                  std::uint64_t word = 0;
                                  for (std::size_t bit = 0; bit < count; ++bit) {
                                      word |= std::uint64_t{first[bit] != first[bit + 1]} << bit;
                                  }
                                  words_[depth][i] = word;
                              }
                          });
    }
}

}  // namespace gridreel::traversal
