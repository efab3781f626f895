// Whole files whose buffer views are compressed by meshoptimizer.

#include "anim/gltf/buffer_views.h"

#include "gltf_builder.h"

#include <catch2/catch.hpp>
#include <meshoptimizer.h>

#include <functional>

using namespace gridreel;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

constexpr auto ext = "EXT_meshopt_compression";

enum class Copy { absent, present };

json embedded(const std::vector<std::byte>& bytes) {
    return {{"byteLength", bytes.size()},
            {"uri", "data:application/octet-stream;base64," + test::base64(bytes)}};
}

/// A skinned, animated triangle: meshes, samplers and inverse bind matrices all have buffer views.
test::GltfBuilder animated_triangle() {
    auto file = test::skinned_triangle();
    std::vector<float> matrices(32, 0.0f);
    for (std::size_t i = 0; i < matrices.size(); ++i) matrices[i] = i % 5 == 0 ? 1.0f : 0.125f;
    const auto inverse = file.add_accessor(matrices, test::float32, "MAT4", 2);
    const auto times = file.add_scalars({0, 1, 3});
    const auto moves = file.add_vec3s({0, 0, 0, 1, 2, 3, 4, 5, 6});
    file.json["skins"][0]["inverseBindMatrices"] = inverse;
    file.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", moves}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}}};
    return file;
}

/// The same file with every view compressed: buffer 0 holds what is compressed, buffer 1 stands in for the
/// views themselves.
test::GltfBuilder compressed(const test::GltfBuilder& file, Copy copy, const std::string& extension = ext) {
    test::GltfBuilder packed{.json = file.json, .buffer = {}};
    std::vector<std::byte> encoded;
    for (json& view : packed.json["bufferViews"]) {
        const std::size_t offset = view["byteOffset"], length = view["byteLength"];
        const bool is_attribute = length % 4 == 0;
        const std::size_t stride = is_attribute ? 4 : 2, count = length / stride;
        const auto* const source = file.buffer.data() + offset;
        std::vector<unsigned char> stream(64 + meshopt_encodeVertexBufferBound(count, stride * 2));
        if (is_attribute) {
            stream.resize(meshopt_encodeVertexBuffer(stream.data(), stream.size(), source, count, stride));
        } else {
            std::vector<std::uint16_t> indices(count);
            std::memcpy(indices.data(), source, length);
            stream.resize(
                meshopt_encodeIndexSequence(stream.data(), stream.size(), indices.data(), indices.size()));
        }
        view["extensions"][extension] = {{"buffer", 0},
                                         {"byteOffset", encoded.size()},
                                         {"byteLength", stream.size()},
                                         {"byteStride", stride},
                                         {"count", count},
                                         {"mode", is_attribute ? "ATTRIBUTES" : "INDICES"}};
        view["buffer"] = 1;
        for (const unsigned char byte : stream) encoded.push_back(static_cast<std::byte>(byte));
    }
    json fallback = copy == Copy::present ? embedded(file.buffer) : json{{"byteLength", file.buffer.size()}};
    fallback["extensions"][extension]["fallback"] = true;
    packed.json["buffers"] = json::array({embedded(encoded), fallback});
    packed.json["extensionsUsed"] = json::array({extension});
    if (copy == Copy::absent) packed.json["extensionsRequired"] = json::array({extension});
    packed.buffer.clear();
    return packed;
}

json& extension_of(test::GltfBuilder& file, std::size_t view) {
    return file.json["bufferViews"][view]["extensions"][ext];
}

void check_is_animated_triangle(const anim::Scene& scene) {
    const auto original = animated_triangle().load();
    const auto &primitive = scene.meshes.at(0).primitives.at(0), &expected = original.meshes[0].primitives[0];
    CHECK(primitive.positions == expected.positions);
    CHECK(primitive.triangles == expected.triangles);
    CHECK(primitive.influences.joints == expected.influences.joints);
    CHECK(primitive.influences.weights == expected.influences.weights);
    CHECK(scene.skins.at(0).inverse_bind == original.skins[0].inverse_bind);
    CHECK(scene.animations.at(0).samplers.at(0).times_s == original.animations[0].samplers[0].times_s);
    CHECK(scene.animations[0].samplers[0].values == original.animations[0].samplers[0].values);
}

}  // namespace

TEST_CASE("meshes, samplers and bind matrices are read through compressed views", "[meshopt]") {
    for (const std::string extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
        for (const Copy copy : {Copy::absent, Copy::present}) {
            const auto scene = compressed(animated_triangle(), copy, extension).load();
            CHECK(scene.warnings.empty());
            check_is_animated_triangle(scene);
        }
}

TEST_CASE("a fallback buffer may be missing, even where it names a file", "[meshopt]") {
    auto file = compressed(animated_triangle(), Copy::absent);
    SECTION("beside the model") {
        file.json["buffers"][1]["uri"] = "nowhere.bin";
    }
    SECTION("cut short") {
        file.json["buffers"][1]["uri"] = "data:application/octet-stream;base64,AAAA";
    }
    check_is_animated_triangle(file.load());
}

TEST_CASE("the uncompressed copy stands in for what cannot be decompressed", "[meshopt]") {
    const std::function<void(json&)> defects[] = {
        [](json& extension) { extension["byteLength"] = extension["byteLength"].get<int>() - 1; },
        [](json& extension) { extension["filter"] = "COLOR"; },
    };
    for (const auto& inflict : defects) {
        auto file = compressed(animated_triangle(), Copy::present);
        inflict(extension_of(file, 0));
        const auto scene = file.load();
        check_is_animated_triangle(scene);
        CHECK_THAT(test::warning_at(scene, "/bufferViews/0/extensions/EXT_meshopt_compression"),
                   Contains("the uncompressed copy is used"));

        file = compressed(animated_triangle(), Copy::absent);
        inflict(extension_of(file, 0));
        const auto refusal = test::refusal_of(file);
        CHECK(refusal.pointer == "/bufferViews/0/extensions/EXT_meshopt_compression");
        CHECK_THAT(refusal.message, Contains("pack the model again"));
    }
}

TEST_CASE("compressed views that break the extension's rules are refused", "[meshopt]") {
    // View 0 holds positions: 9 elements of 4 bytes; view 1 holds indices: 3 of 2 bytes.
    const std::string first = "/bufferViews/0", second = "/bufferViews/1";
    const std::string in = "/extensions/EXT_meshopt_compression";
    struct Broken {
        std::string name, pointer, message;
        void (*inflict)(test::GltfBuilder&);
    };
    const Broken broken[] = {
        {"odd attributes", first + in + "/byteStride", "multiple of 4",
         [](auto& f) { extension_of(f, 0)["byteStride"] = 6; }},
        {"huge attributes", first + in + "/byteStride", "at most 256",
         [](auto& f) { extension_of(f, 0)["byteStride"] = 260; }},
        {"wide indices", second + in + "/byteStride", "must be 2 or 4",
         [](auto& f) { extension_of(f, 1)["byteStride"] = 8; }},
        {"filtered indices", second + in + "/filter", "is for attributes",
         [](auto& f) { extension_of(f, 1)["filter"] = "EXPONENTIAL"; }},
        {"parts of triangles", second + in + "/count", "whole triangles",
         [](auto& f) {
             extension_of(f, 1)["mode"] = "TRIANGLES";
             extension_of(f, 1)["count"] = 4;
         }},
        {"quaternions of four bytes", first + in + "/byteStride", "QUATERNION needs 8",
         [](auto& f) { extension_of(f, 0)["filter"] = "QUATERNION"; }},
        {"octahedra of twelve bytes", first + in + "/byteStride", "OCTAHEDRAL needs 4 or 8",
         [](auto& f) {
             extension_of(f, 0)["filter"] = "OCTAHEDRAL";
             extension_of(f, 0)["byteStride"] = 12;
             extension_of(f, 0)["count"] = 3;
         }},
        {"another length", first + "/byteLength", "9 elements of 4 bytes are compressed",
         [](auto& f) { f.json["bufferViews"][0]["byteLength"] = 40; }},
        {"another stride", first + "/byteStride", "stride is 12, but 4",
         [](auto& f) { f.json["bufferViews"][0]["byteStride"] = 12; }},
        {"an unknown mode", first + in + "/mode", "is not a \"mode\"",
         [](auto& f) { extension_of(f, 0)["mode"] = "POINTS"; }},
        {"an unknown filter", first + in + "/filter", "is not a \"filter\"",
         [](auto& f) { extension_of(f, 0)["filter"] = "OCT"; }},
        {"no elements", first + in + "/count", "at least 1",
         [](auto& f) { extension_of(f, 0)["count"] = 0; }},
        {"no count", first + in, "\"count\" is missing", [](auto& f) { extension_of(f, 0).erase("count"); }},
        {"an unknown buffer", first + in + "/buffer", "out of range",
         [](auto& f) { extension_of(f, 0)["buffer"] = 2; }},
        {"the fallback as a source", first + in, "buffer 1 has no bytes",
         [](auto& f) { extension_of(f, 0)["buffer"] = 1; }},
        {"data beyond its buffer", first + in, "beyond buffer 0",
         [](auto& f) { extension_of(f, 0)["byteLength"] = 100'000; }},
        {"the fallback read in the clear", first, "buffer 1 has no bytes",
         [](auto& f) { f.json["bufferViews"][0].erase("extensions"); }},
        {"a claim of terabytes", first + in, "cannot hold",
         [](auto& f) {
             extension_of(f, 0)["count"] = 3'000'000'000'000;
             f.json["bufferViews"][0]["byteLength"] = 12'000'000'000'000;
         }},
    };
    for (const Broken& defect : broken) {
        DYNAMIC_SECTION(defect.name) {
            auto file = compressed(animated_triangle(), Copy::absent);
            defect.inflict(file);
            const auto refusal = test::refusal_of(file);
            CHECK(refusal.pointer == defect.pointer);
            CHECK_THAT(refusal.message, Contains(defect.message));
        }
    }
}

TEST_CASE("the younger extension leaves the view's stride to the accessors", "[meshopt]") {
    auto file = compressed(animated_triangle(), Copy::absent, "KHR_meshopt_compression");
    file.json["bufferViews"][0]["byteStride"] = 12;
    check_is_animated_triangle(file.load());
}
