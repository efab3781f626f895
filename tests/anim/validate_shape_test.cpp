#include "defect.h"

#include <catch2/catch.hpp>

using namespace gridreel;
using Catch::Matchers::Contains;
using nlohmann::json;

TEST_CASE("wrong types, missing properties and ranges are refused where they are", "[validate]") {
    const test::Defect defects[] = {
        {"an array that is not one", "/nodes", "must be an array",
         [](auto& f) { f.json["nodes"] = json::object(); }},
        {"an item that is not an object", "/nodes/0", "must be an object",
         [](auto& f) { f.json["nodes"][0] = 7; }},
        {"null", "/nodes/0/mesh", "must be a number", [](auto& f) { f.json["nodes"][0]["mesh"] = nullptr; }},
        {"a name that is not text", "/nodes/0/name", "must be a string",
         [](auto& f) { f.json["nodes"][0]["name"] = 7; }},
        {"a flag that is not one", "/accessors/0/normalized", "true or false",
         [](auto& f) { f.json["accessors"][0]["normalized"] = 1; }},
        {"a fraction as index", "/nodes/0/mesh", "not an integer",
         [](auto& f) { f.json["nodes"][0]["mesh"] = 0.5; }},
        {"a negative index", "/nodes/0/mesh", "not an integer",
         [](auto& f) { f.json["nodes"][0]["mesh"] = -1; }},
        {"an index beyond 2^53", "/nodes/0/mesh", "not an integer",
         [](auto& f) { f.json["nodes"][0]["mesh"] = 1e300; }},
        {"no accessor count", "/accessors/0", "\"count\" is missing",
         [](auto& f) { f.json["accessors"][0].erase("count"); }},
        {"an accessor of nothing", "/accessors/0/count", "at least 1",
         [](auto& f) { f.json["accessors"][0]["count"] = 0; }},
        {"an unknown component type", "/accessors/0/componentType", "5124 is not a \"componentType\"",
         [](auto& f) { f.json["accessors"][0]["componentType"] = 5124; }},
        {"an unknown element type", "/accessors/0/type", "\"VEC5\" is not a \"type\"",
         [](auto& f) { f.json["accessors"][0]["type"] = "VEC5"; }},
        {"a stride too small", "/bufferViews/0/byteStride", "at least 4",
         [](auto& f) { f.json["bufferViews"][0]["byteStride"] = 3; }},
        {"a mesh without primitives", "/meshes/0/primitives", "at least 1",
         [](auto& f) { f.json["meshes"][0]["primitives"] = json::array(); }},
        {"an unknown mode", "/meshes/0/primitives/0/mode", "7 is not a \"mode\"",
         [](auto& f) { f.json["meshes"][0]["primitives"][0]["mode"] = 7; }},
        {"attributes that are a list", "/meshes/0/primitives/0/attributes", "must be an object",
         [](auto& f) { f.json["meshes"][0]["primitives"][0]["attributes"] = json::array({0}); }},
        {"a short matrix", "/nodes/0/matrix", "exactly 16",
         [](auto& f) {
             f.json["nodes"][0]["matrix"] = {1, 2};
         }},
        {"a number beyond float", "/nodes/0/translation/1", "out of range",
         [](auto& f) {
             f.json["nodes"][0]["translation"] = {0, 1e39, 0};
         }},
        {"text among numbers", "/nodes/0/scale/2", "must be a number",
         [](auto& f) {
             f.json["nodes"][0]["scale"] = {1, 1, "1"};
         }},
        {"no field of view", "/cameras/0/perspective", "\"yfov\" is missing",
         [](auto& f) {
             f.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"znear", 1}}}}};
         }},
        {"a field of view of zero", "/cameras/0/perspective/yfov", "above 0",
         [](auto& f) {
             f.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"znear", 1}, {"yfov", 0}}}}};
         }},
        {"a base colour above one", "/materials/0/pbrMetallicRoughness/baseColorFactor/3", "at most 1",
         [](auto& f) {
             f.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 2}}}}}};
         }},
        {"an unknown alpha mode", "/materials/0/alphaMode", "OPAQUE, MASK, BLEND",
         [](auto& f) {
             f.json["materials"] = {{{"alphaMode", "DITHER"}}};
         }},
        {"an unknown interpolation", "/animations/0/samplers/0/interpolation", "LINEAR, STEP, CUBICSPLINE",
         [](auto& f) {
             f.json["animations"] = {
                 {{"channels", json::array()},
                  {"samplers", {{{"input", 0}, {"output", 0}, {"interpolation", "BEZIER"}}}}}};
         }},
        {"extensions that are not named", "/extensionsUsed/0", "must be a string",
         [](auto& f) { f.json["extensionsUsed"] = {1}; }},
        {"a pointer with slashes", "/meshes/0/primitives/0/attributes/a~1b~0c", "out of range",
         [](auto& f) { f.json["meshes"][0]["primitives"][0]["attributes"]["a/b~c"] = 9; }},
    };
    test::check_refusals(defects);
}

TEST_CASE("every index out of range is refused where it is", "[validate]") {
    const std::string pointers[] = {
        "/scene",
        "/scenes/0/nodes/0",
        "/nodes/0/mesh",
        "/nodes/0/skin",
        "/nodes/0/camera",
        "/nodes/1/children/0",
        "/nodes/0/extensions/KHR_lights_punctual/light",
        "/skins/0/joints/0",
        "/skins/0/skeleton",
        "/skins/0/inverseBindMatrices",
        "/meshes/0/primitives/0/attributes/POSITION",
        "/meshes/0/primitives/0/indices",
        "/meshes/0/primitives/0/material",
        "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/0/material",
        "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/0/variants/1",
        "/meshes/0/primitives/0/targets/0/POSITION",
        "/accessors/0/bufferView",
        "/accessors/0/sparse/indices/bufferView",
        "/accessors/0/sparse/values/bufferView",
        "/bufferViews/0/buffer",
        "/materials/0/pbrMetallicRoughness/baseColorTexture/index",
        "/materials/0/pbrMetallicRoughness/metallicRoughnessTexture/index",
        "/materials/0/extensions/KHR_materials_clearcoat/clearcoatNormalTexture/index",
        "/materials/0/extensions/KHR_materials_specular/specularColorTexture/index",
        "/materials/0/extensions/KHR_materials_volume/thicknessTexture/index",
        "/materials/0/normalTexture/index",
        "/materials/0/occlusionTexture/index",
        "/materials/0/emissiveTexture/index",
        "/textures/0/source",
        "/textures/0/sampler",
        "/textures/0/extensions/EXT_texture_webp/source",
        "/textures/0/extensions/KHR_texture_basisu/source",
        "/images/0/bufferView",
        "/animations/0/samplers/0/input",
        "/animations/0/samplers/0/output",
        "/animations/0/channels/0/sampler",
        "/animations/0/channels/0/target/node",
    };

    auto whole = test::skinned_triangle();
    const auto indices = whole.add_view<std::uint8_t>({0});
    const auto values = whole.add_view<float>({0, 0, 0});
    const auto times = whole.add_scalars({0});
    const auto moves = whole.add_vec3s({0, 0, 0});
    const auto matrices = whole.add_accessor(std::vector<float>(32, 1.0f), test::float32, "MAT4", 2);
    const json texture{{"index", 0}};
    whole.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", test::uint8}}},
        {"values", {{"bufferView", values}}}};
    whole.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
    whole.json["meshes"][0]["primitives"][0]["material"] = 0;
    whole.json["skins"][0]["skeleton"] = 1;
    whole.json["skins"][0]["inverseBindMatrices"] = matrices;
    whole.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"znear", 1}, {"yfov", 1}}}}};
    whole.json["nodes"][0]["camera"] = 0;
    whole.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    whole.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    whole.json["images"] = {{{"bufferView", 0}, {"mimeType", "image/png"}}};
    whole.json["samplers"] = json::array({json::object()});
    whole.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    whole.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", texture}, {"metallicRoughnessTexture", texture}}},
         {"normalTexture", texture},
         {"occlusionTexture", texture},
         {"emissiveTexture", texture},
         {"extensions",
          {{"KHR_materials_clearcoat", {{"clearcoatNormalTexture", texture}}},
           {"KHR_materials_specular", {{"specularColorTexture", texture}}},
           {"KHR_materials_volume", {{"thicknessTexture", texture}}}}}}};
    const json other_source{{"source", 0}};
    whole.json["textures"][0]["extensions"] = {{"EXT_texture_webp", other_source},
                                               {"KHR_texture_basisu", other_source}};
    whole.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "day"}}, {{"name", "night"}}};
    whole.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"material", 0}, {"variants", {0, 1}}}};
    whole.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", moves}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}}};
    REQUIRE(test::refusal_of(whole).message.empty());

    for (const auto& pointer : pointers) {
        DYNAMIC_SECTION(pointer) {
            auto file = whole;
            REQUIRE(file.json.contains(json::json_pointer(pointer)));
            file.json[json::json_pointer(pointer)] = 9999;
            const auto refusal = test::refusal_of(file);
            CHECK(refusal.pointer == pointer);
            CHECK_THAT(refusal.message, Contains("index 9999 is out of range"));
        }
    }
}

TEST_CASE("empty arrays are tolerated", "[validate]") {
    auto file = test::one_triangle();
    for (const auto* const array :
         {"animations", "skins", "materials", "textures", "cameras", "extensionsUsed"})
        file.json[array] = json::array();
    file.json["nodes"][0]["children"] = json::array();
    file.json["nodes"][0]["weights"] = json::array();
    file.json["meshes"][0]["weights"] = json::array();
    CHECK(test::refusal_of(file).message.empty());
}
