#include "defect.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace gridreel;
using nlohmann::json;

namespace {

json& primitive(test::GltfBuilder& file) {
    return file.json["meshes"][0]["primitives"][0];
}

constexpr float infinity = std::numeric_limits<float>::infinity();

}  // namespace

TEST_CASE("attributes, indices and targets that do not fit are refused", "[validate]") {
    const test::Defect defects[] = {
        {"attributes of different counts", "/meshes/0/primitives/0/attributes/POSITION",
         "POSITION has 3 elements; the primitive has 4 vertices",
         [](auto& f) { primitive(f)["attributes"]["NORMAL"] = f.add_vec3s(std::vector<float>(12, 1.0f)); }},
        {"positions of two components", "/meshes/0/primitives/0/attributes/POSITION", "it must be VEC3",
         [](auto& f) {
             primitive(f)["attributes"]["POSITION"] =
                 f.add_accessor(std::vector<float>(6, 0.0f), test::float32, "VEC2", 3);
         }},
        {"quantized positions without the extension", "/meshes/0/primitives/0/attributes/POSITION",
         "needs KHR_mesh_quantization",
         [](auto& f) {
             primitive(f)["attributes"]["POSITION"] =
                 f.add_accessor(std::vector<std::int8_t>(9, 0), test::int8, "VEC3", 3);
         }},
        {"joints that are floats", "/meshes/0/primitives/0/attributes/JOINTS_0",
         "cannot be stored as VEC4 of FLOAT",
         [](auto& f) {
             primitive(f)["attributes"]["JOINTS_0"] = f.add_vec4s(std::vector<float>(12, 0.0f));
             primitive(f)["attributes"]["WEIGHTS_0"] = f.add_vec4s(std::vector<float>(12, 0.0f));
         }},
        {"weights that are plain integers", "/meshes/0/primitives/0/attributes/WEIGHTS_0", "cannot be stored",
         [](auto& f) {
             const auto bytes = f.add_accessor(std::vector<std::uint8_t>(12, 0), test::uint8, "VEC4", 3);
             primitive(f)["attributes"]["JOINTS_0"] = bytes;
             primitive(f)["attributes"]["WEIGHTS_0"] = bytes;
         }},
        {"joints without weights", "/meshes/0/primitives/0/attributes", "WEIGHTS_0 is missing",
         [](auto& f) {
             primitive(f)["attributes"]["JOINTS_0"] =
                 f.add_accessor(std::vector<std::uint8_t>(12, 0), test::uint8, "VEC4", 3);
         }},
        {"a gap between influence sets", "/meshes/0/primitives/0/attributes", "JOINTS_0 is missing",
         [](auto& f) {
             primitive(f)["attributes"]["JOINTS_1"] =
                 f.add_accessor(std::vector<std::uint8_t>(12, 0), test::uint8, "VEC4", 3);
             primitive(f)["attributes"]["WEIGHTS_1"] = f.add_vec4s(std::vector<float>(12, 0.0f));
         }},
        {"negative weights", "/meshes/0/primitives/0/attributes/WEIGHTS_0", "vertex 0 has the weight -1",
         [](auto& f) {
             primitive(f)["attributes"]["JOINTS_0"] =
                 f.add_accessor(std::vector<std::uint8_t>(12, 0), test::uint8, "VEC4", 3);
             primitive(f)["attributes"]["WEIGHTS_0"] = f.add_vec4s({-1, 1, 1, 0, 1, 0, 0, 0, 1, 0, 0, 0});
         }},
        {"positions that are not finite", "/meshes/0/primitives/0/attributes/POSITION", "component 4 is inf",
         [](auto& f) {
             primitive(f)["attributes"]["POSITION"] = f.add_vec3s({0, 0, 0, 0, infinity, 0, 0, 0, 0});
         }},
        {"indices that are floats", "/meshes/0/primitives/0/indices", "SCALAR of unsigned integers",
         [](auto& f) {
             primitive(f)["indices"] = f.add_scalars({0, 1, 2});
         }},
        {"an index beyond the vertices", "/meshes/0/primitives/0/indices",
         "index 1 is 3, but the primitive has 3",
         [](auto& f) {
             primitive(f)["indices"] =
                 f.template add_accessor<std::uint32_t>({0, 3, 2}, test::uint32, "SCALAR", 3);
         }},
        {"the restart value", "/meshes/0/primitives/0/indices", "restart value",
         [](auto& f) {
             primitive(f)["indices"] =
                 f.template add_accessor<std::uint8_t>({0, 255, 2}, test::uint8, "SCALAR", 3);
         }},
        {"a target of another count", "/meshes/0/primitives/0/targets/0/POSITION",
         "POSITION has 1 elements; the primitive has 3 vertices",
         [](auto& f) {
             primitive(f)["targets"] = {{{"POSITION", f.add_vec3s({0, 0, 0})}}};
         }},
        {"a target of four components", "/meshes/0/primitives/0/targets/0/TANGENT", "it must be VEC3",
         [](auto& f) {
             primitive(f)["targets"] = {{{"TANGENT", f.add_vec4s(std::vector<float>(12, 0.0f))}}};
         }},
        {"primitives with different numbers of targets", "/meshes/0/primitives/1",
         "has 1 morph targets, the mesh's first has 0",
         [](auto& f) {
             f.json["meshes"][0]["primitives"].push_back(primitive(f));
             f.json["meshes"][0]["primitives"][1]["targets"] = {{{"POSITION", 0}}};
         }},
        {"weights that do not match the targets", "/meshes/0/weights", "1 morph weights for 0 targets",
         [](auto& f) { f.json["meshes"][0]["weights"] = {1}; }},
    };
    test::check_refusals(defects);
}

TEST_CASE("the largest 16-bit index but one is an index", "[validate]") {
    auto file = test::one_triangle();
    const std::vector<float> many(3 * 65535, 0.0f);
    primitive(file)["attributes"]["POSITION"] = file.add_vec3s(many);
    primitive(file)["indices"] = file.add_accessor<std::uint16_t>({0, 1, 65534}, test::uint16, "SCALAR", 3);
    CHECK(file.load().meshes[0].primitives[0].triangles == std::vector<glm::uvec3>{{0, 1, 65534}});
}

TEST_CASE("attributes of an application's own are let be", "[validate]") {
    auto file = test::one_triangle();
    primitive(file)["attributes"]["_PRESSURE"] = file.add_scalars({1, 2, 3});
    primitive(file)["attributes"]["TEXCOORD_2"] =
        file.add_accessor(std::vector<float>(6, 0.0f), test::float32, "VEC2", 3);
    CHECK(test::refusal_of(file).message.empty());
}
