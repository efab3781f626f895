#include "anim/gltf/extensions.h"

#include "gltf_builder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

using namespace gridreel;
using anim::gltf::Extension;
using anim::gltf::Treatment;
using Catch::Matchers::Contains;

TEST_CASE("every known extension is listed once, by name, and says what differs or what to do",
          "[extensions]") {
    const auto known = anim::gltf::known_extensions();
    const auto not_before = [](const Extension& a, const Extension& b) { return a.name >= b.name; };
    CHECK(std::adjacent_find(known.begin(), known.end(), not_before) == known.end());
    for (const Extension& extension : known) {
        INFO(extension.name);
        CHECK(anim::gltf::find_extension(extension.name) == &extension);
        const bool explains =
            extension.treatment == Treatment::approximated || extension.treatment == Treatment::refused;
        CHECK(extension.note.empty() != explains);
    }
    CHECK(anim::gltf::find_extension("KHR_unheard_of") == nullptr);
}

TEST_CASE("a file may require every extension that is not refused, and none that is", "[extensions]") {
    for (const Extension& extension : anim::gltf::known_extensions()) {
        INFO(extension.name);
        auto file = test::one_triangle();
        file.json["extensionsUsed"] = file.json["extensionsRequired"] =
            nlohmann::json::array({extension.name});
        const auto refusal = test::refusal_of(file);
        if (extension.treatment == Treatment::refused) {
            CHECK(refusal.pointer == "/extensionsRequired");
            CHECK_THAT(refusal.message,
                       Contains(std::string(extension.name)) && Contains(std::string(extension.note)));
        } else {
            CHECK(refusal.message.empty());
            CHECK(file.load().warnings.empty());
        }
    }
}

TEST_CASE("of extensions that are used, the unknown and the refused are warned of", "[extensions]") {
    auto file = test::one_triangle();
    file.json["extensionsUsed"] = {"KHR_lights_punctual", "EXT_unheard_of", "KHR_xmp_json_ld",
                                   "KHR_materials_pbrSpecularGlossiness"};
    file.json["materials"] = {{{"extensions", {{"EXT_unheard_of", {{"factor", "odd"}}}}},
                               {"extras", {{"anything", {1, nullptr, "goes"}}}}}};
    const auto scene = file.load();
    CHECK(scene.extensions_used.size() == 4);
    CHECK(scene.warnings.size() == 2);
    CHECK(test::warning_at(scene, "/extensionsUsed/1") == "EXT_unheard_of is not known; it is ignored");
    CHECK(test::warning_at(scene, "/extensionsUsed/3") ==
          "KHR_materials_pbrSpecularGlossiness is not supported; it is ignored (convert the materials: npx "
          "@gltf-transform/cli metalrough IN.glb OUT.glb)");
}

TEST_CASE("extensions that are required and not understood are refused by name, with every remedy once",
          "[extensions]") {
    auto file = test::one_triangle();
    file.json["extensionsRequired"] = {"KHR_lights_punctual", "KHR_materials_pbrSpecularGlossiness",
                                       "X_other", "Y_other"};
    const auto refusal = test::refusal_of(file);
    CHECK(refusal.pointer == "/extensionsRequired");
    CHECK_THAT(refusal.message,
               Contains("requires KHR_materials_pbrSpecularGlossiness, X_other, Y_other, which are not") &&
                   Contains("metalrough IN.glb OUT.glb; export the model without what is not supported") &&
                   !Contains("punctual"));
    CHECK(refusal.message.find("without what") == refusal.message.rfind("without what"));
}
