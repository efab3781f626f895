#include "anim/gltf/accessor.h"
#include "gltf_builder.h"

#include <catch2/catch.hpp>

#include <array>

using namespace gridreel;
using namespace gridreel::anim::gltf;

namespace {

template <class T>
const std::byte* address_of(const T& values) {
    return reinterpret_cast<const std::byte*>(values.data());
}

}  // namespace

TEST_CASE("normalized integers become fractions of their largest value", "[load]") {
    const std::array<std::int8_t, 4> bytes{127, -127, -128, 0};
    const std::array<std::uint8_t, 2> unsigned_bytes{255, 51};
    const std::array<std::int16_t, 3> shorts{32767, -32768, -16384};
    const std::array<std::uint16_t, 2> unsigned_shorts{65535, 13107};

    CHECK(read_floats({.component = ComponentType::int8,
                       .normalized = true,
                       .count = 4,
                       .data = address_of(bytes),
                       .stride = 1}) == std::vector<float>{1.0f, -1.0f, -1.0f, 0.0f});
    CHECK(read_floats({.component = ComponentType::uint8,
                       .normalized = true,
                       .count = 2,
                       .data = address_of(unsigned_bytes),
                       .stride = 1}) == std::vector<float>{1.0f, 0.2f});
    CHECK(read_floats({.component = ComponentType::int16,
                       .normalized = true,
                       .count = 3,
                       .data = address_of(shorts),
                       .stride = 2}) == std::vector<float>{1.0f, -1.0f, -16384.0f / 32767.0f});
    CHECK(read_floats({.component = ComponentType::uint16,
                       .normalized = true,
                       .count = 2,
                       .data = address_of(unsigned_shorts),
                       .stride = 2}) == std::vector<float>{1.0f, 0.2f});
}

TEST_CASE("plain integers keep their value", "[load]") {
    const std::array<std::int16_t, 2> shorts{-300, 7};
    const std::array<std::uint32_t, 2> words{70000, 3};

    CHECK(read_floats(
              {.component = ComponentType::int16, .count = 2, .data = address_of(shorts), .stride = 2}) ==
          std::vector<float>{-300.0f, 7.0f});
    CHECK(read_floats(
              {.component = ComponentType::uint32, .count = 2, .data = address_of(words), .stride = 4}) ==
          std::vector<float>{70000.0f, 3.0f});
    CHECK(read_integers(
              {.component = ComponentType::uint32, .count = 2, .data = address_of(words), .stride = 4}) ==
          std::vector<std::uint32_t>{70000, 3});
}

TEST_CASE("elements are read at odd addresses and any stride", "[load]") {
    // One byte of nothing, then 16-bit pairs seven bytes apart.
    const std::array<std::uint8_t, 12> bytes{99, 1, 0, 2, 0, 99, 99, 99, 3, 0, 4, 1};
    const Accessor accessor{.component = ComponentType::uint16,
                            .element = {.name = "VEC2", .rows = 2, .columns = 1},
                            .count = 2,
                            .data = address_of(bytes) + 1,
                            .stride = 7};

    CHECK(read_integers(accessor) == std::vector<std::uint32_t>{1, 2, 3, 260});
}

TEST_CASE("matrix columns begin at multiples of four bytes", "[load]") {
    // MAT3 of bytes: three columns of three bytes and one of padding.
    const std::array<std::uint8_t, 12> bytes{1, 2, 3, 99, 4, 5, 6, 99, 7, 8, 9, 99};
    const Accessor accessor{.component = ComponentType::uint8,
                            .element = {.name = "MAT3", .rows = 3, .columns = 3},
                            .count = 1,
                            .data = address_of(bytes),
                            .stride = 12};

    CHECK(read_floats(accessor) == std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9});
}

TEST_CASE("sparse elements replace those of the buffer view", "[load]") {
    auto file = test::one_triangle();
    const auto indices = file.add_view<std::uint8_t>({1, 2});
    const auto values = file.add_view<float>({5, 6, 7, 8, 9, 10});
    file.json["accessors"][0]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", indices}, {"componentType", test::uint8}}},
        {"values", {{"bufferView", values}}}};

    const auto positions = file.load().meshes[0].primitives[0].positions;
    CHECK(positions == std::vector<glm::vec3>{{0, 0, 0}, {5, 6, 7}, {8, 9, 10}});
}

TEST_CASE("a sparse accessor without a buffer view starts from zeros", "[load]") {
    auto file = test::one_triangle();
    const auto indices = file.add_view<std::uint32_t>({2});
    const auto values = file.add_view<float>({5, 6, 7});
    file.json["accessors"][0].erase("bufferView");
    file.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", test::uint32}}},
        {"values", {{"bufferView", values}}}};

    const auto positions = file.load().meshes[0].primitives[0].positions;
    CHECK(positions == std::vector<glm::vec3>{{0, 0, 0}, {0, 0, 0}, {5, 6, 7}});
}

TEST_CASE("interleaved attributes are told apart by the view's stride", "[load]") {
    auto file = test::one_triangle();
    const auto view = file.add_view<float>({0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0});
    file.json["bufferViews"][view]["byteStride"] = 24;
    file.json["accessors"][0]["bufferView"] = view;
    file.json["accessors"].push_back({{"bufferView", view},
                                      {"byteOffset", 12},
                                      {"componentType", test::float32},
                                      {"type", "VEC3"},
                                      {"count", 3}});
    file.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;

    const auto scene = file.load();
    const auto& primitive = scene.meshes[0].primitives[0];
    CHECK(primitive.positions == std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(primitive.normals == std::vector<glm::vec3>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}});
}
