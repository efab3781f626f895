#include "gltf_builder.h"

#include <catch2/catch.hpp>

using namespace gridreel;
using nlohmann::json;

namespace {

anim::Scene with_materials(const json& materials) {
    auto file = test::one_triangle();
    file.json["images"] = {{{"uri", "data:image/png;base64,AAAA"}}};
    file.json["textures"] = {{{"source", 0}}};
    file.json["materials"] = materials;
    return file.load();
}

json extended(const std::string& name, const json& extension) {
    return {{"extensions", {{name, extension}}}};
}

}  // namespace

TEST_CASE("looks that are not drawn are warned of once, at the first material that has one", "[load]") {
    const json texture = {{"index", 0}};
    const auto scene = with_materials({json::object(),
                                       {{"normalTexture", texture}, {"emissiveTexture", texture}},
                                       {{"normalTexture", texture}, {"occlusionTexture", texture}}});
    CHECK(scene.warnings.size() == 2);
    CHECK(test::warning_at(scene, "/materials/1/normalTexture") ==
          "2 materials have a normal map; it is not drawn yet");
    CHECK(test::warning_at(scene, "/materials/2/occlusionTexture") ==
          "1 material has an occlusion map; it is not drawn yet");
}

TEST_CASE("extensions that are not drawn are warned of in plain words", "[load]") {
    const auto warning_of = [](const std::string& name, const json& extension) {
        const auto scene = with_materials({json::object(), extended(name, extension)});
        CHECK(scene.warnings.size() == 1);
        return test::warning_at(scene, "/materials/1/extensions/" + name);
    };
    CHECK(warning_of("KHR_materials_clearcoat", {{"clearcoatFactor", 1}}) ==
          "1 material has a clearcoat; it is not drawn yet");
    CHECK(warning_of("KHR_materials_sheen", {{"sheenColorFactor", {0, 0, 0.1}}}) ==
          "1 material has a sheen; it is not drawn yet");
    CHECK(warning_of("KHR_materials_ior", {{"ior", 1.33}}) ==
          "1 material has an index of refraction other than 1.5; it is not drawn yet");
    CHECK(warning_of("KHR_materials_specular", {{"specularFactor", 0.5}}) ==
          "1 material has reflections of a strength or colour other than the default; it is not drawn yet");
    CHECK(warning_of("KHR_materials_transmission", {{"transmissionFactor", 1}}) ==
          "1 material has transmission; until it is drawn, such surfaces are opaque");
    CHECK(warning_of("KHR_materials_volume", {{"thicknessFactor", 1}}) ==
          "1 material has a volume; it is not drawn yet");
    CHECK(warning_of("KHR_materials_iridescence", json::object()) ==
          "1 material has iridescence; it is not drawn yet");
}

TEST_CASE("a look that an animation switches on is warned of", "[load][pointer]") {
    const auto warnings_with = [](const std::string& property) {
        auto file = test::one_triangle();
        file.json["images"] = {{{"uri", "data:image/png;base64,AAAA"}}};
        file.json["textures"] = {{{"source", 0}}};
        const json off = {{"occlusionTexture", {{"index", 0}, {"strength", 0}}},
                          {"extensions", {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0}}}}}};
        file.json["materials"] = {off, off};
        const auto input = file.add_scalars({0, 1}), output = file.add_scalars({0, 1});
        const json pointer = {{"pointer", "/materials/1/" + property}};
        const json target = {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", pointer}}}};
        file.json["animations"] = {{{"samplers", {{{"input", input}, {"output", output}}}},
                                    {"channels", {{{"sampler", 0}, {"target", target}}}}}};
        return file.load().warnings;
    };
    const auto clearcoat = warnings_with("extensions/KHR_materials_clearcoat/clearcoatFactor");
    REQUIRE(clearcoat.size() == 1);
    CHECK(clearcoat[0].where == "/materials/1/extensions/KHR_materials_clearcoat");
    CHECK(clearcoat[0].text == "1 material has a clearcoat; it is not drawn yet");
    const auto occlusion = warnings_with("occlusionTexture/strength");
    REQUIRE(occlusion.size() == 1);
    CHECK(occlusion[0].where == "/materials/1/occlusionTexture");
    for (const char* other : {"pbrMetallicRoughness/metallicFactor",
                              "extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor",
                              "occlusionTexture/extensions/KHR_texture_transform/rotation"})
        CHECK(warnings_with(other).empty());
}

TEST_CASE("looks that are switched off or that no light shows are not warned of", "[load]") {
    json unlit = extended("KHR_materials_clearcoat", {{"clearcoatFactor", 1}});
    unlit["extensions"]["KHR_materials_unlit"] = json::object();
    unlit["normalTexture"] = {{"index", 0}};
    const auto scene =
        with_materials({unlit,
                        extended("KHR_materials_clearcoat", {{"clearcoatRoughnessFactor", 1}}),
                        extended("KHR_materials_sheen", {{"sheenRoughnessFactor", 1}}),
                        extended("KHR_materials_ior", {{"ior", 1.5}}),
                        extended("KHR_materials_specular", {{"specularColorFactor", {1, 1, 1}}}),
                        extended("KHR_materials_transmission", {{"transmissionFactor", 0}}),
                        extended("KHR_materials_volume", {{"attenuationDistance", 1}}),
                        {{"occlusionTexture", {{"index", 0}, {"strength", 0}}}}});
    CHECK(scene.warnings.empty());
}
