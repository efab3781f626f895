// The fuzzer's mutations: worth their time only while most of them are still glTF.

#include "tests/fuzz/mutate_file.h"

#include "anim/gltf/container.h"
#include "tests/anim/gltf_builder.h"
#include "tests/fuzz/mutate_json.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>
#include <set>
#include <string>

using namespace gridreel;

namespace {

/// Turns one byte over.
std::size_t flip_first(std::span<std::byte> room, std::size_t used) {
    if (used > 0) room[0] ^= std::byte{0xff};
    return used;
}

std::vector<std::byte> mutated(const std::vector<std::byte>& file, unsigned seed) {
    auto room = file;
    room.resize(file.size() + 4096);
    room.resize(test::mutate_file(room, file.size(), seed, flip_first));
    return room;
}

}  // namespace

TEST_CASE("most changed files are binary glTF with JSON in it", "[fuzz]") {
    const auto file = test::skinned_triangle().glb();
    int sound = 0;
    constexpr int tries = 1000;
    for (unsigned seed = 0; seed < tries; ++seed) {
        try {
            const auto bytes = mutated(file, seed);
            const auto parts = anim::gltf::split_container(bytes, "");
            if (parts.is_binary && nlohmann::json::accept(parts.json)) ++sound;
        } catch (const std::exception&) {
            continue;
        }
    }
    CHECK(sound > tries * 3 / 4);
    CHECK(sound < tries);  // some are raw bytes
}

TEST_CASE("the same seed changes a file the same way, other seeds in others", "[fuzz]") {
    const auto file = test::skinned_triangle().glb();
    CHECK(mutated(file, 5) == mutated(file, 5));
    std::set<std::vector<std::byte>> different;
    for (unsigned seed = 0; seed < 100; ++seed) different.insert(mutated(file, seed));
    CHECK(different.size() > 50);
}

TEST_CASE("a changed file never outgrows its room", "[fuzz]") {
    const auto file = test::skinned_triangle().glb();
    for (unsigned seed = 0; seed < 1000; ++seed) {
        auto room = file;
        REQUIRE(test::mutate_file(room, file.size(), seed, flip_first) <= file.size());
    }
}

TEST_CASE("JSON stays an object that can be written, however often it changes", "[fuzz]") {
    auto document = test::skinned_triangle().json;
    document["名"] = "é";
    std::mt19937 random(1);
    for (int i = 0; i < 300; ++i) {
        test::mutate_json(document, random);
        REQUIRE(document.is_object());
        REQUIRE_NOTHROW(document.dump());
    }
}
