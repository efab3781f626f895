#include "anim/repeats.h"

#include "anim/sample_channel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace gridreel::anim {
namespace {

constexpr double rounding = 1e-5;

bool same_turn(const Sampler& sampler, double time_s, double other_time_s) {
    const glm::dquat a = sample_rotation(sampler, time_s), b = sample_rotation(sampler, other_time_s);
    const double side = glm::dot(a, b) < 0.0 ? -1.0 : 1.0;
    const glm::dquat apart = a - b * side;
    return glm::dot(apart, apart) <= rounding * rounding;
}

/// From the least to the greatest key of one number; tangents are no keys.
double way_of(const Sampler& sampler, std::size_t number) {
    const bool is_cubic = sampler.interpolation == Interpolation::cubic_spline;
    const std::size_t first = (is_cubic ? sampler.width : 0) + number;
    const std::size_t step = (is_cubic ? 3 : 1) * std::size_t{sampler.width};
    float least = sampler.values[first], greatest = least;
    for (std::size_t i = first; i < sampler.values.size(); i += step) {
        least = std::min(least, sampler.values[i]);
        greatest = std::max(greatest, sampler.values[i]);
    }
    return double(greatest) - double(least);
}

bool same_numbers(const Sampler& sampler, double time_s, double other_time_s) {
    std::vector<float> a(sampler.width), b(sampler.width);
    sample_numbers(sampler, time_s, a);
    sample_numbers(sampler, other_time_s, b);
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double apart = std::abs(double(a[i]) - double(b[i]));
        const double own = 4.0 * double(std::numeric_limits<float>::epsilon()) * std::abs(double(a[i]));
        if (apart > rounding * way_of(sampler, i) + own) return false;
    }
    return true;
}

/// How two values of a property are held against each other.
enum class Kind { turn, flag, numbers };

Kind kind_of(ChannelPath path) {
    if (path == ChannelPath::rotation) return Kind::turn;
    return path == ChannelPath::visibility ? Kind::flag : Kind::numbers;
}

bool same(Kind kind, const Sampler& sampler, double time_s, double other_time_s) {
    switch (kind) {
        case Kind::turn:
            return same_turn(sampler, time_s, other_time_s);
        case Kind::flag:
            return sample_flag(sampler, time_s) == sample_flag(sampler, other_time_s);
        default:
            return same_numbers(sampler, time_s, other_time_s);
    }
}

bool repeats(const Animation& animation, double time_s, double other_time_s) {
    // Each sampler once, however many channels share it.
    std::set<std::pair<Index, Kind>> played;
    for (const Channel& channel : animation.channels) played.emplace(channel.sampler, kind_of(channel.path));
    return std::all_of(played.begin(), played.end(), [&](const auto& sampler_and_kind) {
        const auto& [sampler, kind] = sampler_and_kind;
        return same(kind, animation.samplers[sampler], time_s, other_time_s);
    });
}

}  // namespace

bool repeats(const Scene& scene, const Clip& clip, double time_s, double other_time_s) {
    return std::all_of(clip.animations.begin(), clip.animations.end(),
                       [&](Index index) { return repeats(scene.animations[index], time_s, other_time_s); });
}

}  // namespace gridreel::anim
