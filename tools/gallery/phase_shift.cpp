#include "tools/gallery/phase_shift.h"

#include "anim/sample_channel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace gridreel::gallery {

namespace {

using anim::ChannelPath;
using anim::Sampler;

std::vector<float> value_at(const Sampler& keys, ChannelPath path, double time_s) {
    std::vector<float> value(keys.width);
    if (path == ChannelPath::rotation) {
        const glm::dquat q = anim::sample_rotation(keys, time_s);
        value = {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
                 static_cast<float>(q.w)};
    } else if (path == ChannelPath::weights) {
        anim::sample_numbers(keys, time_s, value);
    } else {
        const glm::dvec3 v = anim::sample_vec3(keys, time_s);
        value = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    }
    return value;
}

/// Appends a key at `time_s`, or one step of a float after the last where rounding leaves no room.
void add_key(Sampler& keys, double time_s, const std::vector<float>& value) {
    float time = static_cast<float>(time_s);
    if (!keys.times_s.empty() && time <= keys.times_s.back())
        time = std::nextafter(keys.times_s.back(), std::numeric_limits<float>::infinity());
    keys.times_s.push_back(time);
    keys.values.insert(keys.values.end(), value.begin(), value.end());
}

Sampler without_splines(const Sampler& keys, ChannelPath path) {
    if (keys.interpolation != anim::Interpolation::cubic_spline) return keys;
    std::vector<float> times = keys.times_s;
    const double first = double(times.front()), last = double(times.back());
    for (int i = 1; first + i / 60.0 < last; ++i) times.push_back(static_cast<float>(first + i / 60.0));
    std::ranges::sort(times);
    times.erase(std::unique(times.begin(), times.end()), times.end());

    Sampler linear;
    linear.width = keys.width;
    for (const float time : times) add_key(linear, double(time), value_at(keys, path, double(time)));
    return linear;
}

}  // namespace

Sampler begun_at(const Sampler& keys, ChannelPath path, double phase_s, double duration_s) {
    const Sampler source = without_splines(keys, path);
    if (phase_s == 0.0) return source;

    Sampler shifted;
    shifted.width = source.width;
    shifted.interpolation = source.interpolation;
    const auto add = [&](double new_time_s, double time_s) {
        add_key(shifted, new_time_s, value_at(source, path, time_s));
    };
    // From the phase to the clip's end.
    add(0.0, phase_s);
    for (const float time : source.times_s)
        if (double(time) > phase_s) add(double(time) - phase_s, double(time));
    const double joint_s = duration_s - phase_s;
    if (double(source.times_s.back()) < duration_s) add(joint_s, duration_s);

    // From its start to the phase.
    add(joint_s, 0.0);
    for (const float time : source.times_s)
        if (time > 0.0f && double(time) < phase_s) add(joint_s + double(time), double(time));
    add(duration_s, phase_s);
    return shifted;
}

}  // namespace gridreel::gallery
