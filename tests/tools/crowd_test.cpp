#include "tools/gallery/crowd.h"
#include "anim/error.h"
#include "anim/sample_channel.h"
#include "tests/tools/played.h"
#include "tools/gallery/phase_shift.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

using namespace gridreel;
using namespace gridreel::gallery;

namespace {

const std::filesystem::path bundled(GRIDREEL_GALLERY_FOLDER);

std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

anim::Sampler linear_keys(std::vector<float> times_s, std::vector<float> values) {
    anim::Sampler keys;
    keys.times_s = std::move(times_s);
    keys.values = std::move(values);
    keys.width = 1;
    return keys;
}

float weight_at(const anim::Sampler& keys, double time_s) {
    float weight = 0.0f;
    anim::sample_numbers(keys, time_s, std::span(&weight, 1));
    return weight;
}

/// The phase of a copy, by its definition: multiples of the golden section.
double phase(std::size_t copy, double duration_s) {
    return std::fmod(double(copy) * 0.618033988749895, 1.0) * duration_s;
}

}  // namespace

TEST_CASE("a clip begun in its middle starts there, jumps at its end, and comes back", "[gallery]") {
    // Up from 0 to 8 in 4 s, begun at 3: 6, 8, then from 0 up to 6.
    const anim::Sampler keys = linear_keys({0, 2, 4}, {0, 4, 8});
    const anim::Sampler shifted = begun_at(keys, anim::ChannelPath::weights, 3.0, 4.0);
    CHECK(shifted.times_s == std::vector<float>{0, 1, std::nextafter(1.0f, 2.0f), 3, 4});
    CHECK(shifted.values == std::vector<float>{6, 8, 0, 4, 6});
}

TEST_CASE("keys that begin late and end early are held as a player holds them", "[gallery]") {
    // 5 until 1 s, then down to 3 at 2 s, held until the clip's end at 4 s.
    const anim::Sampler keys = linear_keys({1, 2}, {5, 3});
    for (const double from : {0.0, 0.5, 1.0, 1.5, 2.0, 3.25}) {
        const anim::Sampler shifted = begun_at(keys, anim::ChannelPath::weights, from, 4.0);
        for (double time = 0.0625; time < 4.0; time += 0.125) {
            INFO(from << " " << time);
            CHECK(weight_at(shifted, time) ==
                  Approx(weight_at(keys, std::fmod(time + from, 4.0))).margin(1e-5));
        }
    }
}

TEST_CASE("step keys stay steps", "[gallery]") {
    anim::Sampler keys = linear_keys({0, 1, 2}, {7, 8, 9});
    keys.interpolation = anim::Interpolation::step;
    const anim::Sampler shifted = begun_at(keys, anim::ChannelPath::weights, 0.5, 2.0);
    CHECK(shifted.interpolation == anim::Interpolation::step);
    CHECK(weight_at(shifted, 0.25) == 7.0f);
    CHECK(weight_at(shifted, 0.75) == 8.0f);
    CHECK(weight_at(shifted, 1.75) == 7.0f);
}

TEST_CASE("a spline comes out as straight keys that stay near it", "[gallery]") {
    // One Hermite segment: 3 u² - 2 u³ with u = t / 2.
    anim::Sampler keys = linear_keys({0, 2}, {0, 0, 0, 0, 1, 0});
    keys.interpolation = anim::Interpolation::cubic_spline;
    const anim::Sampler shifted = begun_at(keys, anim::ChannelPath::weights, 1.0, 2.0);
    CHECK(shifted.interpolation == anim::Interpolation::linear);
    for (double time = 0.01; time < 2.0; time += 0.07) {
        const double u = std::fmod(time + 1.0, 2.0) / 2.0;
        CHECK(double(weight_at(shifted, time)) == Approx(u * u * (3.0 - 2.0 * u)).margin(1e-4));
    }
}

TEST_CASE("each of a crowd does what the character does at the copy's own time", "[gallery]") {
    constexpr std::size_t count = 5;
    const auto file = bundled / "walker" / "walker.glb";
    Played one(bytes_of(file));
    const Crowd crowd = make_crowd(file, count);
    Played all(crowd.glb);
    CHECK(crowd.triangles == count * one.triangles().size());
    REQUIRE(all.triangles().size() == crowd.triangles);
    CHECK(all.duration_s() == Approx(one.duration_s()));

    glm::vec3 previous_place(1e9f);
    for (std::size_t copy = 0; copy < count; ++copy) {
        INFO(copy);
        glm::vec3 place(0.0f);
        for (const double time_s : {0.0, 0.3, 0.77, 1.2}) {
            const auto expected =
                one.positions(std::fmod(time_s + phase(copy, one.duration_s()), one.duration_s()));
            const auto found = all.positions(time_s);
            const std::size_t first = copy * expected.size();
            if (time_s == 0.0) place = found[first] - expected[0];
            float worst = 0.0f;
            for (std::size_t v = 0; v < expected.size(); ++v)
                worst = std::max(worst, glm::length(found[first + v] - expected[v] - place));
            CHECK(worst < 1e-4f);
        }
        CHECK(glm::length(place - previous_place) > 0.5f);
        previous_place = place;
    }
}

TEST_CASE("a crowd shares meshes and stands under one camera", "[gallery]") {
    const auto file = bundled / "walker" / "walker.glb";
    const anim::Scene one = anim::load(file);
    const std::string glb = make_crowd(file, 30).glb;
    Played all(glb);
    CHECK(all.scene().meshes.size() == one.meshes.size());
    CHECK(all.scene().skins.size() == 30 * one.skins.size());
    CHECK(all.scene().cameras.size() == 1);
    CHECK(all.scene().lights.size() == 2);
    CHECK(glb.size() < 10 * bytes_of(file).size());
    CHECK(glb == make_crowd(file, 30).glb);
}

TEST_CASE("samplers of the same copy share their key times, still ones everything", "[gallery]") {
    const std::string glb = make_crowd(bundled / "walker" / "walker.glb", 4).glb;
    std::uint32_t json_size = 0;
    std::memcpy(&json_size, glb.data() + 12, sizeof json_size);
    const auto json = nlohmann::json::parse(glb.substr(20, json_size));
    const auto& animation = json["animations"][0];
    std::vector<std::size_t> inputs;
    for (const auto& sampler : animation["samplers"]) inputs.push_back(sampler["input"]);
    std::ranges::sort(inputs);
    inputs.erase(std::unique(inputs.begin(), inputs.end()), inputs.end());
    // The walk has one set of times for its joints, one for its companion and one for the camera.
    CHECK(inputs.size() <= 4 * 3);
    CHECK(animation["channels"].size() % 4 == 0);
    CHECK(animation["samplers"].size() <= animation["channels"].size());
}

TEST_CASE("what cannot be a crowd is refused by name", "[gallery]") {
    CHECK_THROWS_WITH(make_crowd(bundled / "sheet" / "sheet.glb", 2),
                      Catch::Contains("sheet.glb: the file has no skin"));
    CHECK_THROWS_WITH(make_crowd("nobody.glb", 2), Catch::Contains("nobody.glb: cannot read the file"));
    CHECK_THROWS_AS(make_crowd(bundled / "README.md", 2), Error);
}
