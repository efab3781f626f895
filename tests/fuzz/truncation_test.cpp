// Files that end too early: they load or are refused, and never worse.

#include "tests/fuzz/play_file.h"

#include "anim/gltf/container.h"
#include "anim/gltf/document.h"
#include "tests/anim/gltf_builder.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

using namespace gridreel;

namespace {

constexpr std::size_t step = 64;

void put_word(std::span<std::byte> bytes, std::size_t offset, std::size_t value) {
    for (std::size_t i = 0; i < 4; ++i) bytes[offset + i] = static_cast<std::byte>(value >> 8 * i & 0xff);
}

/// Makes the header of a binary glTF agree with the bytes there are, and its last chunk's, too: without this
/// no cut gets past them.
void mend_lengths(std::span<std::byte> bytes, std::size_t json_length) {
    const std::size_t binary = 20 + json_length;
    if (bytes.size() < binary + 8) return;
    put_word(bytes, 8, bytes.size());
    put_word(bytes, binary, bytes.size() - binary - 8);
}

void play_every_cut(std::span<const std::byte> whole, const std::filesystem::path& empty) {
    std::optional<std::size_t> json_length;
    if (const auto parts = anim::gltf::split_container(whole, ""); parts.is_binary)
        json_length = parts.json.size();
    for (std::size_t size = 0; size < whole.size(); size += step) {
        INFO("cut to " << size << " of " << whole.size() << " bytes");
        std::vector<std::byte> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        REQUIRE_NOTHROW(test::play_file(cut, empty));
        if (!json_length) continue;
        mend_lengths(cut, *json_length);
        REQUIRE_NOTHROW(test::play_file(cut, empty));
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
        // Containers that are broken before they are cut have tests of their own.
        if (entry.path().parent_path().filename() == "invalid") continue;
        INFO(entry.path());
        play_every_cut(anim::gltf::read_whole_file(entry), empty.path());
    }
}
