#include "anim/error.h"
#include "gltf_builder.h"

#include <catch2/catch.hpp>

using namespace gridreel;
using Catch::Matchers::Contains;

namespace {

const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

void put_word(std::vector<std::byte>& bytes, std::size_t offset, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) bytes[offset + i] = static_cast<std::byte>(value >> 8 * i & 0xff);
}

}  // namespace

TEST_CASE("a .gltf with an embedded buffer loads", "[load]") {
    const auto scene = test::one_triangle().load();
    CHECK(scene.name == "test");
    CHECK(scene.meshes.at(0).primitives.at(0).positions == corners);
    CHECK(scene.warnings.empty());
}

TEST_CASE("a .glb loads, with its BIN chunk padded", "[load]") {
    const auto file = test::one_triangle();
    REQUIRE(file.buffer.size() % 4 == 2);  // so that there is padding
    const auto scene = anim::load_bytes(file.glb(), "a.glb");
    CHECK(scene.meshes.at(0).primitives.at(0).positions == corners);
}

TEST_CASE("a .gltf with a buffer beside it loads", "[load]") {
    auto file = test::one_triangle();
    const test::TemporaryFolder folder;
    folder.write("triangle.bin", file.buffer);
    file.json["buffers"] = {{{"byteLength", file.buffer.size()}, {"uri", "triangle.bin"}}};
    const auto scene = anim::load(folder.write("model.gltf", file.gltf()));

    CHECK(scene.name == "model");
    CHECK(scene.meshes.at(0).primitives.at(0).positions == corners);
}

TEST_CASE("a binary glTF may be called anything", "[load]") {
    const test::TemporaryFolder folder;
    const auto scene = anim::load(folder.write("model.gltf", test::one_triangle().glb()));
    CHECK(scene.meshes.at(0).primitives.at(0).positions == corners);
}

TEST_CASE("bytes after a binary glTF are ignored with a warning", "[load]") {
    auto bytes = test::one_triangle().glb();
    bytes.resize(bytes.size() + 5);
    CHECK_THAT(test::warning_at(anim::load_bytes(bytes, "a.glb"), ""), Contains("5 bytes"));
}

TEST_CASE("a file that is not there is refused by name", "[load]") {
    const test::TemporaryFolder folder;
    CHECK_THROWS_WITH(anim::load(folder.path() / "nothing.glb"),
                      Contains("nothing.glb") && Contains("no such file"));
    CHECK_THROWS_WITH(anim::load(folder.path()), Contains("folder"));
    CHECK_THROWS_WITH(anim::load(folder.write("empty.glb", "")), Contains("empty.glb: the file is empty"));
}

TEST_CASE("a header that lies is refused", "[load]") {
    const auto whole = test::one_triangle().glb();
    auto bytes = whole;
    SECTION("version 1") {
        put_word(bytes, 4, 1);
        CHECK_THAT(test::refusal_of(bytes, "a.glb").message, Contains("version 1"));
    }
    SECTION("longer than the file") {
        put_word(bytes, 8, static_cast<std::uint32_t>(bytes.size() + 1));
        CHECK_THAT(test::refusal_of(bytes, "a.glb").message, Contains("header states"));
    }
    SECTION("shorter than a header") {
        put_word(bytes, 8, 19);
        CHECK_THAT(test::refusal_of(bytes, "a.glb").message, Contains("less than a header"));
    }
    SECTION("a first chunk beyond the file") {
        put_word(bytes, 12, 0xffffffff);
        CHECK_THAT(test::refusal_of(bytes, "a.glb").message, Contains("chunk 0 states 4294967295"));
    }
    SECTION("a first chunk that is not JSON") {
        put_word(bytes, 16, 0x004E4942);
        CHECK_THAT(test::refusal_of(bytes, "a.glb").message, Contains("not JSON"));
    }
    SECTION("only the magic") {
        bytes.resize(4);
        CHECK_THAT(test::refusal_of(bytes, "a.glb").message, Contains("ends inside its header"));
    }
}

TEST_CASE("a file cut short at any length is refused", "[load]") {
    const auto glb = test::skinned_triangle().glb();
    for (std::size_t length = 0; length < glb.size(); ++length) {
        const std::vector<std::byte> cut(glb.begin(), glb.begin() + static_cast<std::ptrdiff_t>(length));
        REQUIRE_FALSE(test::refusal_of(cut, "cut.glb").message.empty());
    }
    const auto text = test::bytes_of(test::skinned_triangle().gltf());
    for (std::size_t length = 0; length < text.size(); ++length) {
        const std::vector<std::byte> cut(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(length));
        REQUIRE_FALSE(test::refusal_of(cut, "cut.gltf").message.empty());
    }
}

TEST_CASE("a file with any byte changed loads or is refused, and never worse", "[load]") {
    const auto whole = test::skinned_triangle().glb();
    std::size_t refused = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        for (const int value : {0x00, 0x22, 0x39, 0x7f, 0xff}) {
            auto bytes = whole;
            bytes[i] = static_cast<std::byte>(value);
            if (!test::refusal_of(bytes, "changed.glb").message.empty()) ++refused;
        }
    }
    CHECK(refused > whole.size());
}
