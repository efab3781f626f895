#include "khronos_code.h"

#include "anim/error.h"

namespace gridreel::test {

using nlohmann::json;

GltfBuilder bit_of_everything() {
    GltfBuilder file = skinned_triangle();
    attributes(file)["NORMAL"] = file.add_vec3s({0, 0, 1, 0, 0, 1, 0, 0, 1});
    attributes(file)["TEXCOORD_0"] =
        file.add_accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, float32, "VEC2", 3);
    auto& mesh = file.json["meshes"][0];
    mesh["primitives"][0]["targets"] = json::array({{{"POSITION", 0}}});
    mesh["primitives"][0]["material"] = 0;
    mesh["weights"] = {0.5};

    std::vector<float> matrices(32, 0.0f);
    for (std::size_t i = 0; i < matrices.size(); ++i) matrices[i] = i % 16 % 5 == 0 ? 1.0f : 0.0f;
    file.json["skins"][0]["inverseBindMatrices"] = file.add_accessor(matrices, float32, "MAT4", 2);

    file.json["images"] = {{{"uri", "data:image/png;base64,iVBORw0KGgo="}}};
    file.json["samplers"] = json::array({json::object()});
    file.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};

    file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"znear", 1}, {"yfov", 1}}}}};
    file.json["nodes"].push_back({{"camera", 0}});
    file.json["scenes"][0]["nodes"].push_back(3);

    const auto times = file.add_scalars({0, 1});
    const auto moves = file.add_vec3s({0, 0, 0, 1, 0, 0});
    file.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", moves}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}}};
    return file;
}

json& attributes(GltfBuilder& file) {
    return file.json["meshes"][0]["primitives"][0]["attributes"];
}

json& key_sampler(GltfBuilder& file) {
    return file.json["animations"][0]["samplers"][0];
}

json& channel_target(GltfBuilder& file) {
    return file.json["animations"][0]["channels"][0]["target"];
}

namespace {

void check_refused(const GltfBuilder& file, const KhronosCode& code) {
    try {
        static_cast<void>(file.load());
        FAIL("it loaded");
    } catch (const Error& error) {
        CHECK(error.where() == "test.gltf: " + code.pointer);
        CHECK_THAT(error.what(), Catch::Matchers::Contains(code.text));
        CHECK_FALSE(error.remedy().empty());
    }
}

}  // namespace

void check_codes(std::span<const KhronosCode> codes) {
    REQUIRE(bit_of_everything().load().warnings.empty());
    for (const KhronosCode& code : codes) {
        DYNAMIC_SECTION(code.code) {
            auto file = bit_of_everything();
            code.inflict(file);
            if (code.verdict == Verdict::refused) {
                check_refused(file, code);
                continue;
            }
            const auto scene = file.load();
            const auto warning = warning_at(scene, code.pointer);
            CAPTURE(warning);
            if (code.verdict == Verdict::warned)
                CHECK_THAT(warning, Catch::Matchers::Contains(code.text));
            else
                CHECK(scene.warnings.empty());
        }
    }
}

}  // namespace gridreel::test
