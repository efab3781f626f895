#include "defect.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace gridreel;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// One triangle, three textures and one material.
test::GltfBuilder with_material(const json& material) {
    auto file = test::one_triangle();
    file.json["textures"] = {json::object(), json::object(), json::object()};
    file.json["materials"] = json::array({material});
    return file;
}

test::GltfBuilder with_extension(const std::string& name, const json& extension) {
    return with_material({{"extensions", {{name, extension}}}});
}

anim::Material extended(const std::string& name, const json& extension) {
    return with_extension(name, extension).load().materials.at(0);
}

json texture(int index, int texcoord = 0) {
    return {{"index", index}, {"texCoord", texcoord}};
}

void check_ref(const std::optional<anim::TextureRef>& ref, anim::Index index, std::uint32_t texcoord = 0) {
    REQUIRE(ref);
    CHECK(ref->texture == index);
    CHECK(ref->texcoord == texcoord);
}

}  // namespace

TEST_CASE("extensions to materials left empty have their specifications' defaults", "[load]") {
    json extensions;
    for (const auto* const name : {"KHR_materials_emissive_strength", "KHR_materials_ior",
                                   "KHR_materials_specular", "KHR_materials_clearcoat", "KHR_materials_sheen",
                                   "KHR_materials_transmission", "KHR_materials_volume"})
        extensions[name] = json::object();
    const auto scene = with_material({{"extensions", extensions}}).load();
    const anim::Material& m = scene.materials.at(0);
    CHECK_FALSE(m.unlit);
    CHECK(m.emissive_strength == 1.0f);
    CHECK(m.ior == 1.5f);
    CHECK(m.specular.factor == 1.0f);
    CHECK(m.specular.color == glm::vec3(1));
    CHECK(m.clearcoat.factor == 0.0f);
    CHECK(m.clearcoat.roughness == 0.0f);
    CHECK(m.clearcoat.normal_scale == 1.0f);
    CHECK(m.sheen.color == glm::vec3(0));
    CHECK(m.sheen.roughness == 0.0f);
    CHECK(m.transmission.factor == 0.0f);
    CHECK(m.volume.thickness_m == 0.0f);
    CHECK(m.volume.attenuation_distance_m == std::numeric_limits<float>::infinity());
    CHECK(m.volume.attenuation_color == glm::vec3(1));
    CHECK_FALSE((m.specular.texture || m.specular.color_texture || m.clearcoat.texture ||
                 m.clearcoat.roughness_texture || m.clearcoat.normal_texture || m.sheen.color_texture ||
                 m.sheen.roughness_texture || m.transmission.texture || m.volume.thickness_texture));
    CHECK(scene.warnings.empty());
}

TEST_CASE("normal and occlusion maps are read with their strengths", "[load]") {
    const auto file = with_material({{"normalTexture", {{"index", 1}, {"texCoord", 1}, {"scale", -2.5}}},
                                     {"occlusionTexture", {{"index", 2}, {"strength", 0.25}}}});
    const auto m = file.load().materials.at(0);
    check_ref(m.normal_texture, 1, 1);
    CHECK(m.normal_scale == -2.5f);
    check_ref(m.occlusion_texture, 2);
    CHECK(m.occlusion_strength == 0.25f);
}

TEST_CASE("unlit materials and strong emission are read", "[load]") {
    CHECK(extended("KHR_materials_unlit", json::object()).unlit);
    CHECK(extended("KHR_materials_emissive_strength", {{"emissiveStrength", 16}}).emissive_strength == 16.0f);
}

TEST_CASE("specular is read whole", "[load]") {
    const auto specular = extended("KHR_materials_specular", {{"specularFactor", 0.5},
                                                              {"specularTexture", texture(1)},
                                                              {"specularColorFactor", {0, 0.5, 3}},
                                                              {"specularColorTexture", texture(2, 1)}})
                              .specular;
    CHECK(specular.factor == 0.5f);
    check_ref(specular.texture, 1);
    CHECK(specular.color == glm::vec3(0, 0.5f, 3));
    check_ref(specular.color_texture, 2, 1);
}

TEST_CASE("clearcoat is read whole", "[load]") {
    json normal = texture(2, 1);
    normal["scale"] = 0.5;
    const auto coat = extended("KHR_materials_clearcoat", {{"clearcoatFactor", 0.75},
                                                           {"clearcoatTexture", texture(0, 1)},
                                                           {"clearcoatRoughnessFactor", 0.25},
                                                           {"clearcoatRoughnessTexture", texture(1)},
                                                           {"clearcoatNormalTexture", normal}})
                          .clearcoat;
    CHECK(coat.factor == 0.75f);
    check_ref(coat.texture, 0, 1);
    CHECK(coat.roughness == 0.25f);
    check_ref(coat.roughness_texture, 1);
    check_ref(coat.normal_texture, 2, 1);
    CHECK(coat.normal_scale == 0.5f);
}

TEST_CASE("sheen, transmission, volume and index of refraction are read whole", "[load]") {
    const auto sheen = extended("KHR_materials_sheen", {{"sheenColorFactor", {1, 0.5, 0}},
                                                        {"sheenColorTexture", texture(0)},
                                                        {"sheenRoughnessFactor", 0.125},
                                                        {"sheenRoughnessTexture", texture(1)}})
                           .sheen;
    CHECK(sheen.color == glm::vec3(1, 0.5f, 0));
    check_ref(sheen.color_texture, 0);
    CHECK(sheen.roughness == 0.125f);
    check_ref(sheen.roughness_texture, 1);

    const auto transmission = extended("KHR_materials_transmission",
                                       {{"transmissionFactor", 0.5}, {"transmissionTexture", texture(2)}})
                                  .transmission;
    CHECK(transmission.factor == 0.5f);
    check_ref(transmission.texture, 2);

    const auto volume = extended("KHR_materials_volume", {{"thicknessFactor", 2},
                                                          {"thicknessTexture", texture(1)},
                                                          {"attenuationDistance", 0.5},
                                                          {"attenuationColor", {1, 0.5, 0.25}}})
                            .volume;
    CHECK(volume.thickness_m == 2.0f);
    check_ref(volume.thickness_texture, 1);
    CHECK(volume.attenuation_distance_m == 0.5f);
    CHECK(volume.attenuation_color == glm::vec3(1, 0.5f, 0.25f));

    CHECK(extended("KHR_materials_ior", {{"ior", 1.33}}).ior == 1.33f);
    CHECK(extended("KHR_materials_ior", {{"ior", 0}}).ior == 0.0f);
}

TEST_CASE("an index of refraction between 0 and 1 is read as 1 with a warning", "[load]") {
    const auto scene = with_extension("KHR_materials_ior", {{"ior", 0.75}}).load();
    CHECK(scene.materials[0].ior == 1.0f);
    CHECK_THAT(test::warning_at(scene, "/materials/0/extensions/KHR_materials_ior"), Contains("0.75"));
}

TEST_CASE("texture transforms are read in every slot", "[load]") {
    const json moved = {
        {"index", 1},
        {"texCoord", 0},
        {"extensions",
         {{"KHR_texture_transform",
           {{"offset", {0.5, -1}}, {"rotation", 1e30}, {"scale", {2, 0}}, {"texCoord", 1}}}}}};
    const auto file = with_material(
        {{"pbrMetallicRoughness", {{"baseColorTexture", moved}, {"metallicRoughnessTexture", moved}}},
         {"normalTexture", moved},
         {"occlusionTexture", moved},
         {"emissiveTexture", moved},
         {"extensions",
          {{"KHR_materials_specular", {{"specularTexture", moved}, {"specularColorTexture", moved}}},
           {"KHR_materials_clearcoat",
            {{"clearcoatTexture", moved},
             {"clearcoatRoughnessTexture", moved},
             {"clearcoatNormalTexture", moved}}},
           {"KHR_materials_sheen", {{"sheenColorTexture", moved}, {"sheenRoughnessTexture", moved}}},
           {"KHR_materials_transmission", {{"transmissionTexture", moved}}},
           {"KHR_materials_volume", {{"thicknessTexture", moved}}}}}});
    const auto m = file.load().materials.at(0);
    for (const auto& ref :
         {m.base_color_texture, m.metallic_roughness_texture, m.normal_texture, m.occlusion_texture,
          m.emissive_texture, m.specular.texture, m.specular.color_texture, m.clearcoat.texture,
          m.clearcoat.roughness_texture, m.clearcoat.normal_texture, m.sheen.color_texture,
          m.sheen.roughness_texture, m.transmission.texture, m.volume.thickness_texture}) {
        check_ref(ref, 1, 1);  // the extension's texCoord wins
        CHECK(ref->transform.offset == glm::vec2(0.5f, -1));
        CHECK(ref->transform.rotation_rad == 1e30f);
        CHECK(ref->transform.scale == glm::vec2(2, 0));
    }
}

TEST_CASE("a transform that moves to TEXCOORD_7 leaves the texture out, one that moves from it does not",
          "[load]") {
    const auto with_sets = [](int core, int extension) {
        return with_material({{"emissiveTexture",
                               {{"index", 0},
                                {"texCoord", core},
                                {"extensions", {{"KHR_texture_transform", {{"texCoord", extension}}}}}}}})
            .load();
    };
    const auto out = with_sets(0, 7);
    CHECK_FALSE(out.materials[0].emissive_texture);
    CHECK_THAT(test::warning_at(out, "/materials/0/emissiveTexture"), Contains("TEXCOORD_7"));
    check_ref(with_sets(7, 1).materials[0].emissive_texture, 0, 1);
}

TEST_CASE("extensions to materials that break their specifications are refused where they do", "[validate]") {
    struct Case {
        const char* extension;
        const char* property;
        json value;
        const char* message;
    };
    const Case cases[] = {
        {"KHR_materials_emissive_strength", "emissiveStrength", -1, "at least 0"},
        {"KHR_materials_emissive_strength", "emissiveStrength", "bright", "must be a number"},
        {"KHR_materials_emissive_strength", "emissiveStrength", 1e39, "out of range"},
        {"KHR_materials_ior", "ior", -1.5, "at least 0"},
        {"KHR_materials_specular", "specularFactor", 1.5, "at most 1"},
        {"KHR_materials_specular", "specularColorFactor", json::array({1, 1}), "exactly 3"},
        {"KHR_materials_clearcoat", "clearcoatFactor", 2, "at most 1"},
        {"KHR_materials_clearcoat", "clearcoatRoughnessFactor", nullptr, "must be a number"},
        {"KHR_materials_clearcoat", "clearcoatTexture", 3, "must be an object"},
        {"KHR_materials_sheen", "sheenColorFactor", 1, "must be an array"},
        {"KHR_materials_transmission", "transmissionFactor", -0.1, "at least 0"},
        {"KHR_materials_transmission", "transmissionTexture", json::object(), "\"index\" is missing"},
        {"KHR_materials_volume", "attenuationDistance", 0, "above 0"},
        {"KHR_materials_volume", "thicknessFactor", -1, "at least 0"},
    };
    for (const Case& broken : cases) {
        DYNAMIC_SECTION(broken.extension << " " << broken.property << " " << broken.value) {
            const auto refusal =
                test::refusal_of(with_extension(broken.extension, {{broken.property, broken.value}}));
            const std::string pointer =
                std::string("/materials/0/extensions/") + broken.extension + "/" + broken.property;
            CHECK_THAT(refusal.pointer, Catch::StartsWith(pointer));
            CHECK_THAT(refusal.message, Contains(broken.message));
        }
    }
}

TEST_CASE("references to textures that break the specifications are refused where they do", "[validate]") {
    struct Case {
        json properties;
        const char* pointer;
        const char* message;
    };
    const auto transform = [](const json& properties) {
        return json{{"extensions", {{"KHR_texture_transform", properties}}}};
    };
    const Case cases[] = {
        {{{"scale", "big"}}, "/scale", "must be a number"},
        {{{"texCoord", -1}}, "/texCoord", "not an integer"},
        {{{"texCoord", 1e9}}, "/texCoord", "at most 65535"},
        {{{"extensions", 1}}, "/extensions", "must be an object"},
        {transform({{"offset", 1}}), "/extensions/KHR_texture_transform/offset", "must be an array"},
        {transform({{"offset", {1, 2, 3}}}), "/extensions/KHR_texture_transform/offset", "exactly 2"},
        {transform({{"scale", {1, nullptr}}}), "/extensions/KHR_texture_transform/scale/1", "a number"},
        {transform({{"rotation", "1"}}), "/extensions/KHR_texture_transform/rotation", "a number"},
        {transform({{"rotation", 1e200}}), "/extensions/KHR_texture_transform/rotation", "out of range"},
        {transform({{"texCoord", 0.5}}), "/extensions/KHR_texture_transform/texCoord", "not an integer"},
    };
    for (const Case& broken : cases) {
        DYNAMIC_SECTION(broken.properties) {
            json info = texture(0);
            info.update(broken.properties);
            const auto refusal = test::refusal_of(with_material({{"normalTexture", info}}));
            CHECK(refusal.pointer == std::string("/materials/0/normalTexture") + broken.pointer);
            CHECK_THAT(refusal.message, Contains(broken.message));
        }
    }
    const auto strong = with_material({{"occlusionTexture", {{"index", 0}, {"strength", -1}}}});
    CHECK(test::refusal_of(strong).pointer == "/materials/0/occlusionTexture/strength");
}
