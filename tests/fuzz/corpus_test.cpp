// The seeds, through what the fuzzer runs: so that it is sound in every build, and so are they.

#include "tests/fuzz/play_file.h"

#include "anim/gltf/document.h"
#include "tests/anim/gltf_builder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

using namespace gridreel;

TEST_CASE("every seed of the fuzzer plays to its end", "[fuzz]") {
    const test::TemporaryFolder empty;
    std::size_t seeds = 0;
    for (const auto& entry : std::filesystem::directory_iterator(GRIDREEL_FUZZ_CORPUS)) {
        INFO(entry.path());
        CHECK(test::play_file(anim::gltf::read_whole_file(entry), empty.path()) == test::Played::whole);
        ++seeds;
    }
    CHECK(seeds >= 11);
}

TEST_CASE("a bit of a seed, whichever, makes it another scene or an error", "[fuzz]") {
    const test::TemporaryFolder empty;
    for (const auto& entry : std::filesystem::directory_iterator(GRIDREEL_FUZZ_CORPUS)) {
        INFO(entry.path());
        const auto seed = anim::gltf::read_whole_file(entry);
        // Every 31st, so that all bits of a byte have their turn.
        for (std::size_t bit = 0; bit < 8 * seed.size(); bit += 31) {
            auto file = seed;
            file[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
            REQUIRE_NOTHROW(test::play_file(file, empty.path()));
        }
    }
}

TEST_CASE("what the fuzzer plays is refused, too large, or whole", "[fuzz]") {
    const test::TemporaryFolder empty;
    const auto play = [&](const test::GltfBuilder& file) {
        return test::play_file(file.glb(), empty.path());
    };
    auto file = test::one_triangle();
    CHECK(play(file) == test::Played::whole);

    file.json["accessors"][0].erase("bufferView");
    file.json["accessors"][0]["count"] = 1'000'000;
    CHECK(play(file) == test::Played::too_large);

    file.json["accessors"][0]["count"] = 4'294'967'295;
    CHECK(play(file) == test::Played::refused);
}
