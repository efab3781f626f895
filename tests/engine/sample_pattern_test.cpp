#include "engine/sample_pattern.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <vector>

using namespace gridreel;
using engine::SamplePattern;

namespace {

/// Whether each of the columns x rows boxes of the unit square holds exactly one of the pixel's samples.
bool one_sample_each(const SamplePattern& pattern, std::uint32_t x, std::uint32_t y, int columns, int rows) {
    std::vector<int> counts(static_cast<std::size_t>(columns * rows), 0);
    for (int s = 0; s < pattern.samples; ++s) {
        const glm::vec2 place = pattern.place(x, y, static_cast<std::uint32_t>(s));
        const int column = static_cast<int>(place.x * static_cast<float>(columns));
        const int row = static_cast<int>(place.y * static_cast<float>(rows));
        ++counts[static_cast<std::size_t>(row * columns + column)];
    }
    for (const int count : counts) {
        if (count != 1) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("a lone sample lies in the pixel's centre", "[engine]") {
    const SamplePattern pattern{.samples = 1, .seed = 5};
    CHECK(pattern.place(0, 0, 0) == glm::vec2(0.5f, 0.5f));
    CHECK(pattern.place(17, 3, 0) == glm::vec2(0.5f, 0.5f));
}

TEST_CASE("samples stay inside their pixel", "[engine]") {
    const SamplePattern pattern{.samples = 37, .seed = 1};
    for (std::uint32_t x = 0; x < 20; ++x) {
        for (std::uint32_t s = 0; s < 37; ++s) {
            const glm::vec2 place = pattern.place(x, 7, s);
            CHECK((place.x >= 0.0f && place.x < 1.0f && place.y >= 0.0f && place.y < 1.0f));
        }
    }
}

TEST_CASE("sixteen samples put one in every dyadic box of a sixteenth of the pixel", "[engine]") {
    const SamplePattern pattern{.samples = 16, .seed = 3};
    for (std::uint32_t x = 0; x < 50; ++x) {
        CHECK(one_sample_each(pattern, x, 9, 16, 1));
        CHECK(one_sample_each(pattern, x, 9, 8, 2));
        CHECK(one_sample_each(pattern, x, 9, 4, 4));
        CHECK(one_sample_each(pattern, x, 9, 2, 8));
        CHECK(one_sample_each(pattern, x, 9, 1, 16));
    }
}

TEST_CASE("the pattern is a function of pixel, sample and seed", "[engine]") {
    const SamplePattern pattern{.samples = 4, .seed = 0};
    const SamplePattern reseeded{.samples = 4, .seed = 1};
    CHECK(pattern.place(3, 4, 2) == pattern.place(3, 4, 2));
    CHECK(pattern.place(3, 4, 2) != pattern.place(4, 3, 2));
    CHECK(pattern.place(3, 4, 2) != pattern.place(3, 4, 1));
    CHECK(pattern.place(3, 4, 2) != reseeded.place(3, 4, 2));
}

TEST_CASE("over many pixels a sample falls everywhere alike", "[engine]") {
    const SamplePattern pattern{.samples = 4, .seed = 0};
    std::vector<int> counts(16, 0);
    for (std::uint32_t y = 0; y < 128; ++y) {
        for (std::uint32_t x = 0; x < 128; ++x) {
            const glm::vec2 place = pattern.place(x, y, 1);
            ++counts[static_cast<std::size_t>(static_cast<int>(place.y * 4.0f) * 4 +
                                              static_cast<int>(place.x * 4.0f))];
        }
    }
    // 16384 pixels: 1024 a box, standard deviation 31.
    for (const int count : counts) CHECK(count == Approx(1024).margin(5 * 31));
}
