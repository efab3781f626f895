#pragma once
// One animated property between its keys (glTF 2.0, section 3.11 and appendix C).

#include "accessor.h"

#include <cstddef>
#include <vector>

namespace gridreel::evaluator {

enum class Interpolation { step, linear, cubic_spline };

struct Keyframes {
    std::vector<double> times_s;  ///< increasing
    /// `width` numbers per key, or in-tangent, value and out-tangent of `width` numbers each (cubic spline).
    std::vector<double> values;
    std::size_t width = 1;
    Interpolation interpolation = Interpolation::linear;
    bool is_rotation = false;  ///< values are unit quaternions: linear means along the great circle
};

/// The property at `time_s`: `width` numbers. Clamped to the nearest key outside of the keys; the key's value
/// as it is where there is a key at that time. A quaternion between keys need not have unit length.
[[nodiscard]] std::vector<double> sample(const Keyframes& keys, double time_s);

}  // namespace gridreel::evaluator
