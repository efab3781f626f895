#include "gltf_builder.h"

#include <catch2/catch.hpp>

using namespace gridreel;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// Two images and one texture, which the material's base colour or its normal map looks up.
struct TextureFile {
    test::GltfBuilder file = test::one_triangle();

    explicit TextureFile(const json& texture, bool drawn = true) {
        const json image{{"uri", "data:image/png;base64,AAAA"}};
        const json ref{{"index", 0}};
        file.json["images"] = {image, image};
        file.json["textures"] = json::array({texture});
        file.json["materials"] =
            json::array({drawn ? json{{"pbrMetallicRoughness", {{"baseColorTexture", ref}}}}
                               : json{{"normalTexture", ref}}});
    }
};

json from(const char* extension, int source) {
    return {{"extensions", {{extension, {{"source", source}}}}}};
}

json from(const char* extension, int source, int fallback) {
    json texture = from(extension, source);
    texture["source"] = fallback;
    return texture;
}

}  // namespace

TEST_CASE("a WebP image is taken before the fallback", "[load]") {
    for (const json& texture : {from("EXT_texture_webp", 1), from("EXT_texture_webp", 1, 0)}) {
        TextureFile with(texture);
        with.file.json["extensionsUsed"] = with.file.json["extensionsRequired"] = {"EXT_texture_webp"};
        const auto scene = with.file.load();
        CHECK(scene.textures.at(0).image == 1u);
        CHECK(scene.warnings.empty());
    }
}

TEST_CASE("in the place of KTX2 the fallback is drawn, and a warning says so once", "[load]") {
    TextureFile with(from("KHR_texture_basisu", 1, 0));
    with.file.json["textures"].push_back(from("KHR_texture_basisu", 0, 1));
    with.file.json["extensionsRequired"] = {"KHR_texture_basisu"};
    const auto scene = with.file.load();
    CHECK(scene.textures.at(0).image == 0u);
    CHECK(scene.textures.at(1).image == 1u);
    CHECK(scene.warnings.size() == 1);
    CHECK(test::warning_at(scene, "/textures/0") ==
          "KTX2 is not read: 2 textures are drawn from their other images");
}

TEST_CASE("an image that only KTX2 readers want is not missed", "[load]") {
    TextureFile with(from("KHR_texture_basisu", 1, 0));
    with.file.json["images"][1] = {{"uri", "not-there.ktx2"}};
    const auto scene = with.file.load();
    CHECK(scene.warnings.size() == 1);
    CHECK(scene.images.at(1).name == "not-there.ktx2");
    CHECK(scene.images.at(1).encoded.empty());
}

TEST_CASE("a drawn texture of nothing but KTX2 is refused with the command that converts it", "[load]") {
    const auto refusal = test::refusal_of(TextureFile(from("KHR_texture_basisu", 1)).file);
    CHECK(refusal.pointer == "/textures/0");
    CHECK_THAT(refusal.message, Contains("KTX2") && Contains("npx @gltf-transform/cli ktxdecompress"));
}

TEST_CASE("a texture of nothing but KTX2 that is not drawn is refused only where the file requires it",
          "[load]") {
    TextureFile with(from("KHR_texture_basisu", 1), false);
    const auto scene = with.file.load();
    CHECK_FALSE(scene.textures.at(0).image);
    CHECK(scene.warnings.size() == 1);  // of the normal map
    with.file.json["extensionsRequired"] = {"KHR_texture_basisu"};
    CHECK(test::refusal_of(with.file).pointer == "/textures/0");
}

TEST_CASE("a drawn texture without any image is warned of", "[load]") {
    const auto scene = TextureFile(from("EXT_texture_avif", 1)).file.load();
    CHECK_FALSE(scene.textures.at(0).image);
    CHECK_THAT(test::warning_at(scene, "/textures/0"), Contains("drawn white"));
    CHECK(test::warning_at(TextureFile(json::object(), false).file.load(), "/textures/0").empty());
}

TEST_CASE("other sources of a texture that are no objects or indices are refused", "[validate]") {
    const auto pointer = [](const json& extensions) {
        return test::refusal_of(TextureFile(json{{"extensions", extensions}}).file).pointer;
    };
    CHECK(pointer({{"EXT_texture_webp", 3}}) == "/textures/0/extensions/EXT_texture_webp");
    CHECK(pointer({{"EXT_texture_webp", {{"source", "a.webp"}}}}) ==
          "/textures/0/extensions/EXT_texture_webp/source");
    CHECK(pointer({{"KHR_texture_basisu", {{"source", -1}}}}) ==
          "/textures/0/extensions/KHR_texture_basisu/source");
}
