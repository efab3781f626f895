// Files that end too early: they load or are refused, and never worse.

#include "tests/fuzz/play_file.h"

#include "anim/gltf/document.h"
#include "tests/anim/gltf_builder.h"

#include <catch2/catch.hpp>

#include <span>

using namespace gridreel;

namespace {

constexpr std::size_t step = 64;

void play_every_cut(std::span<const std::byte> whole, const std::filesystem::path& empty) {
    for (std::size_t size = 0; size < whole.size(); size += step) {
        INFO("cut to " << size << " of " << whole.size() << " bytes");
        REQUIRE_NOTHROW(test::play_file(whole.first(size), empty));
    }
}

}  // namespace

TEST_CASE("seeds cut at every 64th byte are refused", "[fuzz][truncation]") {
    const test::TemporaryFolder empty;
    for (const auto& entry : std::filesystem::directory_iterator(GRIDREEL_FUZZ_CORPUS)) {
        INFO(entry.path());
        const auto whole = anim::gltf::read_whole_file(entry);
        for (std::size_t size = 0; size < whole.size(); size += step)
            REQUIRE(test::play_file(std::span(whole).first(size), empty.path()) == test::Played::refused);
    }
}

TEST_CASE("small assets cut at every 64th byte load or are refused", "[fuzz][truncation][assets]") {
    const std::filesystem::path assets = GRIDREEL_SHARED_ASSETS;
    if (!std::filesystem::is_directory(assets)) {
        WARN("skipped: the shared assets are not there");
        return;
    }
    // Larger ones take minutes, and hold nothing that these do not.
    constexpr std::uintmax_t largest = 96 << 10;
    const test::TemporaryFolder empty;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(assets)) {
        const auto extension = entry.path().extension();
        if ((extension != ".gltf" && extension != ".glb") || entry.file_size() > largest) continue;
        INFO(entry.path());
        play_every_cut(anim::gltf::read_whole_file(entry), empty.path());
    }
}
