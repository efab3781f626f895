#pragma once
// Accessors as plain numbers (glTF 2.0, section 3.6.2).

#include "file.h"

#include <cstddef>
#include <span>
#include <vector>

namespace gridreel::evaluator {

/// Elements of `width` numbers each, one after another.
struct Table {
    std::size_t width = 1;
    std::vector<double> values;

    [[nodiscard]] std::size_t count() const { return values.size() / width; }
    [[nodiscard]] std::span<const double> operator[](std::size_t element) const {
        return std::span(values).subspan(element * width, width);
    }
};

/// All elements of an accessor, sparse substitutions made, normalised integers as the fractions they stand
/// for. Matrices of one- or two-byte components, whose columns are padded, are not read: geometry has none.
/// @throws std::exception when it reads past its bytes
[[nodiscard]] Table read_accessor(const File& file, std::size_t index);

}  // namespace gridreel::evaluator
