#include "anim/sample_channel.h"

#include "anim/rotation.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>

namespace gridreel::anim {
namespace {

/// A time's place among the keys: `u` of the way from `key` to the next. The next is not looked at
/// when u is 0, for there may be none.
struct Place {
    std::size_t key = 0;
    double u = 0.0;           ///< in [0, 1)
    double interval_s = 0.0;  ///< between the two keys
};

Place find_place(const Sampler& sampler, double time_s) {
    const std::vector<float>& times = sampler.times_s;
    if (!(time_s > double(times.front()))) return {.key = 0};
    if (time_s >= double(times.back())) return {.key = times.size() - 1};

    const auto next = std::upper_bound(times.begin(), times.end(), time_s,
                                       [](double time, float key) { return time < double(key); });
    const std::size_t key = static_cast<std::size_t>(next - times.begin()) - 1;
    if (sampler.interpolation == Interpolation::step) return {.key = key};
    const double interval_s = double(times[key + 1]) - double(times[key]);
    return {.key = key, .u = (time_s - double(times[key])) / interval_s, .interval_s = interval_s};
}

/// The three numbers a cubic key keeps per component; other keys have only the value.
enum class Part : std::size_t { in_tangent, value, out_tangent };

double stored(const Sampler& sampler, std::size_t key, Part part, std::size_t component) {
    const bool cubic = sampler.interpolation == Interpolation::cubic_spline;
    const std::size_t block = cubic ? key * 3 + static_cast<std::size_t>(part) : key;
    return double(sampler.values[block * sampler.width + component]);
}

/// Linear or cubic, one component. Both start from the first key's value and add what changes, so that
/// equal keys give exactly their value at every time.
double interpolate(const Sampler& sampler, const Place& at, std::size_t component) {
    const double value = stored(sampler, at.key, Part::value, component);
    if (at.u == 0.0) return value;
    const double u = at.u;
    const double rise = stored(sampler, at.key + 1, Part::value, component) - value;
    if (sampler.interpolation != Interpolation::cubic_spline) return value + u * rise;

    // Appendix C.5, with 2u^3 - 3u^2 + 1 = 1 - (3u^2 - 2u^3).
    const double leaving = stored(sampler, at.key, Part::out_tangent, component);
    const double arriving = stored(sampler, at.key + 1, Part::in_tangent, component);
    return value + u * u * (3.0 - 2.0 * u) * rise +
           at.interval_s * (u * (1.0 - u) * (1.0 - u) * leaving + u * u * (u - 1.0) * arriving);
}

glm::dquat stored_rotation(const Sampler& sampler, std::size_t key) {
    const auto at = [&](std::size_t component) { return stored(sampler, key, Part::value, component); };
    return {at(3), at(0), at(1), at(2)};
}

}  // namespace

glm::dvec3 sample_vec3(const Sampler& sampler, double time_s) {
    assert(sampler.width == 3);
    const Place at = find_place(sampler, time_s);
    return {interpolate(sampler, at, 0), interpolate(sampler, at, 1), interpolate(sampler, at, 2)};
}

glm::dquat sample_rotation(const Sampler& sampler, double time_s) {
    assert(sampler.width == 4);
    const Place at = find_place(sampler, time_s);
    if (at.u > 0.0 && sampler.interpolation == Interpolation::linear) {
        return slerp_shortest(stored_rotation(sampler, at.key), stored_rotation(sampler, at.key + 1), at.u);
    }
    return unit_or_identity({interpolate(sampler, at, 3), interpolate(sampler, at, 0),
                             interpolate(sampler, at, 1), interpolate(sampler, at, 2)});
}

void sample_numbers(const Sampler& sampler, double time_s, std::span<float> values) {
    assert(sampler.width == values.size());
    const Place at = find_place(sampler, time_s);
    for (std::size_t i = 0; i < values.size(); ++i) {
        // Splines swing past their keys, and so past what a float holds.
        constexpr double most = double(std::numeric_limits<float>::max());
        values[i] = static_cast<float>(std::clamp(interpolate(sampler, at, i), -most, most));
    }
}

bool sample_flag(const Sampler& sampler, double time_s) {
    return stored(sampler, find_place(sampler, time_s).key, Part::value, 0) != 0.0;
}

bool varies(const Sampler& sampler) {
    const std::size_t keys = sampler.times_s.size();
    if (keys < 2) return false;
    for (std::size_t key = 0; key < keys; ++key) {
        for (std::size_t i = 0; i < sampler.width; ++i) {
            if (stored(sampler, key, Part::value, i) != stored(sampler, 0, Part::value, i)) return true;
            if (sampler.interpolation != Interpolation::cubic_spline) continue;
            if (stored(sampler, key, Part::in_tangent, i) != 0.0) return true;
            if (stored(sampler, key, Part::out_tangent, i) != 0.0) return true;
        }
    }
    return false;
}

}  // namespace gridreel::anim
