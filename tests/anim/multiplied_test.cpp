// Files in which small things multiply one another: refused, or read in time that grows with their size.
// Where a loop over all pairs comes back, these tests take minutes.

#include "gltf_builder.h"

#include <catch2/catch.hpp>

#include <string>

using namespace gridreel;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// As many of one value.
json many(std::size_t count, const json& value) {
    return json(json::array_t(count, value));
}

}  // namespace

TEST_CASE("as many scenes as nodes are read", "[validate][multiplied]") {
    auto file = test::one_triangle();
    constexpr std::size_t count = 100'000;
    file.json["nodes"] = many(count, json::object());
    file.json["scenes"] = many(count, json::object());
    CHECK(file.load().scenes.size() == count);
}

TEST_CASE("many nodes share a mesh of many primitives and a skin", "[validate][multiplied]") {
    auto file = test::skinned_triangle();
    constexpr std::size_t primitives = 4'000, nodes = 50'000;
    const json primitive = file.json["meshes"][0]["primitives"][0];
    file.json["meshes"][0]["primitives"] = many(primitives, primitive);
    for (std::size_t i = 0; i < nodes; ++i) file.json["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
    CHECK(file.load().nodes.size() == nodes + 3);

    file.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});
    CHECK_THAT(test::refusal_of(file).message, Contains("primitive 4000 of mesh 0 has no JOINTS_0"));
}

TEST_CASE("more attributes than any vertex has are refused", "[validate][multiplied]") {
    auto file = test::one_triangle();
    auto& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    for (int i = 0; i < 1023; ++i) attributes["_" + std::to_string(i)] = 0;
    CHECK(test::refusal_of(file).message.empty());
    attributes["_MORE"] = 0;
    const auto refusal = test::refusal_of(file);
    CHECK(refusal.pointer == "/meshes/0/primitives/0/attributes");
    CHECK_THAT(refusal.message, Contains("has 1025 entries; at most 1024 are read"));
}

TEST_CASE("morph weights count as memory for every node that has them", "[validate][multiplied]") {
    auto file = test::one_triangle();
    file.json["meshes"][0]["primitives"][0]["targets"] = many(40'000, json::object());
    CHECK(test::refusal_of(file).message.empty());
    for (int i = 0; i < 20'000; ++i) file.json["nodes"].push_back({{"mesh", 0}});
    const auto refusal = test::refusal_of(file);
    CHECK_THAT(refusal.pointer, Contains("/nodes/"));
    CHECK_THAT(refusal.message, Contains("more memory than a file of this size"));
}

TEST_CASE("objects of three bytes count as the memory that they become", "[validate][multiplied]") {
    auto file = test::one_triangle();
    file.json["nodes"] = many(400'000, json::object());
    CHECK_THAT(test::refusal_of(file).message, Contains("more memory than a file of this size"));
}
