#include "agreement.h"

#include "anim/clip.h"
#include "anim/frame_geometry.h"
#include "anim/load.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace gridreel::test {
namespace {

constexpr double position_tolerance = 1e-5;  // of the bounding box's diagonal
constexpr double normal_tolerance = 1e-3;

double diagonal(const evaluator::Frame& frame) {
    evaluator::Vec3 extent{};
    for (std::size_t axis = 0; axis < 3 && !frame.positions.empty(); ++axis) {
        const auto [low, high] =
            std::minmax_element(frame.positions.begin(), frame.positions.end(),
                                [&](const auto& a, const auto& b) { return a[axis] < b[axis]; });
        extent[axis] = (*high)[axis] - (*low)[axis];
    }
    return std::hypot(extent[0], extent[1], extent[2]);
}

double distance(const evaluator::Vec3& a, const glm::vec3& b) {
    return std::hypot(a[0] - double(b.x), a[1] - double(b.y), a[2] - double(b.z));
}

/// Where two lists of vectors differ most.
struct Worst {
    double distance = 0.0;
    std::size_t vertex = 0;
};

Worst compare(std::span<const evaluator::Vec3> expected, std::span<const glm::vec3> found) {
    Worst worst;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const double d = distance(expected[i], found[i]);
        if (d <= worst.distance) continue;  // a NaN is worse than anything
        worst = {d, i};
        if (std::isnan(d)) break;
    }
    return worst;
}

std::vector<double> times_to_try(const evaluator::Clip& clip) {
    if (clip.channels.empty()) return {0.0, 1.0};
    std::set<double> distinct;
    for (const auto& channel : clip.channels)
        distinct.insert(channel.keys.times_s.begin(), channel.keys.times_s.end());
    const std::vector<double> keys(distinct.begin(), distinct.end());

    // Past the end, then from the middle outwards: never the order in which a clip plays.
    std::vector<double> times{clip.end_s + 1.0, 0.0, clip.end_s, -0.5};
    for (const std::size_t quarter : {2u, 3u, 0u, 1u}) {
        const std::size_t key = quarter * (keys.size() - 1) / 4, next = std::min(key + 1, keys.size() - 1);
        times.push_back(keys[key]);
        times.push_back(keys[key] + (0.2 + 0.15 * double(quarter)) * (keys[next] - keys[key]));
    }
    return times;
}

std::size_t check_clip(const anim::Scene& scene, const evaluator::Model& model, std::size_t scene_index,
                       const std::string& choice, const std::vector<std::size_t>& animations) {
    CAPTURE(scene_index, choice);
    const auto clip = anim::choose_clip(scene, choice, static_cast<anim::Index>(scene_index));
    CHECK(std::vector<std::size_t>(clip.animations.begin(), clip.animations.end()) == animations);
    const evaluator::Film film(model, animations, scene_index);
    CHECK(clip.duration_s == film.clip().end_s);

    anim::FrameGeometry geometry = anim::lay_out(scene, clip);
    const auto times = times_to_try(film.clip());
    for (const double time_s : times) {
        CAPTURE(time_s);
        anim::deform(scene, anim::pose(scene, clip, time_s), geometry);
        check_frame(film.at(time_s), geometry.positions, geometry.normals, geometry.triangles);
    }
    return times.size();
}

}  // namespace

void check_frame(const evaluator::Frame& expected, std::span<const glm::vec3> positions,
                 std::span<const glm::vec3> normals, std::span<const glm::uvec3> triangles) {
    REQUIRE(positions.size() == expected.positions.size());
    REQUIRE(normals.size() == expected.normals.size());
    REQUIRE(triangles.size() == expected.triangles.size());
    const Worst place = compare(expected.positions, positions);
    const double size = diagonal(expected);
    if (!(place.distance <= position_tolerance * size)) {
        const auto& e = expected.positions[place.vertex];
        const auto& f = positions[place.vertex];
        CAPTURE(place.vertex, place.distance / size, e[0], e[1], e[2], f.x, f.y, f.z);
        CHECK(place.distance <= position_tolerance * size);
    }
    const Worst normal = compare(expected.normals, normals);
    if (!(normal.distance <= normal_tolerance)) {
        const auto& e = expected.normals[normal.vertex];
        const auto& f = normals[normal.vertex];
        CAPTURE(normal.vertex, e[0], e[1], e[2], f.x, f.y, f.z);
        CHECK(normal.distance <= normal_tolerance);
    }
    std::size_t same = 0;
    for (std::size_t i = 0; i < expected.triangles.size(); ++i) {
        const auto& [a, b, c] = expected.triangles[i];
        if (triangles[i] == glm::uvec3(a, b, c)) ++same;
    }
    CHECK(same == expected.triangles.size());
}

std::size_t check_agreement(const std::filesystem::path& file) {
    CAPTURE(file);
    const anim::Scene scene = anim::load(file);
    const evaluator::Model model = evaluator::read_model(file);
    CHECK(scene.default_scene == evaluator::default_scene(model.file));

    std::size_t compared = 0;
    for (std::size_t scene_index = 0; scene_index < scene.scenes.size(); ++scene_index) {
        compared +=
            check_clip(scene, model, scene_index, "auto", evaluator::animations_by_default(model.file));
        if (scene.animations.size() < 2) continue;
        for (std::size_t animation = 0; animation < scene.animations.size(); ++animation)
            compared += check_clip(scene, model, scene_index, std::to_string(animation), {animation});
    }
    return compared;
}

}  // namespace gridreel::test
