#pragma once
// What becomes of a file that the Khronos validator reports: one row for each code of its ISSUES.md.

#include "gltf_builder.h"

#include <catch2/catch.hpp>

#include <span>
#include <string>

namespace gridreel::test {

enum class Verdict {
    refused,    ///< an Error at `pointer` whose message holds `text`, and which names file and remedy
    warned,     ///< loads, with a warning at `pointer` that holds `text`
    tolerated,  ///< loads without a word; `text` is the reason why the picture is right all the same
};

struct KhronosCode {
    std::string code;  ///< and which case of it, where there are several
    Verdict verdict;
    std::string pointer;
    std::string text;
    void (*inflict)(GltfBuilder&);
};

/// A sound file with something of everything: a skinned and textured triangle with a morph target and normals
/// (node 0), two joints (nodes 1 and 2), of which one moves, and a camera (node 3).
[[nodiscard]] GltfBuilder bit_of_everything();

/// The first primitive's attributes.
[[nodiscard]] nlohmann::json& attributes(GltfBuilder& file);
/// The first animation's sampler, and its channel's target.
[[nodiscard]] nlohmann::json& key_sampler(GltfBuilder& file);
[[nodiscard]] nlohmann::json& channel_target(GltfBuilder& file);

/// Each code, inflicted on `bit_of_everything`, meets its verdict; a section each.
void check_codes(std::span<const KhronosCode> codes);

}  // namespace gridreel::test
