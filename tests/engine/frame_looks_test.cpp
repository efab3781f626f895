#include "encoded_images.h"
#include "scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>

using namespace gridreel;
using engine::Film;

namespace {

/// A square that fills the picture, 2 m wide, seen along -z; its texture's top left is the picture's, in both
/// sets of coordinates. A light of 50 candela stands before its left half.
struct Poster {
    test::SceneBuilder builder;

    Poster() {
        anim::Primitive sheet = test::quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
        sheet.texcoords[0] = sheet.texcoords[1] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
        sheet.material = builder.add_material(test::matte(glm::vec3(0.0f)));
        builder.add_mesh(sheet);
        anim::Light light;
        light.intensity = 50.0f;
        builder.add_light(light, {-0.5, 0, 1});
        builder.add_orthographic({0, 0, 5}, {0, 0, 0}, 1.0);
    }

    anim::Material& material() { return builder.scene.materials[0]; }
    anim::Primitive& sheet() { return builder.scene.meshes[0].primitives[0]; }

    /// Texels: red, green above blue, white; looked up without filtering.
    anim::TextureRef add_four_colors() {
        builder.scene.images = {test::png(2, 2, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255})};
        builder.scene.textures = {{.image = 0,
                                   .mag_filter = anim::Filter::nearest,
                                   .min_filter = anim::Filter::nearest,
                                   .mip_filter = anim::MipFilter::none}};
        return {.texture = 0};
    }

    [[nodiscard]] Film film() const { return test::render(builder.scene, test::small_picture()); }
};

/// In the quarters of the picture: 0 left, 1 right; 0 top, 1 bottom.
glm::vec3 quarter(const Film& film, int column, int row) {
    const float* pixel = film.pixel(8 + 16 * column, 8 + 16 * row);
    return {pixel[Film::R], pixel[Film::G], pixel[Film::B]};
}

constexpr glm::vec3 red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1}, white{1, 1, 1};

void check_quarters(const Film& film, const std::array<glm::vec3, 4>& expected) {
    for (int i = 0; i < 4; ++i) {
        INFO("quarter " << i % 2 << ", " << i / 2);
        CHECK(quarter(film, i % 2, i / 2) == expected[static_cast<std::size_t>(i)]);
    }
}

}  // namespace

TEST_CASE("an unlit surface is its base colour times texture times vertex colour, and no light", "[engine]") {
    Poster poster;
    poster.material().unlit = true;
    poster.material().base_color = {0.5f, 1.0f, 0.25f, 1.0f};
    poster.material().base_color_texture = poster.add_four_colors();
    poster.material().emissive = glm::vec3(7.0f);  // to be ignored
    poster.sheet().colors.assign(4, {0.5f, 0.25f, 1.0f, 1.0f});
    check_quarters(poster.film(), {0.25f * red, 0.25f * green, 0.25f * blue, {0.25f, 0.25f, 0.25f}});
}

TEST_CASE("an unlit surface still casts a shadow on others", "[engine]") {
    Poster poster;
    poster.material() = test::matte(glm::vec3(1.0f));
    anim::Material flat;
    flat.unlit = true;
    flat.base_color = {0, 0, 1, 1};
    anim::Primitive card =
        test::quad({-0.6f, -0.1f, 0.5f}, {-0.4f, -0.1f, 0.5f}, {-0.4f, 0.1f, 0.5f}, {-0.6f, 0.1f, 0.5f});
    card.material = poster.builder.add_material(flat);
    poster.builder.add_mesh(card);
    const Film film = poster.film();
    const auto at = [&](int column) {
        const float* pixel = film.pixel(column, 16);
        return glm::vec3(pixel[Film::R], pixel[Film::G], pixel[Film::B]);
    };
    CHECK(at(8) == blue);             // the card itself, 0.2 m wide
    CHECK(at(5) == glm::vec3(0.0f));  // its shadow, twice as wide
    CHECK(at(24).x > 0.1f);
}

TEST_CASE("the strength of emission multiplies it, beyond 1 too", "[engine]") {
    Poster poster;
    poster.builder.scene.lights[0].intensity = 0.0f;
    poster.material().emissive = {0.25f, 0.5f, 1.0f};
    poster.material().emissive_strength = 16.0f;
    CHECK(quarter(poster.film(), 0, 0) == glm::vec3(4.0f, 8.0f, 16.0f));
    poster.material().emissive_texture = poster.add_four_colors();
    check_quarters(poster.film(), {4.0f * red, 8.0f * green, 16.0f * blue, {4.0f, 8.0f, 16.0f}});
    poster.material().emissive_strength = 0.0f;
    CHECK(quarter(poster.film(), 1, 1) == glm::vec3(0.0f));
}

TEST_CASE("black texels stay black however strong the emission", "[engine]") {
    Poster poster;
    poster.builder.scene.lights[0].intensity = 0.0f;
    poster.material().emissive = glm::vec3(std::numeric_limits<float>::max());
    poster.material().emissive_strength = std::numeric_limits<float>::max();
    poster.material().emissive_texture = poster.add_four_colors();
    CHECK(quarter(poster.film(), 0, 0).x > 0.0f);
    CHECK(quarter(poster.film(), 0, 0).y == 0.0f);
}

TEST_CASE("a texture is moved, scaled and turned by its transform", "[engine]") {
    const bool second_set = GENERATE(false, true);
    Poster poster;
    poster.builder.scene.lights[0].intensity = 0.0f;
    if (second_set) {
        poster.sheet().texcoords[0].clear();
    } else {
        poster.sheet().texcoords[1].clear();
    }
    const auto shown = [&](const anim::TextureTransform& transform) {
        anim::TextureRef ref = poster.add_four_colors();
        ref.texcoord = second_set ? 1 : 0;
        ref.transform = transform;
        poster.material().emissive = glm::vec3(1.0f);
        poster.material().emissive_texture = ref;
        return poster.film();
    };
    check_quarters(shown({}), {red, green, blue, white});
    check_quarters(shown({.offset = {0.5f, 0.0f}}), {green, red, white, blue});
    check_quarters(shown({.scale = {0.5f, 0.5f}}), {red, red, red, red});
    check_quarters(shown({.offset = {0.5f, 0.5f}, .scale = {0.5f, 0.5f}}), {white, white, white, white});
    check_quarters(shown({.offset = {0.0f, 1.0f}, .scale = {1.0f, -1.0f}}), {blue, white, red, green});

    // Coordinates turn counter-clockwise about the top left corner and down again, so the image turns
    // clockwise: what was at its left is now at the top.
    constexpr float quarter_turn = std::numbers::pi_v<float> / 2;
    check_quarters(shown({.offset = {0.0f, 1.0f}, .rotation_rad = quarter_turn}), {blue, red, white, green});
    // Scaled before it turns: the image's left half, its lower part first, fills the picture.
    check_quarters(shown({.offset = {0.0f, 1.0f}, .rotation_rad = quarter_turn, .scale = {1.0f, 0.5f}}),
                   {blue, red, blue, red});
}

TEST_CASE("base colour and roughness have transforms of their own", "[engine]") {
    Poster poster;
    anim::TextureRef ref = poster.add_four_colors();
    ref.transform.offset = {0.5f, 0.0f};
    poster.material().base_color = glm::vec4(1.0f);
    poster.material().base_color_texture = ref;
    Film film = poster.film();
    CHECK(quarter(film, 0, 0).y > 2.0f * quarter(film, 0, 0).x);  // green
    CHECK(quarter(film, 1, 0).x > 2.0f * quarter(film, 1, 0).y);  // red

    // White metal where the texture's blue is 1; a black dielectric elsewhere.
    Poster metal;
    metal.material().metallic = 1.0f;
    metal.material().base_color = glm::vec4(1.0f);
    metal.material().metallic_roughness_texture = metal.add_four_colors();
    const float at_origin = quarter(metal.film(), 0, 0).x;  // red texel: dielectric, smooth
    metal.material().metallic_roughness_texture->transform.offset = {0.5f, 0.5f};
    CHECK(quarter(metal.film(), 0, 0).x < 0.9f * at_origin);  // white texel: metal, rough
}

TEST_CASE("a smaller scale of the texture looks up a larger size of it", "[engine]") {
    // 64 black and white columns over 32 pixels: grey, unless an eighth of them fills the picture.
    Poster poster;
    poster.builder.scene.lights[0].intensity = 0.0f;
    std::vector<std::uint8_t> columns;
    for (int i = 0; i < 64 * 64; ++i) columns.push_back(i % 2 == 0 ? 0 : 255);
    poster.builder.scene.images = {test::png(64, 64, 1, columns)};
    poster.builder.scene.textures = {{.image = 0}};
    poster.material().emissive = glm::vec3(1.0f);
    poster.material().emissive_texture = anim::TextureRef{.texture = 0};
    const auto contrast = [&] {
        const Film film = poster.film();
        float least = 1.0f, most = 0.0f;
        for (int x = 0; x < 32; ++x) {
            least = std::min(least, film.pixel(x, 16)[Film::R]);
            most = std::max(most, film.pixel(x, 16)[Film::R]);
        }
        return most - least;
    };
    CHECK(contrast() < 0.1f);
    poster.material().emissive_texture->transform.scale = glm::vec2(0.125f);
    CHECK(contrast() > 0.7f);
    poster.material().emissive_texture->transform.scale = glm::vec2(8.0f);
    CHECK(contrast() < 0.1f);
}

TEST_CASE("transforms beyond all bounds give a finite picture", "[engine]") {
    constexpr float huge = std::numeric_limits<float>::max();
    Poster poster;
    anim::TextureRef ref = poster.add_four_colors();
    poster.material().emissive = glm::vec3(1.0f);
    for (const anim::TextureTransform& transform :
         {anim::TextureTransform{.offset = {huge, -huge}}, anim::TextureTransform{.scale = {huge, huge}},
          anim::TextureTransform{.rotation_rad = huge, .scale = {-huge, huge}},
          anim::TextureTransform{.scale = {0.0f, 0.0f}}}) {
        ref.transform = transform;
        poster.material().emissive_texture = poster.material().base_color_texture = ref;
        for (const float value : poster.film().pixels) CHECK(std::isfinite(value));
    }
}
