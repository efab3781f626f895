#include "sequences/fingerprint.h"
#include "anim/error.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>
#include <sys/stat.h>

#include <span>
#include <string_view>

using namespace gridreel::sequences;
using gridreel::test::ScratchFolder;
using gridreel::test::write_file;

namespace {

std::string hash(std::string_view text) {
    return sha256_hex(std::as_bytes(std::span(text)));
}

/// A length below 256 as the hash takes it.
std::string length(char count) {
    return std::string(1, count) + std::string(7, '\0');
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
    CHECK(scene_sha256(folder / "s.gltf") == hash(gltf + length(4) + "AAAA" + length(4) + "BBBB"));

    write_file(folder / "a.bin", "AAAC");
    CHECK(scene_sha256(folder / "s.gltf") == hash(gltf + length(4) + "AAAC" + length(4) + "BBBB"));
}

TEST_CASE("bytes that move from one file to the next change a scene's hash", "[fingerprint]") {
    const ScratchFolder folder;
    write_file(folder / "s.gltf", R"({"buffers":[{"uri":"a.bin"},{"uri":"b.bin"}]})");
    write_file(folder / "a.bin", "AAB");
    write_file(folder / "b.bin", "B");
    const std::string before = scene_sha256(folder / "s.gltf");
    write_file(folder / "a.bin", "AA");
    write_file(folder / "b.bin", "BB");
    CHECK(scene_sha256(folder / "s.gltf") != before);
}

TEST_CASE("a scene's hash follows percent-encoded names", "[fingerprint]") {
    const ScratchFolder folder;
    const std::string gltf = R"({"buffers":[{"uri":"my%20data.bin"}]})";
    write_file(folder / "s.gltf", gltf);
    write_file(folder / "my data.bin", "AAAA");
    CHECK(scene_sha256(folder / "s.gltf") == hash(gltf + length(4) + "AAAA"));
    write_file(folder / "my data.bin", "AAAC");
    CHECK(scene_sha256(folder / "s.gltf") == hash(gltf + length(4) + "AAAC"));
}

TEST_CASE("what the loader would not read counts as empty in a scene's hash", "[fingerprint]") {
    const ScratchFolder folder;
    const ScratchFolder elsewhere;
    write_file(elsewhere / "secret", "secret");
    REQUIRE(mkfifo((folder / "pipe.png").c_str(), 0600) == 0);
    const std::string beside = "../" + elsewhere.path().filename().string() + "/secret";
    for (const std::string& uri :
         {std::string("pipe.png"), std::string("missing.png"), (elsewhere / "secret").string(), beside}) {
        INFO(uri);
        const std::string gltf = R"({"images":[{"uri":")" + uri + R"("}]})";
        write_file(folder / "s.gltf", gltf);
        CHECK(scene_sha256(folder / "s.gltf") == hash(gltf + length(0)));
    }
}

TEST_CASE("a scene's hash has the files of the asset root", "[fingerprint]") {
    const ScratchFolder folder;
    const std::string gltf = R"({"images":[{"uri":"../shared/a.png"}]})";
    std::filesystem::create_directories(folder / "models");
    std::filesystem::create_directories(folder / "shared");
    write_file(folder / "models/s.gltf", gltf);
    write_file(folder / "shared/a.png", "AAAA");
    CHECK(scene_sha256(folder / "models/s.gltf") == hash(gltf + length(0)));
    CHECK(scene_sha256(folder / "models/s.gltf", folder / "shared") == hash(gltf + length(4) + "AAAA"));
}

TEST_CASE("a binary scene's hash is its file's", "[fingerprint]") {
    const ScratchFolder folder;
    write_file(folder / "s.glb", "glTF\x02");
    CHECK(scene_sha256(folder / "s.glb") == hash("glTF\x02"));
    CHECK_THROWS_AS(scene_sha256(folder / "none.glb"), gridreel::Error);
}
