#include "keyframes.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace gridreel::evaluator {
namespace {

std::vector<double> sum(double a, std::span<const double> v, double b, std::span<const double> w) {
    std::vector<double> result;
    for (std::size_t i = 0; i < v.size(); ++i) result.push_back(a * v[i] + b * w[i]);
    return result;
}

/// Section C.4 to the letter: with the keys as they stand in the file, also where these are unit quaternions
/// only to a few digits.
std::vector<double> slerp(std::span<const double> v, std::span<const double> w, double t) {
    double dot = 0;
    for (std::size_t i = 0; i < 4; ++i) dot += v[i] * w[i];
    const double a = std::acos(std::min(std::abs(dot), 1.0));
    const double s = dot < 0 ? -1.0 : 1.0;
    // "When a is close to zero, spherical linear interpolation turns into regular linear interpolation":
    // below 1e-6 they differ by less than 1e-12.
    if (a < 1e-6) return sum(1 - t, v, s * t, w);
    return sum(std::sin(a * (1 - t)) / std::sin(a), v, s * std::sin(a * t) / std::sin(a), w);
}

}  // namespace

std::vector<double> sample(const Keyframes& keys, double time_s) {
    const bool cubic = keys.interpolation == Interpolation::cubic_spline;
    const std::size_t last = keys.times_s.size() - 1;
    // In-tangent, value, out-tangent of a key, or its only value.
    const auto part = [&](std::size_t key, std::size_t which) {
        const std::size_t first = cubic ? 3 * key + which : key;
        return std::span(keys.values).subspan(first * keys.width, keys.width);
    };
    const auto value = [&](std::size_t key) { return part(key, 1); };
    const auto at_key = [&](std::size_t key) {
        return std::vector<double>(value(key).begin(), value(key).end());
    };

    if (time_s <= keys.times_s.front()) return at_key(0);
    if (time_s >= keys.times_s.back()) return at_key(last);
    std::size_t k = 0;
    while (keys.times_s[k + 1] <= time_s) ++k;
    if (keys.times_s[k] == time_s || keys.interpolation == Interpolation::step) return at_key(k);

    const double duration = keys.times_s[k + 1] - keys.times_s[k];
    const double t = (time_s - keys.times_s[k]) / duration;
    if (!cubic)
        return keys.is_rotation ? slerp(value(k), value(k + 1), t) : sum(1 - t, value(k), t, value(k + 1));

    const double t2 = t * t, t3 = t2 * t;
    const auto from = sum(2 * t3 - 3 * t2 + 1, value(k), duration * (t3 - 2 * t2 + t), part(k, 2));
    const auto to = sum(-2 * t3 + 3 * t2, value(k + 1), duration * (t3 - t2), part(k + 1, 0));
    return sum(1, from, 1, to);
}

}  // namespace gridreel::evaluator
