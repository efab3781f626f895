// KHR_animation_pointer: what channels drive when a JSON pointer says so.

#include "anim/pose.h"
#include "gltf_builder.h"

#include <catch2/catch.hpp>

#include <limits>
#include <map>
#include <optional>
#include <string>

using namespace gridreel;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

json channel_to(const std::string& pointer, std::size_t sampler) {
    return {{"sampler", sampler},
            {"target",
             {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}};
}

/// A triangle with two cameras, a spot light, a material and two morph targets.
test::GltfBuilder stage() {
    auto file = test::one_triangle();
    file.json["extensionsUsed"] = {"KHR_animation_pointer", "KHR_lights_punctual"};
    file.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}, {"zfar", 9.0}}}},
        {{"type", "orthographic"},
         {"orthographic", {{"xmag", 1.0}, {"ymag", 1.0}, {"znear", 0.0}, {"zfar", 9.0}}}}};
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = json::array(
        {{{"type", "spot"}, {"range", 5.0}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}}});
    file.json["materials"] = json::array({{{"pbrMetallicRoughness", json::object()}}});
    const auto shift = file.add_vec3s({0, 0, 1, 0, 0, 1, 0, 0, 1});
    file.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", shift}}, {{"POSITION", shift}}};
    return file;
}

/// `stage` with one animation, whose only channel has keys at 0 and 2 s.
test::GltfBuilder pointing(const std::string& pointer, const std::vector<float>& values,
                           std::string_view element) {
    auto file = stage();
    const auto input = file.add_scalars({0, 2});
    const auto width = element == "SCALAR" ? 1 : std::size_t(element.back() - '0');
    const auto output = file.add_accessor(values, test::float32, element, values.size() / width);
    file.json["animations"] = json::array({{{"samplers", {{{"input", input}, {"output", output}}}},
                                            {"channels", json::array({channel_to(pointer, 0)})}}});
    return file;
}

anim::Pose posed(const test::GltfBuilder& file, double time_s) {
    const auto scene = file.load();
    return anim::pose(scene, anim::choose_clip(scene), time_s);
}

}  // namespace

TEST_CASE("a pointer moves a node as its path would", "[load][pointer]") {
    CHECK(posed(pointing("/nodes/0/translation", {0, 0, 0, 2, 4, 6}, "VEC3"), 1.0).world[0][3] ==
          glm::dvec4(1, 2, 3, 1));
    CHECK(posed(pointing("/nodes/0/scale", {1, 1, 1, 3, 5, 7}, "VEC3"), 1.0).world[0][1][1] == 3.0);

    const auto turned = posed(pointing("/nodes/0/rotation", {0, 0, 0, 1, 0, 0, 1, 0}, "VEC4"), 1.0);
    CHECK(turned.world[0][0][1] == Approx(1.0));  // a quarter turn about z
}

TEST_CASE("a pointer drives all weights of a node or one of them", "[load][pointer]") {
    CHECK(posed(pointing("/nodes/0/weights", {0, 0, 1, 3}, "SCALAR"), 1.0).weights[0] ==
          std::vector<float>{0.5f, 1.5f});
    CHECK(posed(pointing("/nodes/0/weights/1", {0, 4}, "SCALAR"), 1.0).weights[0] ==
          std::vector<float>{0.0f, 2.0f});
}

TEST_CASE("a pointer to a mesh's weights drives the nodes that state none", "[load][pointer]") {
    auto file = pointing("/meshes/0/weights", {0, 0, 1, 3}, "SCALAR");
    file.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"weights", {7, 8}}}, {{"mesh", 0}}};
    const auto pose = posed(file, 1.0);
    CHECK(pose.weights[0] == std::vector<float>{0.5f, 1.5f});
    CHECK(pose.weights[1] == std::vector<float>{7.0f, 8.0f});
    CHECK(pose.weights[2] == std::vector<float>{0.5f, 1.5f});

    // What drives a node itself wins, wherever its channel stands.
    file.json["animations"][0]["channels"].insert(file.json["animations"][0]["channels"].begin(),
                                                  channel_to("/nodes/2/weights", 1));
    const auto input = file.add_scalars({0}), output = file.add_scalars({5, 6});
    file.json["animations"][0]["samplers"].push_back({{"input", input}, {"output", output}});
    CHECK(posed(file, 1.0).weights[2] == std::vector<float>{5.0f, 6.0f});
    CHECK(file.load().warnings.empty());
}

TEST_CASE("what drives a node's own weights wins in whichever animation it stands", "[load][pointer]") {
    auto file = pointing("/nodes/0/weights", {0, 0, 1, 3}, "SCALAR");
    auto other = file.json["animations"][0];
    const auto input = file.add_scalars({0}), output = file.add_scalars({5, 6});
    other["channels"][0] = channel_to("/meshes/0/weights", 0);
    other["samplers"] = json::array({{{"input", input}, {"output", output}}});
    file.json["nodes"].push_back({{"mesh", 0}});
    file.json["animations"].push_back(other);
    const auto scene = file.load();
    const auto pose = anim::pose(scene, anim::choose_clip(scene, "all"), 1.0);
    CHECK(pose.weights[0] == std::vector<float>{0.5f, 1.5f});
    CHECK(pose.weights[1] == std::vector<float>{5.0f, 6.0f});
}

TEST_CASE("a pointer drives one weight of a mesh", "[load][pointer]") {
    CHECK(posed(pointing("/meshes/0/weights/1", {0, 4}, "SCALAR"), 1.0).weights[0] ==
          std::vector<float>{0.0f, 2.0f});
}

TEST_CASE("a pointer drives values of cameras and lights", "[load][pointer]") {
    const auto camera = [](const std::string& property, float from, float to, int index = 0) {
        const auto pointer = "/cameras/" + std::to_string(index) + "/" + property;
        return posed(pointing(pointer, {from, to}, "SCALAR"), 1.0).cameras[std::size_t(index)];
    };
    CHECK(camera("perspective/yfov", 1, 2).fov_y_rad == 1.5);
    CHECK(camera("perspective/znear", 1, 2).near_m == 1.5);
    CHECK(camera("perspective/zfar", 1, 2).far_m == 1.5);
    CHECK(camera("orthographic/ymag", 1, 2, 1).y_mag == 1.5);
    CHECK(camera("orthographic/znear", 1, 2, 1).near_m == 1.5);
    CHECK(camera("orthographic/zfar", 1, 2, 1).far_m == 1.5);

    const auto light = [](const std::string& property, std::vector<float> values, std::string_view element) {
        const auto pointer = "/extensions/KHR_lights_punctual/lights/0/" + property;
        return posed(pointing(pointer, values, element), 1.0).lights[0];
    };
    CHECK(light("color", {0, 0, 0, 1, 2, 3}, "VEC3").color == glm::vec3(0.5f, 1.0f, 1.5f));
    CHECK(light("intensity", {0, 8}, "SCALAR").intensity == 4.0f);
    CHECK(light("range", {2, 4}, "SCALAR").range_m == 3.0f);
    CHECK(light("spot/innerConeAngle", {0, 0.5f}, "SCALAR").inner_cone_rad == 0.25f);
    CHECK(light("spot/outerConeAngle", {0.5f, 1.5f}, "SCALAR").outer_cone_rad == 1.0f);
}

TEST_CASE("a pointer drives factors of a material", "[load][pointer]") {
    const auto material = [](const std::string& property, std::vector<float> values,
                             std::string_view element) {
        return posed(pointing("/materials/0/" + property, values, element), 1.0).materials[0];
    };
    const auto factor = [&](const std::string& property) { return material(property, {0, 1}, "SCALAR"); };
    const auto color = [&](const std::string& property) {
        return material(property, {0, 0, 0, 1, 0.5f, 2}, "VEC3");
    };
    const glm::vec3 half(0.5f, 0.25f, 1.0f);
    const std::string ext = "extensions/KHR_materials_";

    CHECK(material("pbrMetallicRoughness/baseColorFactor", {0, 0, 0, 0, 1, 0.5f, 0, 1}, "VEC4").base_color ==
          glm::vec4(0.5f, 0.25f, 0.0f, 0.5f));
    CHECK(factor("pbrMetallicRoughness/metallicFactor").metallic == 0.5f);
    CHECK(factor("pbrMetallicRoughness/roughnessFactor").roughness == 0.5f);
    CHECK(color("emissiveFactor").emissive == half);
    CHECK(factor("alphaCutoff").alpha_cutoff == 0.5f);
    CHECK(factor("normalTexture/scale").normal_scale == 0.5f);
    CHECK(factor("occlusionTexture/strength").occlusion_strength == 0.5f);
    CHECK(factor(ext + "emissive_strength/emissiveStrength").emissive_strength == 0.5f);
    CHECK(material(ext + "ior/ior", {1, 2}, "SCALAR").ior == 1.5f);
    CHECK(factor(ext + "specular/specularFactor").specular.factor == 0.5f);
    CHECK(color(ext + "specular/specularColorFactor").specular.color == half);
    CHECK(factor(ext + "clearcoat/clearcoatFactor").clearcoat.factor == 0.5f);
    CHECK(factor(ext + "clearcoat/clearcoatRoughnessFactor").clearcoat.roughness == 0.5f);
    CHECK(factor(ext + "clearcoat/clearcoatNormalTexture/scale").clearcoat.normal_scale == 0.5f);
    CHECK(color(ext + "sheen/sheenColorFactor").sheen.color == half);
    CHECK(factor(ext + "sheen/sheenRoughnessFactor").sheen.roughness == 0.5f);
    CHECK(factor(ext + "transmission/transmissionFactor").transmission.factor == 0.5f);
    CHECK(factor(ext + "volume/thicknessFactor").volume.thickness_m == 0.5f);
    CHECK(factor(ext + "volume/attenuationDistance").volume.attenuation_distance_m == 0.5f);
    CHECK(color(ext + "volume/attenuationColor").volume.attenuation_color == half);
}

TEST_CASE("a pointer drives the transform of every texture of a material", "[load][pointer]") {
    using Slot = std::optional<anim::TextureRef> (*)(const anim::Material&);
    const std::string ext = "extensions/KHR_materials_";
    const std::map<std::string, Slot> slots{
        {"pbrMetallicRoughness/baseColorTexture", [](auto& m) { return m.base_color_texture; }},
        {"pbrMetallicRoughness/metallicRoughnessTexture",
         [](auto& m) { return m.metallic_roughness_texture; }},
        {"normalTexture", [](auto& m) { return m.normal_texture; }},
        {"occlusionTexture", [](auto& m) { return m.occlusion_texture; }},
        {"emissiveTexture", [](auto& m) { return m.emissive_texture; }},
        {ext + "specular/specularTexture", [](auto& m) { return m.specular.texture; }},
        {ext + "specular/specularColorTexture", [](auto& m) { return m.specular.color_texture; }},
        {ext + "clearcoat/clearcoatTexture", [](auto& m) { return m.clearcoat.texture; }},
        {ext + "clearcoat/clearcoatRoughnessTexture", [](auto& m) { return m.clearcoat.roughness_texture; }},
        {ext + "clearcoat/clearcoatNormalTexture", [](auto& m) { return m.clearcoat.normal_texture; }},
        {ext + "sheen/sheenColorTexture", [](auto& m) { return m.sheen.color_texture; }},
        {ext + "sheen/sheenRoughnessTexture", [](auto& m) { return m.sheen.roughness_texture; }},
        {ext + "transmission/transmissionTexture", [](auto& m) { return m.transmission.texture; }},
        {ext + "volume/thicknessTexture", [](auto& m) { return m.volume.thickness_texture; }},
    };
    for (const auto& [texture, slot] : slots) {
        CAPTURE(texture);
        const auto transform = [&, &slot = slot, &texture = texture](const std::string& property,
                                                                     const std::vector<float>& values,
                                                                     std::string_view element) {
            const auto pointer = "/materials/0/" + texture + "/extensions/KHR_texture_transform/" + property;
            auto file = pointing(pointer, values, element);
            file.json["images"] = json::array({{{"uri", "data:image/png;base64,AAAA"}}});
            file.json["textures"] = json::array({{{"source", 0}}});
            file.json["materials"][0][json::json_pointer("/" + texture + "/index")] = 0;
            return slot(posed(file, 1.0).materials[0])->transform;
        };
        CHECK(transform("offset", {0, 0, 1, 3}, "VEC2").offset == glm::vec2(0.5f, 1.5f));
        CHECK(transform("rotation", {0, 3}, "SCALAR").rotation_rad == 1.5f);
        CHECK(transform("scale", {1, 1, 2, 4}, "VEC2").scale == glm::vec2(1.5f, 2.5f));
    }
}

TEST_CASE("values that leave their range come back to it", "[load][pointer]") {
    CHECK(posed(pointing("/cameras/0/perspective/yfov", {9, 9}, "SCALAR"), 1.0).cameras[0].fov_y_rad <
          3.1416);
    CHECK(posed(pointing("/cameras/0/perspective/znear", {-9, -9}, "SCALAR"), 1.0).cameras[0].near_m > 0.0);
    CHECK(posed(pointing("/cameras/1/orthographic/ymag", {-1, 1}, "SCALAR"), 1.0).cameras[1].y_mag > 0.0);
    CHECK(posed(pointing("/extensions/KHR_lights_punctual/lights/0/intensity", {-1, -1}, "SCALAR"), 1.0)
              .lights[0]
              .intensity == 0.0f);
    CHECK(posed(pointing("/materials/0/pbrMetallicRoughness/metallicFactor", {7, 7}, "SCALAR"), 1.0)
              .materials[0]
              .metallic == 1.0f);
}

TEST_CASE("key values by pointer may be integers", "[load][pointer]") {
    auto file = pointing("/extensions/KHR_lights_punctual/lights/0/intensity", {0, 0}, "SCALAR");
    const auto output = file.add_accessor<std::uint16_t>({0, 40}, test::uint16, "SCALAR", 2);
    file.json["animations"][0]["samplers"][0]["output"] = output;
    CHECK(posed(file, 1.0).lights[0].intensity == 20.0f);
}

TEST_CASE("pointers to what is not supported are named in a warning and play nothing", "[load][pointer]") {
    for (const std::string pointer : {"/materials/0/extensions/KHR_materials_iridescence/iridescenceIor",
                                      "/meshes/0/extras", "/nodes/0/extras/glow", "/scenes/0/name",
                                      "/cameras/0/perspective/aspectRatio", "/cameras/1/orthographic/xmag"}) {
        CAPTURE(pointer);
        const auto scene = pointing(pointer, {0, 1}, "SCALAR").load();
        CHECK(scene.animations[0].channels.empty());
        CHECK_THAT(test::warning_at(scene, "/animations/0"), Contains(pointer));
    }
}

TEST_CASE("pointers to another kind of camera or light play nothing", "[load][pointer]") {
    for (const std::string pointer : {"/cameras/1/perspective/znear", "/cameras/0/orthographic/zfar"}) {
        CAPTURE(pointer);
        const auto scene = pointing(pointer, {50, 50}, "SCALAR").load();
        CHECK(scene.animations[0].channels.empty());
        CHECK_THAT(test::warning_at(scene, "/animations/0"), Contains(pointer));
    }
    auto file = pointing("/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle", {1, 1}, "SCALAR");
    file.json["extensions"]["KHR_lights_punctual"]["lights"][0] = {{"type", "point"}};
    CHECK(file.load().animations[0].channels.empty());
}

TEST_CASE("an empty list of weights is none of the node's own", "[load][pointer]") {
    auto file = pointing("/meshes/0/weights", {0, 0, 1, 3}, "SCALAR");
    file.json["nodes"][0]["weights"] = json::array();
    CHECK(posed(file, 1.0).weights[0] == std::vector<float>{0.5f, 1.5f});
}

TEST_CASE("channels of a mesh's weights for very many nodes are refused before memory is",
          "[load][pointer]") {
    auto file = pointing("/meshes/0/weights", {0, 0, 1, 3}, "SCALAR");
    const json channel = file.json["animations"][0]["channels"][0];
    for (int i = 0; i < 6000; ++i) {
        file.json["nodes"].push_back({{"mesh", 0}});
        file.json["animations"][0]["channels"].push_back(channel);
    }
    CHECK_THAT(test::refusal_of(file).message, Contains("more memory than a file of this size"));
}

TEST_CASE("a spline that swings past what a float holds stays a number", "[load][pointer]") {
    auto file = pointing("/materials/0/emissiveFactor", std::vector<float>(18, 3e38f), "VEC3");
    file.json["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE";
    CHECK(posed(file, 0.5).materials[0].emissive.x == std::numeric_limits<float>::max());
}

TEST_CASE("pointers that lead nowhere are refused", "[load][pointer]") {
    const std::map<std::string, std::string> bad{
        {"/nodes/7/translation", "has 1 of these"},
        {"/nodes/x/translation", "does not name a property"},
        {"/nodes/0", "does not name a property"},
        {"/nodes/-1/scale", "does not name a property"},
        {"/nodes/99999999999999999999/scale", "does not name a property"},
        {"/materials/1/alphaCutoff", "has 1 of these"},
        {"/cameras/2/perspective/yfov", "has 2 of these"},
        {"/extensions/KHR_lights_punctual/lights/1/intensity", "has 1 of these"},
        {"/nodes/0/weights/2", "not one of the 2 morph weights"},
        {"/meshes/0/weights/2", "not one of the 2 morph weights"},
        {"/meshes/1/weights", "has 1 of these"},
        {"nodes/0/translation", "is not a JSON pointer"},
        {"", "is not a JSON pointer"},
    };
    for (const auto& [pointer, message] : bad) {
        CAPTURE(pointer);
        const auto refusal = test::refusal_of(pointing(pointer, {0, 1}, "SCALAR"));
        CHECK_THAT(refusal.pointer, Contains("/animations/0/channels/0/target"));
        CHECK_THAT(refusal.message, Contains(message));
    }
}

TEST_CASE("key values by pointer must fit what they drive", "[load][pointer]") {
    CHECK_THAT(test::refusal_of(pointing("/nodes/0/translation", {0, 1}, "SCALAR")).message,
               Contains("this path needs VEC3"));
    CHECK_THAT(test::refusal_of(pointing("/nodes/0/weights", {0, 1}, "SCALAR")).message,
               Contains("2 keys need 4"));
    auto matrix = pointing("/nodes/0/translation", {0, 0, 0, 1, 1, 1}, "VEC3");
    matrix.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    CHECK_THAT(test::refusal_of(matrix).message, Contains("has a matrix"));
}

TEST_CASE("of a property that one animation points at twice the last channel counts", "[load][pointer]") {
    auto file = pointing("/nodes/0/translation", {0, 0, 0, 0, 0, 0}, "VEC3");
    const auto output = file.add_vec3s({1, 1, 1, 1, 1, 1});
    auto& animation = file.json["animations"][0];
    animation["samplers"].push_back({{"input", animation["samplers"][0]["input"]}, {"output", output}});
    animation["channels"].push_back({{"sampler", 1}, {"target", {{"node", 0}, {"path", "translation"}}}});

    CHECK(posed(file, 1.0).world[0][3] == glm::dvec4(1, 1, 1, 1));
    CHECK_THAT(test::warning_at(file.load(), "/animations/0"), Contains("/nodes/0/translation"));
}

TEST_CASE("a list of weights and one of them are the same property", "[load][pointer]") {
    for (const bool list_first : {true, false}) {
        auto file = pointing("/nodes/0/weights", {0, 0, 1, 3}, "SCALAR");
        json& animation = file.json["animations"][0];
        const auto input = file.add_scalars({0}), output = file.add_scalars({5});
        animation["samplers"].push_back({{"input", input}, {"output", output}});
        json& channels = animation["channels"];
        channels.insert(list_first ? channels.end() : channels.begin(), channel_to("/nodes/0/weights/1", 1));
        const std::string last = list_first ? "/nodes/0/weights/1" : "/nodes/0/weights";
        CHECK_THAT(test::warning_at(file.load(), "/animations/0"),
                   Contains("animated more than once") && Catch::Matchers::EndsWith(": " + last));
    }
}

TEST_CASE("a sampler that colours and turns is checked for turning", "[load][pointer]") {
    auto file =
        pointing("/materials/0/pbrMetallicRoughness/baseColorFactor", {0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    CHECK(posed(file, 1.0).materials[0].base_color == glm::vec4(0.0f));
    file.json["animations"][0]["channels"].push_back(channel_to("/nodes/0/rotation", 0));
    CHECK_THAT(test::refusal_of(file).message, Contains("quaternion of length zero"));
}

TEST_CASE("animations that point at different values play together", "[load][pointer]") {
    auto file = pointing("/nodes/0/weights/0", {0, 1}, "SCALAR");
    auto other = file.json["animations"][0];
    other["channels"][0] = channel_to("/cameras/0/perspective/yfov", 0);
    file.json["animations"].push_back(other);
    CHECK(anim::choose_clip(file.load()).animations == std::vector<anim::Index>{0, 1});

    // Two weights of one node count as the same property: mostly they are parts of one expression.
    file.json["animations"][1]["channels"][0] = channel_to("/nodes/0/weights/1", 0);
    CHECK(anim::choose_clip(file.load()).animations == std::vector<anim::Index>{0});
}
