// The validator's IO_ERROR, SCHEMA and SEMANTIC codes, in the order of its ISSUES.md. Of these only
// MULTIPLE_EXTENSIONS, NODE_EMPTY and NODE_MATRIX_DEFAULT, which are no defects, are left out.

#include "khronos_code.h"

using namespace gridreel;
using nlohmann::json;
using test::attributes;
using enum test::Verdict;
using File = test::GltfBuilder;

TEST_CASE("files that break the schema meet the verdict of the table", "[validate][khronos]") {
    const test::KhronosCode codes[] = {
        {"FILE_NOT_FOUND: a buffer", refused, "/buffers/0/uri", "cannot be read",
         [](File& f) {
             f.json["buffers"] = {{{"byteLength", f.buffer.size()}, {"uri", "no.bin"}}};
         }},
        {"FILE_NOT_FOUND: an image", warned, "/images/0", "\"no.png\" cannot be read",
         [](File& f) { f.json["images"][0]["uri"] = "no.png"; }},
        {"ARRAY_LENGTH_NOT_IN_LIST", refused, "/nodes/1/translation", "exactly 3",
         [](File& f) {
             f.json["nodes"][1]["translation"] = {0, 1};
         }},
        {"ARRAY_TYPE_MISMATCH", refused, "/nodes/1/translation/1", "must be a number",
         [](File& f) {
             f.json["nodes"][1]["translation"] = {0, "1", 2};
         }},
        {"DUPLICATE_ELEMENTS: nodes of a scene", refused, "/scenes/0/nodes/1", "listed twice",
         [](File& f) {
             f.json["scenes"][0]["nodes"] = {0, 0};
         }},
        {"DUPLICATE_ELEMENTS: children", refused, "/nodes/1/children/1", "already a child",
         [](File& f) {
             f.json["nodes"][1]["children"] = {2, 2};
         }},
        {"DUPLICATE_ELEMENTS: joints", tolerated, "", "each has its own inverse bind matrix",
         [](File& f) {
             f.json["skins"][0]["joints"] = {1, 1};
         }},
        {"DUPLICATE_ELEMENTS: extensionsUsed", tolerated, "", "said twice is said",
         [](File& f) {
             f.json["extensionsUsed"] = {"KHR_materials_unlit", "KHR_materials_unlit"};
         }},
        {"EMPTY_ENTITY: children", tolerated, "", "nothing is nothing",
         [](File& f) { f.json["nodes"][2]["children"] = json::array(); }},
        {"EMPTY_ENTITY: primitives", refused, "/meshes/0/primitives", "at least 1",
         [](File& f) { f.json["meshes"][0]["primitives"] = json::array(); }},
        {"EMPTY_ENTITY: attributes", warned, "/meshes/1/primitives/0", "no positions",
         [](File& f) {
             f.json["meshes"].push_back({{"primitives", {{{"attributes", json::object()}}}}});
         }},
        {"INVALID_INDEX", refused, "/nodes/0/mesh", "not an integer",
         [](File& f) { f.json["nodes"][0]["mesh"] = -1; }},
        {"INVALID_URI: percent sign", refused, "/buffers/0/uri", "no two hexadecimal digits",
         [](File& f) {
             f.json["buffers"] = {{{"byteLength", f.buffer.size()}, {"uri", "a%.bin"}}};
         }},
        {"INVALID_URI: base64", refused, "/buffers/0/uri", "not valid base64",
         [](File& f) {
             f.json["buffers"] = {
                 {{"byteLength", f.buffer.size()}, {"uri", "data:application/gltf-buffer;base64,&&&"}}};
         }},
        {"ONE_OF_MISMATCH: neither source of an image", warned, "/images/0", "no bytes",
         [](File& f) { f.json["images"][0].erase("uri"); }},
        {"ONE_OF_MISMATCH: both sources of an image", tolerated, "", "the URI is as good as the view",
         [](File& f) { f.json["images"][0]["bufferView"] = 0; }},
        {"ONE_OF_MISMATCH: no lens of a camera", refused, "/cameras/0", "\"perspective\" is missing",
         [](File& f) { f.json["cameras"][0].erase("perspective"); }},
        {"PATTERN_MISMATCH", refused, "/asset/version", "not a version",
         [](File& f) { f.json["asset"]["version"] = "two"; }},
        {"TYPE_MISMATCH", refused, "/nodes/0/name", "must be a string",
         [](File& f) { f.json["nodes"][0]["name"] = 7; }},
        {"UNDEFINED_PROPERTY", refused, "/accessors/0", "\"count\" is missing",
         [](File& f) { f.json["accessors"][0].erase("count"); }},
        {"UNEXPECTED_PROPERTY", tolerated, "", "a later minor version may add properties",
         [](File& f) { f.json["nodes"][0]["mood"] = "good"; }},
        {"UNSATISFIED_DEPENDENCY: type of an image", tolerated, "", "its bytes tell the type",
         [](File& f) {
             f.json["images"][0] = {{"bufferView", f.add_view(std::vector<std::uint8_t>{0x89, 'P'})}};
         }},
        {"UNSATISFIED_DEPENDENCY: offset into no view", tolerated, "", "zeros need no offset",
         [](File& f) {
             f.json["accessors"].push_back(
                 {{"byteOffset", 4}, {"componentType", 5126}, {"type", "VEC3"}, {"count", 3}});
             attributes(f)["NORMAL"] = f.json["accessors"].size() - 1;
         }},
        {"VALUE_MULTIPLE_OF", tolerated, "", "read byte by byte, wherever they stand",
         [](File& f) {
             attributes(f)["NORMAL"] =
                 f.add_accessor(std::vector<std::uint8_t>(42, 0), test::float32, "VEC3", 3);
             f.json["bufferViews"].back()["byteStride"] = 14;
         }},
        {"VALUE_NOT_IN_LIST", refused, "/accessors/0/type", "\"VEC5\" is not a \"type\"",
         [](File& f) { f.json["accessors"][0]["type"] = "VEC5"; }},
        {"VALUE_NOT_IN_RANGE", refused, "/cameras/0/perspective/yfov", "above 0",
         [](File& f) { f.json["cameras"][0]["perspective"]["yfov"] = 0; }},
    };
    test::check_codes(codes);
}

TEST_CASE("files that make no sense in themselves meet the verdict of the table", "[validate][khronos]") {
    const test::KhronosCode codes[] = {
        {"ACCESSOR_MATRIX_ALIGNMENT", tolerated, "", "only MAT4 of FLOAT is used, which has no padding",
         [](File& f) { f.add_accessor(std::vector<std::uint8_t>(8, 0), test::uint8, "MAT2", 1); }},
        {"ACCESSOR_NORMALIZED_INVALID", refused, "/accessors/0/normalized", "cannot be normalized",
         [](File& f) { f.json["accessors"][0]["normalized"] = true; }},
        {"ACCESSOR_OFFSET_ALIGNMENT", tolerated, "", "read byte by byte, wherever they stand",
         [](File& f) {
             attributes(f)["NORMAL"] =
                 f.add_accessor(std::vector<std::uint8_t>(38, 0), test::float32, "VEC3", 3);
             f.json["accessors"].back()["byteOffset"] = 2;
         }},
        {"ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE", refused, "/accessors/0/sparse", "4 sparse elements",
         [](File& f) {
             f.json["accessors"][0]["sparse"] = {{"count", 4},
                                                 {"indices", {{"bufferView", 0}, {"componentType", 5121}}},
                                                 {"values", {{"bufferView", 0}}}};
         }},
        {"ASSET_MIN_VERSION_GREATER_THAN_VERSION", refused, "/asset/minVersion", "needs a reader of glTF 2.1",
         [](File& f) { f.json["asset"]["minVersion"] = "2.1"; }},
        {"BUFFER_DATA_URI_MIME_TYPE_INVALID", tolerated, "", "bytes are bytes",
         [](File& f) {
             f.json["buffers"] = {{{"byteLength", f.buffer.size()},
                                   {"uri", "data:text/plain;base64," + test::base64(f.buffer)}}};
         }},
        {"BUFFER_VIEW_INVALID_BYTE_STRIDE", tolerated, "", "the stride is honoured wherever there is one",
         [](File& f) {
             const auto indices =
                 f.add_accessor(std::vector<std::uint16_t>{0, 9, 1, 9, 2}, test::uint16, "SCALAR", 3);
             f.json["bufferViews"].back()["byteStride"] = 4;
             f.json["meshes"][0]["primitives"][0]["indices"] = indices;
         }},
        {"BUFFER_VIEW_TOO_BIG_BYTE_STRIDE", refused, "/accessors/0", "need 140 bytes",
         [](File& f) { f.json["bufferViews"][0]["byteStride"] = 64; }},
        {"CAMERA_XMAG_YMAG_ZERO", refused, "/cameras/0/orthographic/ymag", "sees nothing",
         [](File& f) {
             f.json["cameras"][0] = {{"type", "orthographic"},
                                     {"orthographic", {{"znear", 1}, {"zfar", 2}, {"xmag", 1}, {"ymag", 0}}}};
         }},
        {"CAMERA_ZFAR_LEQUAL_ZNEAR", refused, "/cameras/0/perspective/zfar", "not beyond the near plane",
         [](File& f) { f.json["cameras"][0]["perspective"]["zfar"] = 1; }},
        {"INTEGER_WRITTEN_AS_FLOAT", tolerated, "", "3.0 is 3",
         [](File& f) { f.json["accessors"][0]["count"] = 3.0; }},
        {"INVALID_GL_VALUE", refused, "/samplers/0/wrapS", "is not a \"wrapS\"",
         [](File& f) { f.json["samplers"][0]["wrapS"] = 1; }},
        {"MATERIAL_ALPHA_CUTOFF_INVALID_MODE", tolerated, "", "the cutoff counts for MASK alone",
         [](File& f) { f.json["materials"][0]["alphaCutoff"] = 0.25; }},
        {"MESH_INVALID_WEIGHTS_COUNT", refused, "/meshes/0/weights", "2 morph weights for 1 targets",
         [](File& f) {
             f.json["meshes"][0]["weights"] = {1, 1};
         }},
        {"MESH_PRIMITIVES_UNEQUAL_JOINTS_COUNT", refused, "/nodes/0/skin",
         "primitive 1 of mesh 0 has no JOINTS_0",
         [](File& f) {
             auto& primitives = f.json["meshes"][0]["primitives"];
             primitives.push_back(primitives[0]);
             primitives[1]["attributes"] = {{"POSITION", 0}};
         }},
        {"MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT", refused, "/meshes/0/primitives/1", "has 0 morph targets",
         [](File& f) {
             auto& primitives = f.json["meshes"][0]["primitives"];
             primitives.push_back(primitives[0]);
             primitives[1].erase("targets");
         }},
        {"MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY: JOINTS", refused, "/meshes/0/primitives/0/attributes",
         "JOINTS_1 is missing", [](File& f) { attributes(f)["JOINTS_2"] = attributes(f)["JOINTS_0"]; }},
        {"MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY: TEXCOORD", tolerated, "", "sets are used by number",
         [](File& f) {
             attributes(f)["TEXCOORD_1"] = attributes(f)["TEXCOORD_0"];
             attributes(f).erase("TEXCOORD_0");
             f.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1;
         }},
        {"MESH_PRIMITIVE_INVALID_ATTRIBUTE", tolerated, "", "what is not known is not read",
         [](File& f) { attributes(f)["MOOD"] = 0; }},
        {"MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH", refused, "/meshes/0/primitives/0/attributes",
         "WEIGHTS_0 is missing", [](File& f) { attributes(f).erase("WEIGHTS_0"); }},
        {"MESH_PRIMITIVE_NO_POSITION", warned, "/meshes/0/primitives/0", "no positions",
         [](File& f) { attributes(f).erase("POSITION"); }},
        {"MESH_PRIMITIVE_TANGENT_POINTS", warned, "/meshes/0/primitives/0", "points and lines are not drawn",
         [](File& f) { f.json["meshes"][0]["primitives"][0]["mode"] = 0; }},
        {"MESH_PRIMITIVE_TANGENT_WITHOUT_NORMAL", tolerated, "",
         "such tangents are ignored, as section 3.7.2.1 asks",
         [](File& f) {
             attributes(f).erase("NORMAL");
             attributes(f)["TANGENT"] = f.add_vec4s({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1});
         }},
        {"NODE_MATRIX_NON_TRS", tolerated, "", "a matrix is applied as it stands, shear and all",
         [](File& f) { f.json["nodes"][2]["matrix"] = {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }},
        {"NODE_MATRIX_TRS", refused, "/nodes/2", "both a matrix and a scale",
         [](File& f) {
             f.json["nodes"][2] = {{"scale", {1, 1, 1}},
                                   {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
         }},
        {"NODE_ROTATION_NON_UNIT", tolerated, "", "rotations are normalized before use",
         [](File& f) {
             f.json["nodes"][2]["rotation"] = {0, 0, 3, 4};
         }},
        {"NODE_ROTATION_NON_UNIT: of length zero", refused, "/nodes/2/rotation", "length zero",
         [](File& f) {
             f.json["nodes"][2]["rotation"] = {0, 0, 0, 0};
         }},
        {"NON_RELATIVE_URI", refused, "/buffers/0/uri", "has a scheme",
         [](File& f) {
             f.json["buffers"] = {{{"byteLength", f.buffer.size()}, {"uri", "https://example.org/a.bin"}}};
         }},
        {"UNKNOWN_ASSET_MAJOR_VERSION", refused, "/asset/version", "glTF 2 is read",
         [](File& f) { f.json["asset"]["version"] = "3.0"; }},
        {"UNKNOWN_ASSET_MINOR_VERSION", tolerated, "", "minor versions only add, unless minVersion says so",
         [](File& f) { f.json["asset"]["version"] = "2.9"; }},
        {"UNRESERVED_EXTENSION_PREFIX", warned, "/extensionsUsed/0", "is not known",
         [](File& f) { f.json["extensionsUsed"] = {"XYZ_mood"}; }},
        {"UNUSED_EXTENSION_REQUIRED", tolerated, "", "required is as good as used",
         [](File& f) { f.json["extensionsRequired"] = {"KHR_materials_unlit"}; }},
    };
    test::check_codes(codes);
}
