// Writes the seed corpus: one small sound file for each part of the reader.

#include "tests/anim/draco_builder.h"
#include "tests/anim/gltf_builder.h"

#include <meshoptimizer.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

using namespace gridreel;
using nlohmann::json;
using test::GltfBuilder;

namespace {

void use(GltfBuilder& file, const std::string& extension) {
    file.json["extensionsUsed"].push_back(extension);
}

json channel(std::size_t sampler, std::size_t node, const std::string& path) {
    return {{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}};
}

json pointer_channel(std::size_t sampler, const std::string& pointer) {
    return {{"sampler", sampler},
            {"target",
             {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}};
}

/// Translation, rotation by splines and scale in steps, of a skin with two sets of influences.
GltfBuilder animated_skin() {
    GltfBuilder file = test::skinned_triangle();
    auto& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_1"] = attributes["JOINTS_0"];
    attributes["WEIGHTS_1"] = attributes["WEIGHTS_0"];
    attributes["NORMAL"] = file.add_vec3s({0, 0, 1, 0, 0, 1, 0, 0, 1});
    attributes["TANGENT"] = file.add_vec4s({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1});
    std::vector<float> matrices(32, 0.0f);
    for (std::size_t i = 0; i < 32; i += 5 + i / 15 % 2) matrices[i] = 1.0f;
    file.json["skins"][0]["inverseBindMatrices"] = file.add_accessor(matrices, test::float32, "MAT4", 2);
    const auto times = file.add_scalars({0, 2});
    file.json["animations"] = json::array(
        {{{"samplers",
           {{{"input", times}, {"output", file.add_vec3s({0, 0, 0, 1, 2, 3})}},
            {{"input", times},
             {"output",
              file.add_vec4s({0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0})},
             {"interpolation", "CUBICSPLINE"}},
            {{"input", times}, {"output", file.add_vec3s({1, 1, 1, 2, 2, -2})}, {"interpolation", "STEP"}}}},
          {"channels", {channel(0, 1, "translation"), channel(1, 2, "rotation"), channel(2, 1, "scale")}}}});
    return file;
}

GltfBuilder morph() {
    GltfBuilder file = test::one_triangle();
    const auto shift = file.add_vec3s({0, 0, 1, 0, 0, 1, 0, 0, 1});
    auto& mesh = file.json["meshes"][0];
    mesh["primitives"][0]["attributes"]["NORMAL"] = shift;
    mesh["primitives"][0]["targets"] = {{{"POSITION", shift}}, {{"POSITION", 0}, {"NORMAL", shift}}};
    mesh["weights"] = {0.5, 0};
    const auto times = file.add_scalars({0, 1, 2});
    file.json["animations"] = json::array(
        {{{"samplers",
           json::array({{{"input", times}, {"output", file.add_scalars({0, 1, 1, 0, 0.5f, 0.5f})}}})},
          {"channels", json::array({channel(0, 0, "weights")})}}});
    return file;
}

GltfBuilder sparse() {
    GltfBuilder file = test::one_triangle();
    const auto indices = file.add_view(std::vector<std::uint8_t>{0, 2});
    const auto values = file.add_view(std::vector<float>{0, 0, 3, 0, 1, 3});
    file.json["accessors"].push_back({{"componentType", 5126},
                                      {"type", "VEC3"},
                                      {"count", 3},
                                      {"sparse",
                                       {{"count", 2},
                                        {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                        {"values", {{"bufferView", values}}}}}});
    file.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = file.json["accessors"].size() - 1;
    file.json["accessors"][0]["sparse"] = file.json["accessors"].back()["sparse"];
    return file;
}

/// Strips, fans, points, integer attributes and colours, interleaved.
GltfBuilder quantized() {
    GltfBuilder file;
    use(file, "KHR_mesh_quantization");
    const auto view = file.add_view(
        std::vector<std::int16_t>{0, 0, 0, 0, 1, 1, 9, 0, 0, 0, 2, 2, 0, 9, 0, 0, 3, 3, 9, 9, 0, 0, 4, 4});
    file.json["bufferViews"][view]["byteStride"] = 12;
    file.json["accessors"] = {
        {{"bufferView", view}, {"componentType", 5122}, {"type", "VEC3"}, {"count", 4}},
        {{"bufferView", view},
         {"byteOffset", 8},
         {"componentType", 5121},
         {"normalized", true},
         {"type", "VEC4"},
         {"count", 4}},
        {{"bufferView", view}, {"byteOffset", 8}, {"componentType", 5122}, {"type", "VEC2"}, {"count", 4}}};
    const json attributes = {{"POSITION", 0}, {"COLOR_0", 1}, {"TEXCOORD_0", 2}, {"TEXCOORD_1", 2}};
    for (const int mode : {0, 3, 4, 5, 6})
        file.json["meshes"][0]["primitives"].push_back({{"attributes", attributes}, {"mode", mode}});
    file.json["nodes"] = {{{"mesh", 0}, {"scale", {1, -1, 1}}, {"children", {1}}},
                          {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}}}};
    file.json["scenes"] = {{{"nodes", json::array({0})}}, {{"nodes", json::array({0})}}};
    return file;
}

GltfBuilder instances() {
    GltfBuilder file = test::one_triangle();
    use(file, "EXT_mesh_gpu_instancing");
    use(file, "KHR_node_visibility");
    file.json["nodes"][0]["extensions"] = {{"EXT_mesh_gpu_instancing",
                                            {{"attributes",
                                              {{"TRANSLATION", file.add_vec3s({1, 0, 0, 0, 2, 0})},
                                               {"ROTATION", file.add_vec4s({0, 0, 0, 1, 0, 0, 1, 0})},
                                               {"SCALE", file.add_vec3s({1, 1, 1, 2, 2, 2})}}}}},
                                           {"KHR_node_visibility", {{"visible", true}}}};
    return file;
}

/// Cameras, lights, materials, textures and an image, and pointers to all of them.
GltfBuilder looks() {
    GltfBuilder file = test::one_triangle();
    for (const auto* const extension :
         {"KHR_animation_pointer", "KHR_lights_punctual", "KHR_materials_variants", "KHR_texture_transform",
          "KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_clearcoat",
          "EXT_texture_webp", "KHR_node_visibility"})
        use(file, extension);
    auto& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] =
        file.add_accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, test::float32, "VEC2", 3);
    primitive["material"] = 0;
    primitive["extensions"]["KHR_materials_variants"]["mappings"] =
        json::array({{{"material", 1}, {"variants", json::array({0})}}});
    file.json["extensions"]["KHR_materials_variants"]["variants"] = json::array({{{"name", "red"}}});
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = json::array(
        {{{"type", "spot"}, {"range", 5}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}}});
    file.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}, {"zfar", 9.0}}}},
        {{"type", "orthographic"},
         {"orthographic", {{"xmag", 1.0}, {"ymag", 1.0}, {"znear", 0.0}, {"zfar", 9.0}}}}};
    file.json["nodes"].push_back({{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    file.json["scenes"][0]["nodes"].push_back(1);
    const json transformed = {
        {"index", 0},
        {"extensions", {{"KHR_texture_transform", {{"offset", {0, 1}}, {"rotation", 1}, {"texCoord", 0}}}}}};
    file.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", transformed}, {"baseColorFactor", {1, 0, 0, 1}}}},
         {"normalTexture", {{"index", 0}, {"scale", 2}}},
         {"alphaMode", "MASK"},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 2}}},
           {"KHR_materials_ior", {{"ior", 1.4}}},
           {"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}}}},
        {{"doubleSided", true}, {"emissiveFactor", {1, 1, 1}}}};
    file.json["samplers"] = json::array({{{"wrapS", 33071}, {"minFilter", 9987}}});
    const auto image = file.add_view(std::vector<std::uint8_t>{0x89, 'P', 'N', 'G', 13, 10, 26, 10});
    file.json["images"] = {{{"bufferView", image}, {"mimeType", "image/png"}},
                           {{"uri", "data:image/webp;base64,UklGRg=="}}};
    file.json["textures"] = json::array(
        {{{"source", 0}, {"sampler", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}}});

    const auto times = file.add_scalars({0, 1});
    const auto sampler = [&](std::size_t output) { return json{{"input", times}, {"output", output}}; };
    file.json["animations"] = json::array(
        {{{"samplers",
           {sampler(file.add_scalars({0.5f, 1})), sampler(file.add_vec4s({0, 0, 0, 1, 1, 1, 1, 1})),
            sampler(file.add_vec3s({0, 0, 0, 1, 1, 1})),
            sampler(file.add_accessor(std::vector<float>{0, 0, 1, 1}, test::float32, "VEC2", 2))}},
          {"channels",
           {pointer_channel(0, "/cameras/0/perspective/yfov"),
            pointer_channel(0, "/extensions/KHR_lights_punctual/lights/0/intensity"),
            pointer_channel(1, "/materials/0/pbrMetallicRoughness/baseColorFactor"),
            pointer_channel(2, "/materials/1/emissiveFactor"), pointer_channel(2, "/nodes/0/translation"),
            pointer_channel(3,
                            "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/"
                            "KHR_texture_transform/offset"),
            pointer_channel(0, "/nodes/0/extensions/KHR_node_visibility/visible")}}}});
    file.json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = true;
    return file;
}

/// Positions and indices, each compressed by meshoptimizer.
GltfBuilder meshopt() {
    GltfBuilder file = test::one_triangle();
    use(file, "EXT_meshopt_compression");
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::vector<unsigned> indices{0, 1, 2};
    std::vector<unsigned char> attributes(meshopt_encodeVertexBufferBound(3, 12));
    attributes.resize(
        meshopt_encodeVertexBuffer(attributes.data(), attributes.size(), positions.data(), 3, 12));
    std::vector<unsigned char> triangles(meshopt_encodeIndexBufferBound(3, 3));
    triangles.resize(meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), indices.data(), 3));

    GltfBuilder packed{.json = file.json, .buffer = {}};
    packed.json.erase("bufferViews");
    const auto attribute_view = packed.add_view(attributes), triangle_view = packed.add_view(triangles);
    json views = packed.json["bufferViews"];
    packed.json["bufferViews"] = json::array();
    const auto add = [&](std::size_t source, std::size_t length, const json& more) {
        json extension = views[source];
        extension.update(more);
        packed.json["bufferViews"].push_back({{"buffer", 1},
                                              {"byteLength", length},
                                              {"extensions", {{"EXT_meshopt_compression", extension}}}});
    };
    add(attribute_view, 36, {{"byteStride", 12}, {"count", 3}, {"mode", "ATTRIBUTES"}, {"filter", "NONE"}});
    add(triangle_view, 6, {{"byteStride", 2}, {"count", 3}, {"mode", "TRIANGLES"}});
    packed.json["buffers"] = {
        {{"byteLength", packed.buffer.size()}},
        {{"byteLength", 42}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    return packed;
}

GltfBuilder draco(bool sequential) {
    const auto mesh = test::bumpy_sheet(1, 2);
    return test::draco_file(mesh, test::DracoSettings{.sequential = sequential});
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: gridreel_fuzz_seeds FOLDER\n", stderr);
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    const std::initializer_list<std::pair<std::string, GltfBuilder>> seeds{
        {"triangle", test::one_triangle()},
        {"skin", animated_skin()},
        {"morph", morph()},
        {"sparse", sparse()},
        {"quantized", quantized()},
        {"instances", instances()},
        {"looks", looks()},
        {"meshopt", meshopt()},
        {"draco-sequential", draco(true)},
        {"draco-edgebreaker", draco(false)}};
    for (const auto& [name, file] : seeds) {
        static_cast<void>(anim::load_bytes(file.glb(), name));  // a seed that is refused reaches nothing
        const auto bytes = file.glb();
        std::ofstream stream(folder / (name + ".glb"), std::ios::binary);
        stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
    const std::string text = test::one_triangle().gltf();
    std::ofstream(folder / "embedded.gltf", std::ios::binary) << text;
    return 0;
}
