#include "anim/variants.h"

#include "anim/error.h"
#include "gltf_builder.h"

#include <catch2/catch.hpp>

using namespace gridreel;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// Variants "day", "night" and "1"; the first primitive has materials for "day" and "1", the second none.
test::GltfBuilder shop() {
    auto file = test::one_triangle();
    file.json["materials"] = {json::object(), json::object(), json::object()};
    file.json["extensions"]["KHR_materials_variants"]["variants"] = {
        {{"name", "day"}}, {{"name", "night"}}, {{"name", "1"}}};
    json& primitives = file.json["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    primitives[0]["material"] = 0;
    primitives[0]["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"material", 2}, {"variants", {0}}}, {{"material", 1}, {"variants", {2, 0}}}};
    return file;
}

}  // namespace

TEST_CASE("variants and their materials are read", "[variants]") {
    const auto scene = shop().load();
    CHECK(scene.variants == std::vector<std::string>{"day", "night", "1"});
    const auto& materials = scene.meshes.at(0).primitives.at(0).variant_materials;
    REQUIRE(materials.size() == 2);  // the second mapping of "day" does not count
    CHECK(materials[0].variant == 0);
    CHECK(materials[0].material == 2);
    CHECK(materials[1].variant == 2);
    CHECK(materials[1].material == 1);
    CHECK(scene.meshes[0].primitives.at(1).variant_materials.empty());
}

TEST_CASE("showing a variant changes the materials it names and no others", "[variants]") {
    const auto material_in = [](anim::Index variant) {
        auto scene = shop().load();
        anim::show_variant(scene, variant);
        CHECK_FALSE(scene.meshes.at(0).primitives.at(1).material);
        return scene.meshes[0].primitives[0].material;
    };
    CHECK(material_in(0) == 2u);
    CHECK(material_in(1) == 0u);
    CHECK(material_in(2) == 1u);
}

TEST_CASE("a variant is chosen by name, then by number, or the choice is listed", "[variants]") {
    const auto scene = shop().load();
    CHECK(anim::choose_variant(scene, "night") == 1);
    CHECK(anim::choose_variant(scene, "0") == 0);
    CHECK(anim::choose_variant(scene, "1") == 2);
    for (const auto* const choice : {"dusk", "3", "-1", ""})
        CHECK_THROWS_WITH(anim::choose_variant(scene, choice),
                          Contains("--variant") && Contains("0 \"day\", 1 \"night\", 2 \"1\""));
    CHECK_THROWS_WITH(anim::choose_variant(test::one_triangle().load(), "day"), Contains("no variants"));
}

TEST_CASE("variants that break the extension are refused where they do", "[variants]") {
    const auto pointer = [](void (*damage)(json&)) {
        auto file = shop();
        damage(file.json);
        return test::refusal_of(file).pointer;
    };
    const std::string root = "/extensions/KHR_materials_variants/variants";
    const std::string mapping = "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings";
    CHECK(pointer([](json& file) { file["extensions"]["KHR_materials_variants"]["variants"] = 3; }) == root);
    CHECK(pointer([](json& file) {
              file["extensions"]["KHR_materials_variants"]["variants"][1].erase("name");
          }) == root + "/1");
    CHECK(pointer([](json& file) { file.erase("extensions"); }) == mapping + "/0/variants/0");
    const auto damaged = [&](const json& value) {
        auto file = shop();
        file.json[json::json_pointer(mapping + "/1")] = value;
        return test::refusal_of(file).pointer;
    };
    CHECK(damaged(3) == mapping + "/1");
    CHECK(damaged({{"variants", {0}}}) == mapping + "/1");
    CHECK(damaged({{"material", 0}, {"variants", json::array()}}) == mapping + "/1/variants");
    CHECK(damaged({{"material", 3}, {"variants", {0}}}) == mapping + "/1/material");
    CHECK(damaged({{"material", 0}, {"variants", {0, 3}}}) == mapping + "/1/variants/1");
}
