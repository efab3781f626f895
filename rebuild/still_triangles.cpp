#include "rebuild/still_triangles.h"

#include <stdexcept>
#include <utility>

namespace gridreel::rebuild {

StillTriangles::StillTriangles(std::size_t count, std::vector<TriangleRun> runs)
    : runs_(std::move(runs)), is_still_(count, false) {
    std::size_t still = 0, end = 0;
    for (const TriangleRun& run : runs_) {
        if (run.begin < end || run.end < run.begin || run.end > count) {
            throw std::invalid_argument("runs of still triangles must ascend, and end with the triangles");
        }
        for (std::size_t i = run.begin; i < run.end; ++i) is_still_[i] = true;
        still += run.end - run.begin;
        end = run.end;
    }
    few_move_ = count > 0 && count - still <= count / 2;
    if (!few_move_) return;
    few_moving_.reserve(count - still);
    for (std::size_t i = 0; i < count; ++i) {
        if (!is_still_[i]) few_moving_.push_back(static_cast<std::uint32_t>(i));
    }
}

std::size_t StillTriangles::bytes() const {
    constexpr std::size_t flags_per_byte = 8;
    return runs_.capacity() * sizeof(TriangleRun) + is_still_.capacity() / flags_per_byte +
           few_moving_.capacity() * sizeof(std::uint32_t);
}

}  // namespace gridreel::rebuild
