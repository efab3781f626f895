#include "sequences/fingerprint.h"
#include "anim/error.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>

#include <span>
#include <string_view>

using namespace gridreel::sequences;
using gridreel::test::ScratchFolder;
using gridreel::test::write_file;

namespace {

std::string hash(std::string_view text) {
    return sha256_hex(std::as_bytes(std::span(text)));
}

}  // namespace

TEST_CASE("hashes are those of FIPS 180-4", "[fingerprint]") {
    CHECK(hash("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(hash("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_CASE("a scene's hash covers the files it is made of", "[fingerprint]") {
    const ScratchFolder folder;
    const std::string gltf =
        R"({"buffers":[{"uri":"a.bin"},{"uri":"data:,x"}],"images":[{"uri":"b.png"},{"bufferView":0}]})";
    write_file(folder / "s.gltf", gltf);
    write_file(folder / "a.bin", "AAAA");
    write_file(folder / "b.png", "BBBB");
    CHECK(scene_sha256(folder / "s.gltf") == hash(gltf + "AAAABBBB"));

    write_file(folder / "a.bin", "AAAC");
    CHECK(scene_sha256(folder / "s.gltf") == hash(gltf + "AAACBBBB"));
}

TEST_CASE("a binary scene's hash is its file's", "[fingerprint]") {
    const ScratchFolder folder;
    write_file(folder / "s.glb", "glTF\x02");
    CHECK(scene_sha256(folder / "s.glb") == hash("glTF\x02"));
    CHECK_THROWS_AS(scene_sha256(folder / "none.glb"), gridreel::Error);
}
