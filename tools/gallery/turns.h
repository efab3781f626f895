#pragma once
// Sine and cosine of angles in turns, the same bits with every C library.

#include <cmath>

namespace gridreel::gallery {

/// sin(2 pi x), by the Taylor series on a quarter turn; error below 1e-15.
/// Whole turns are taken off exactly, so that sin_turns(x + 1) closes a loop.
[[nodiscard]] inline double sin_turns(double x) {
    double r = x - std::floor(x + 0.5);
    if (r > 0.25) r = 0.5 - r;
    if (r < -0.25) r = -0.5 - r;
    const double a = r * 6.283185307179586;
    double sum = 0.0;
    for (int n = 21; n >= 3; n -= 2) sum = (1.0 + sum) * (-a * a / double(n * (n - 1)));
    return a * (1.0 + sum);
}

[[nodiscard]] inline double cos_turns(double x) {
    return sin_turns(x + 0.25);
}

}  // namespace gridreel::gallery
