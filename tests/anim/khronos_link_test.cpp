// The validator's LINK codes, in the order of its ISSUES.md. Of these only UNUSED_OBJECT and
// MESH_PRIMITIVE_UNUSED_TEXCOORD, which are no defects, are left out.

#include "khronos_code.h"

using namespace gridreel;
using nlohmann::json;
using test::attributes;
using test::channel_target;
using test::key_sampler;
using enum test::Verdict;
using File = test::GltfBuilder;

namespace {

json& primitive(File& file) {
    return file.json["meshes"][0]["primitives"][0];
}

}  // namespace

TEST_CASE("buffers and accessors that do not fit together meet the verdict of the table",
          "[validate][khronos]") {
    const test::KhronosCode codes[] = {
        {"ACCESSOR_SMALL_BYTESTRIDE", refused, "/accessors/0", "overlap",
         [](File& f) { f.json["bufferViews"][0]["byteStride"] = 8; }},
        {"ACCESSOR_TOO_LONG", refused, "/accessors/0", "the buffer view has 36",
         [](File& f) { f.json["accessors"][0]["count"] = 4; }},
        {"ACCESSOR_TOTAL_OFFSET_ALIGNMENT", tolerated, "", "read byte by byte, wherever they stand",
         [](File& f) {
             f.buffer.insert(f.buffer.begin(), std::byte{0});
             for (json& view : f.json["bufferViews"])
                 view["byteOffset"] = view["byteOffset"].get<std::size_t>() + 1;
         }},
        {"ACCESSOR_USAGE_OVERRIDE", tolerated, "", "numbers are read anew for each use",
         [](File& f) {
             key_sampler(f) = {{"input", f.add_scalars({0, 1, 2})}, {"output", 0}};
         }},
        {"BUFFER_MISSING_GLB_DATA", refused, "/bufferViews/0", "has no bytes",
         [](File& f) {
             f.json["buffers"] = {{{"byteLength", f.buffer.size()}}};
         }},
        {"BUFFER_NON_FIRST_GLB", refused, "/bufferViews/0", "buffer 1 has no bytes",
         [](File& f) {
             f.json["buffers"] = {{{"byteLength", f.buffer.size()},
                                   {"uri", "data:application/gltf-buffer;base64," + test::base64(f.buffer)}},
                                  {{"byteLength", 36}}};
             f.json["bufferViews"][0]["buffer"] = 1;
         }},
        {"BUFFER_VIEW_TARGET_OVERRIDE", tolerated, "", "targets are hints for uploading",
         [](File& f) { f.json["bufferViews"][0]["target"] = 34963; }},
        {"BUFFER_VIEW_TOO_LONG", refused, "/bufferViews/0", "beyond buffer 0",
         [](File& f) { f.json["bufferViews"][0]["byteLength"] = 99999; }},
        {"UNRESOLVED_REFERENCE", refused, "/nodes/0/mesh", "index 9 is out of range",
         [](File& f) { f.json["nodes"][0]["mesh"] = 9; }},
        {"UNDECLARED_EXTENSION", tolerated, "", "an extension that is there is meant",
         [](File& f) { f.json["materials"][0]["extensions"]["KHR_materials_unlit"] = json::object(); }},
        {"UNEXPECTED_EXTENSION_OBJECT", tolerated, "", "an extension counts only where it belongs",
         [](File& f) { f.json["nodes"][0]["extensions"]["KHR_materials_unlit"] = json::object(); }},
        {"UNSUPPORTED_EXTENSION", warned, "/extensionsUsed/0", "is not known",
         [](File& f) { f.json["extensionsUsed"] = {"KHR_audio"}; }},
        {"UNSUPPORTED_EXTENSION: required", refused, "/extensionsRequired", "requires KHR_audio",
         [](File& f) { f.json["extensionsRequired"] = f.json["extensionsUsed"] = {"KHR_audio"}; }},
    };
    test::check_codes(codes);
}

TEST_CASE("animations that do not fit what they drive meet the verdict of the table", "[validate][khronos]") {
    const test::KhronosCode codes[] = {
        {"ANIMATION_CHANNEL_TARGET_NODE_MATRIX", refused, "/animations/0/channels/0/target", "has a matrix",
         [](File& f) { f.json["nodes"][1]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }},
        {"ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS", refused, "/animations/0/channels/0/target",
         "no mesh with morph targets", [](File& f) { channel_target(f)["path"] = "weights"; }},
        {"ANIMATION_DUPLICATE_TARGETS", refused, "/animations/0/channels/1/target", "animated twice",
         [](File& f) {
             auto& channels = f.json["animations"][0]["channels"];
             channels.push_back(json(channels[0]));
         }},
        {"ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT", refused, "/animations/0/samplers/0/input",
         "SCALAR of FLOAT", [](File& f) { key_sampler(f)["input"] = 0; }},
        {"ANIMATION_SAMPLER_INPUT_ACCESSOR_TOO_FEW_ELEMENTS", refused, "/animations/0/samplers/0/input",
         "at least two keys",
         [](File& f) {
             key_sampler(f) = {{"input", f.add_scalars({0})},
                               {"output", f.add_vec3s(std::vector<float>(9, 0.0f))},
                               {"interpolation", "CUBICSPLINE"}};
         }},
        {"ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS", tolerated, "", "bounds are found from the values",
         [](File& f) { f.json["accessors"][key_sampler(f)["input"].get<std::size_t>()].erase("max"); }},
        {"ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT", refused, "/animations/0/samplers/0/output",
         "3 key values; 2 keys need 2", [](File& f) { key_sampler(f)["output"] = 0; }},
        {"ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT", refused, "/animations/0/samplers/0/output",
         "this path needs VEC3",
         [](File& f) {
             key_sampler(f)["output"] = f.add_scalars({0, 1});
         }},
        {"ANIMATION_SAMPLER_OUTPUT_INTERPOLATION", tolerated, "",
         "each sampler reads the numbers its own way",
         [](File& f) {
             const auto values = f.add_vec3s(std::vector<float>(18, 0.0f));
             key_sampler(f)["output"] = values;
             key_sampler(f)["interpolation"] = "CUBICSPLINE";
             f.json["animations"][0]["samplers"].push_back(
                 {{"input", f.add_scalars({0, 1, 2, 3, 4, 5})}, {"output", values}});
         }},
    };
    test::check_codes(codes);
}

TEST_CASE("meshes, nodes and skins that do not fit together meet the verdict of the table",
          "[validate][khronos]") {
    const test::KhronosCode codes[] = {
        {"MESH_PRIMITIVE_ACCESSOR_UNALIGNED", tolerated, "", "read byte by byte, wherever they stand",
         [](File& f) {
             attributes(f)["NORMAL"] =
                 f.add_accessor(std::vector<std::uint8_t>(37, 0), test::float32, "VEC3", 3);
             f.json["accessors"].back()["byteOffset"] = 1;
         }},
        {"MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE", tolerated, "", "without a stride elements are packed",
         [](File& f) {
             f.json["accessors"].push_back(f.json["accessors"][0]);
             attributes(f)["NORMAL"] = f.json["accessors"].size() - 1;
         }},
        {"MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT", refused,
         "/meshes/0/primitives/0/attributes/NORMAL", "it must be VEC3",
         [](File& f) { attributes(f)["NORMAL"] = attributes(f)["WEIGHTS_0"]; }},
        {"MESH_PRIMITIVE_INCOMPATIBLE_MODE", warned, "/meshes/0/primitives/0",
         "4 indices do not make whole triangles",
         [](File& f) {
             primitive(f)["indices"] =
                 f.add_accessor(std::vector<std::uint8_t>{0, 1, 2, 0}, test::uint8, "SCALAR", 4);
         }},
        {"MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT", refused, "/meshes/0/primitives/0/indices",
         "SCALAR of unsigned integers",
         [](File& f) {
             primitive(f)["indices"] = f.add_scalars({0, 1, 2});
         }},
        {"MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE", tolerated, "",
         "the stride is honoured wherever there is one",
         [](File& f) {
             primitive(f)["indices"] =
                 f.add_accessor(std::vector<std::uint16_t>{0, 9, 1, 9, 2, 9}, test::uint16, "SCALAR", 3);
             f.json["bufferViews"].back()["byteStride"] = 4;
         }},
        {"MESH_PRIMITIVE_MORPH_TARGET_INVALID_ATTRIBUTE_COUNT", refused,
         "/meshes/0/primitives/0/targets/0/POSITION", "the primitive has 3 vertices",
         [](File& f) {
             primitive(f)["targets"][0]["POSITION"] = f.add_vec3s({0, 0, 0});
         }},
        {"MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR", tolerated, "",
         "a displacement of nothing displaces nothing",
         [](File& f) { primitive(f)["targets"][0]["TANGENT"] = 0; }},
        {"MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS", tolerated, "", "bounds are found from the values",
         [](File& f) { f.json["accessors"][0].erase("max"); }},
        {"MESH_PRIMITIVE_TOO_FEW_TEXCOORDS", warned, "/meshes/0", "without the texture coordinates",
         [](File& f) { attributes(f).erase("TEXCOORD_0"); }},
        {"MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", refused, "/meshes/0/primitives/0/attributes/NORMAL",
         "NORMAL has 4 elements",
         [](File& f) { attributes(f)["NORMAL"] = f.add_vec3s(std::vector<float>(12, 1.0f)); }},
        {"NODE_LOOP", refused, "/nodes/1", "its own ancestor",
         [](File& f) {
             f.json["nodes"][2]["children"] = json::array({1});
             f.json["scenes"][0]["nodes"] = {0, 3};
         }},
        {"NODE_PARENT_OVERRIDE", refused, "/nodes/3/children/0", "already a child of node 1",
         [](File& f) { f.json["nodes"][3]["children"] = {2}; }},
        {"NODE_SKINNED_MESH_WITHOUT_SKIN", tolerated, "", "joints without a skin do nothing",
         [](File& f) { f.json["nodes"][0].erase("skin"); }},
        {"NODE_SKIN_WITH_NON_SKINNED_MESH", refused, "/nodes/0/skin", "has no JOINTS_0",
         [](File& f) {
             attributes(f).erase("JOINTS_0");
             attributes(f).erase("WEIGHTS_0");
         }},
        {"NODE_SKINNED_MESH_NON_ROOT", tolerated, "", "joints alone place the mesh, as section 3.7.3.3 asks",
         [](File& f) {
             f.json["nodes"][3]["children"] = {0};
             f.json["scenes"][0]["nodes"] = {1, 3};
         }},
        {"NODE_SKINNED_MESH_LOCAL_TRANSFORMS", tolerated, "",
         "joints alone place the mesh, as section 3.7.3.3 asks",
         [](File& f) {
             f.json["nodes"][0]["translation"] = {1, 2, 3};
         }},
        {"NODE_WEIGHTS_INVALID", refused, "/nodes/0/weights", "2 morph weights; mesh 0 has 1 targets",
         [](File& f) {
             f.json["nodes"][0]["weights"] = {0, 1};
         }},
        {"SCENE_NON_ROOT_NODE", refused, "/scenes/0/nodes/0", "not a root",
         [](File& f) { f.json["scenes"][0]["nodes"] = {2}; }},
        {"INVALID_IBM_ACCESSOR_COUNT", refused, "/skins/0/inverseBindMatrices",
         "1 inverse bind matrices for 2 joints",
         [](File& f) {
             f.json["accessors"][f.json["skins"][0]["inverseBindMatrices"].get<std::size_t>()]["count"] = 1;
         }},
        {"SKIN_IBM_INVALID_FORMAT", refused, "/skins/0/inverseBindMatrices", "must be MAT4 of FLOAT",
         [](File& f) { f.json["skins"][0]["inverseBindMatrices"] = attributes(f)["WEIGHTS_0"]; }},
        {"SKIN_NO_COMMON_ROOT", tolerated, "", "joints are placed one by one, wherever they stand",
         [](File& f) {
             f.json["nodes"][1].erase("children");
             f.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
         }},
        {"SKIN_SKELETON_INVALID", tolerated, "", "the skeleton is a hint that nothing is read from",
         [](File& f) { f.json["skins"][0]["skeleton"] = 3; }},
    };
    test::check_codes(codes);
}
