#include "gltf_builder.h"

#include <catch2/catch.hpp>

using namespace gridreel;
using Catch::Matchers::Contains;

TEST_CASE("a material left empty has the specification's defaults", "[load]") {
    auto file = test::one_triangle();
    file.json["materials"] = nlohmann::json::array({nlohmann::json::object()});
    const auto material = file.load().materials.at(0);
    CHECK(material.base_color == glm::vec4(1));
    CHECK(material.metallic == 1.0f);
    CHECK(material.roughness == 1.0f);
    CHECK(material.emissive == glm::vec3(0));
    CHECK(material.alpha_mode == anim::AlphaMode::opaque);
    CHECK(material.alpha_cutoff == 0.5f);
    CHECK_FALSE(material.double_sided);
    CHECK_FALSE(material.base_color_texture);
    CHECK_FALSE(material.metallic_roughness_texture);
    CHECK_FALSE(material.emissive_texture);
}

TEST_CASE("materials are read whole", "[load]") {
    auto file = test::one_triangle();
    file.json["textures"] = {nlohmann::json::object(), nlohmann::json::object(), nlohmann::json::object()};
    file.json["materials"] = {{{"name", "glass"},
                               {"pbrMetallicRoughness",
                                {{"baseColorFactor", {0.5, 0.25, 1, 0.75}},
                                 {"baseColorTexture", {{"index", 2}, {"texCoord", 1}}},
                                 {"metallicFactor", 0.125},
                                 {"roughnessFactor", 0},
                                 {"metallicRoughnessTexture", {{"index", 1}}}}},
                               {"emissiveFactor", {1, 0, 0.5}},
                               {"emissiveTexture", {{"index", 0}}},
                               {"alphaMode", "MASK"},
                               {"alphaCutoff", 0.25},
                               {"doubleSided", true}},
                              {{"alphaMode", "BLEND"}}};
    const auto scene = file.load();
    const auto& material = scene.materials.at(0);
    CHECK(material.name == "glass");
    CHECK(material.base_color == glm::vec4(0.5f, 0.25f, 1, 0.75f));
    REQUIRE(material.base_color_texture);
    CHECK(material.base_color_texture->texture == 2);
    CHECK(material.base_color_texture->texcoord == 1);
    CHECK(material.metallic == 0.125f);
    CHECK(material.roughness == 0.0f);
    REQUIRE(material.metallic_roughness_texture);
    CHECK(material.metallic_roughness_texture->texture == 1);
    CHECK(material.metallic_roughness_texture->texcoord == 0);
    CHECK(material.emissive == glm::vec3(1, 0, 0.5f));
    REQUIRE(material.emissive_texture);
    CHECK(material.emissive_texture->texture == 0);
    CHECK(material.alpha_mode == anim::AlphaMode::mask);
    CHECK(material.alpha_cutoff == 0.25f);
    CHECK(material.double_sided);
    CHECK(scene.materials.at(1).alpha_mode == anim::AlphaMode::blend);
}

TEST_CASE("a texture on TEXCOORD_2 is left out with a warning", "[load]") {
    auto file = test::one_triangle();
    file.json["textures"] = nlohmann::json::array({nlohmann::json::object()});
    file.json["materials"] = {{{"emissiveTexture", {{"index", 0}, {"texCoord", 2}}}}};
    const auto scene = file.load();
    CHECK_FALSE(scene.materials.at(0).emissive_texture);
    CHECK_THAT(test::warning_at(scene, "/materials/0/emissiveTexture"), Contains("TEXCOORD_2"));
}

TEST_CASE("a texture without a sampler repeats and is filtered smoothly", "[load]") {
    auto file = test::one_triangle();
    file.json["images"] = {{{"uri", "data:image/png;base64,AAAA"}}};
    file.json["textures"] = {{{"source", 0}}, {{"sampler", 0}}};
    file.json["samplers"] = nlohmann::json::array({nlohmann::json::object()});
    for (const auto& texture : file.load().textures) {
        CHECK(texture.wrap_s == anim::Wrap::repeat);
        CHECK(texture.wrap_t == anim::Wrap::repeat);
        CHECK(texture.mag_filter == anim::Filter::linear);
        CHECK(texture.min_filter == anim::Filter::linear);
        CHECK(texture.mip_filter == anim::MipFilter::linear);
    }
    CHECK(file.load().textures[0].image == 0u);
    CHECK_FALSE(file.load().textures[1].image);
}

TEST_CASE("every filter and wrap of a sampler is told apart", "[load]") {
    using enum anim::MipFilter;
    struct Case {
        int code;
        anim::Filter filter;
        anim::MipFilter mip;
    };
    for (const auto& [code, filter, mip] : {Case{9728, anim::Filter::nearest, none},
                                            {9729, anim::Filter::linear, none},
                                            {9984, anim::Filter::nearest, nearest},
                                            {9985, anim::Filter::linear, nearest},
                                            {9986, anim::Filter::nearest, linear},
                                            {9987, anim::Filter::linear, linear}}) {
        auto file = test::one_triangle();
        file.json["textures"] = {{{"sampler", 0}}};
        file.json["samplers"] = {
            {{"minFilter", code}, {"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33648}}};
        const auto texture = file.load().textures.at(0);
        CHECK(texture.min_filter == filter);
        CHECK(texture.mip_filter == mip);
        CHECK(texture.mag_filter == anim::Filter::nearest);
        CHECK(texture.wrap_s == anim::Wrap::clamp_to_edge);
        CHECK(texture.wrap_t == anim::Wrap::mirrored_repeat);
    }
}

TEST_CASE("versions 2.x are read unless they need a newer reader", "[load]") {
    auto file = test::one_triangle();
    const auto with = [&](const nlohmann::json& asset) {
        file.json["asset"] = asset;
        return test::refusal_of(file).pointer;
    };
    CHECK(with({{"version", "2.0"}}).empty());
    CHECK(with({{"version", "2.7"}}).empty());
    CHECK(with({{"version", "2.7"}, {"minVersion", "2.0"}}).empty());
    CHECK(with({{"version", "2.7"}, {"minVersion", "2.1"}}) == "/asset/minVersion");
    CHECK(with({{"version", "1.0"}}) == "/asset/version");
    CHECK(with({{"version", "3.0"}}) == "/asset/version");
    CHECK(with({{"version", "two"}}) == "/asset/version");
    CHECK(with({{"version", ""}}) == "/asset/version");
    CHECK(with({{"version", 2.0}}) == "/asset/version");
    CHECK(with({{"generator", "me"}}) == "/asset");
}
