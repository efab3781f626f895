#include "engine/textures.h"

#include "encoded_images.h"

#include <catch2/catch.hpp>

using namespace gridreel;
using engine::Encoding;

namespace {

/// One grey image of code 188, as base colour and as metallic-roughness.
anim::Scene grey_twice() {
    anim::Scene scene;
    scene.images = {test::png(1, 1, 1, {188})};
    scene.textures = {{.image = 0}};
    scene.materials.resize(1);
    scene.materials[0].base_color_texture = anim::TextureRef{.texture = 0};
    scene.materials[0].metallic_roughness_texture = anim::TextureRef{.texture = 0};
    return scene;
}

}  // namespace

TEST_CASE("one image can be a colour here and plain numbers there", "[engine]") {
    const anim::Scene scene = grey_twice();
    const engine::Textures textures(scene);
    const anim::TextureRef ref{.texture = 0};
    CHECK(textures.sample(ref, Encoding::srgb, {}, 0.0f).x == Approx(0.50289f).margin(1e-4));
    CHECK(textures.sample(ref, Encoding::linear, {}, 0.0f).x == Approx(188.0f / 255.0f));
}

TEST_CASE("what is not there is white, and an image without bytes is not listed again", "[engine]") {
    anim::Scene scene = grey_twice();
    scene.images[0] = {.name = "lost.png", .mime_type = {}, .encoded = {}};
    const engine::Textures textures(scene);
    CHECK(textures.sample(anim::TextureRef{.texture = 0}, Encoding::srgb, {}, 0.0f) == glm::vec4(1.0f));
    CHECK(textures.sample(std::nullopt, Encoding::srgb, {}, 0.0f) == glm::vec4(1.0f));
    CHECK(textures.problems().empty());
}

TEST_CASE("damaged images are white, listed in the file's order, and take no other with them", "[engine]") {
    anim::Scene scene = grey_twice();
    const std::vector<std::byte> junk(50);
    scene.images = {{.name = "good", .mime_type = {}, .encoded = scene.images[0].encoded},
                    {.name = "first bad", .mime_type = {}, .encoded = junk},
                    {.name = "second bad", .mime_type = {}, .encoded = junk}};
    scene.textures = {{.image = 2}, {.image = 1}, {.image = 0}};
    scene.materials.resize(3);
    for (anim::Index i = 0; i < 3; ++i) {
        scene.materials[i].base_color_texture = anim::TextureRef{.texture = i};
        scene.materials[i].metallic_roughness_texture = anim::TextureRef{.texture = i};
    }
    const engine::Textures textures(scene);
    REQUIRE(textures.problems().size() == 2);
    CHECK_THAT(textures.problems()[0], Catch::Contains("first bad"));
    CHECK_THAT(textures.problems()[1], Catch::Contains("second bad"));
    CHECK(textures.sample(anim::TextureRef{.texture = 0}, Encoding::srgb, {}, 0.0f) == glm::vec4(1.0f));
    CHECK(textures.sample(anim::TextureRef{.texture = 2}, Encoding::linear, {}, 0.0f).x < 0.9f);
}

TEST_CASE("only images that pictures show are decoded", "[engine]") {
    anim::Scene scene = grey_twice();
    scene.images.push_back({.name = "junk", .mime_type = {}, .encoded = std::vector<std::byte>(50)});
    scene.textures.push_back({.image = 1});
    scene.materials[0].normal_texture = anim::TextureRef{.texture = 1};
    scene.materials.emplace_back();
    scene.materials[1].unlit = true;
    scene.materials[1].emissive_texture = anim::TextureRef{.texture = 1};
    CHECK(engine::Textures(scene).problems().empty());
    scene.materials[1].unlit = false;
    CHECK(engine::Textures(scene).problems().size() == 1);
}
