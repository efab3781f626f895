#include "defect.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace gridreel;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

void add_sparse(test::GltfBuilder& file, const std::vector<std::uint8_t>& targets) {
    const auto indices = file.add_view(targets);
    const auto values = file.add_view(std::vector<float>(3 * targets.size(), 1.0f));
    file.json["accessors"][0]["sparse"] = {
        {"count", targets.size()},
        {"indices", {{"bufferView", indices}, {"componentType", test::uint8}}},
        {"values", {{"bufferView", values}}}};
}

}  // namespace

TEST_CASE("bytes that are not there are refused", "[validate]") {
    const test::Defect defects[] = {
        {"a buffer longer than its data", "/buffers/0", "states 43 bytes but there are 42",
         [](auto& f) {
             f.json["buffers"] = {
                 {{"byteLength", f.buffer.size() + 1},
                  {"uri", "data:application/octet-stream;base64," + test::base64(f.buffer)}}};
         }},
        {"a buffer without a source", "/bufferViews/0", "has no bytes",
         [](auto& f) {
             f.json["buffers"] = {{{"byteLength", 42}}};
         }},
        {"a view longer than its buffer", "/bufferViews/1", "bytes 36 to 43 are beyond buffer 0",
         [](auto& f) { f.json["bufferViews"][1]["byteLength"] = 7; }},
        {"a view that starts beyond its buffer", "/bufferViews/1", "beyond buffer 0",
         [](auto& f) { f.json["bufferViews"][1]["byteOffset"] = 9007199254740992; }},
        {"an unused view beyond its buffer", "/bufferViews/2", "beyond buffer 0",
         [](auto& f) {
             f.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 40}, {"byteLength", 4}});
         }},
        {"more elements than the view holds", "/accessors/0", "need 48 bytes; the buffer view has 36",
         [](auto& f) { f.json["accessors"][0]["count"] = 4; }},
        {"an absurd count", "/accessors/0", "the buffer view has 36",
         [](auto& f) { f.json["accessors"][0]["count"] = 9007199254740992; }},
        {"an offset that leaves too little", "/accessors/0", "need 37 bytes",
         [](auto& f) { f.json["accessors"][0]["byteOffset"] = 1; }},
        {"wider elements than the view holds", "/accessors/1", "need 12 bytes; the buffer view has 6",
         [](auto& f) { f.json["accessors"][1]["componentType"] = test::uint32; }},
        {"a stride that leaves too little", "/accessors/0", "need 44 bytes",
         [](auto& f) { f.json["bufferViews"][0]["byteStride"] = 16; }},
        {"a stride that overlaps elements", "/accessors/0", "overlap",
         [](auto& f) { f.json["bufferViews"][0]["byteStride"] = 8; }},
        {"normalized floats", "/accessors/0/normalized", "cannot be normalized",
         [](auto& f) { f.json["accessors"][0]["normalized"] = true; }},
        {"a sparse index out of range", "/accessors/0/sparse/indices", "is 3, but the accessor has 3",
         [](auto& f) { add_sparse(f, {3}); }},
        {"sparse indices that repeat", "/accessors/0/sparse/indices", "strictly increase",
         [](auto& f) {
             add_sparse(f, {1, 1});
         }},
        {"sparse indices that fall", "/accessors/0/sparse/indices", "strictly increase",
         [](auto& f) {
             add_sparse(f, {2, 0});
         }},
        {"more sparse elements than elements", "/accessors/0/sparse",
         "4 sparse elements replace some of only 3",
         [](auto& f) {
             add_sparse(f, {0, 1, 2, 3});
         }},
        {"sparse indices beyond their view", "/accessors/0/sparse/indices", "the buffer view has 1",
         [](auto& f) {
             add_sparse(f, {1});
             f.json["accessors"][0]["sparse"]["indices"]["componentType"] = test::uint16;
         }},
        {"sparse values beyond their view", "/accessors/0/sparse/values", "the buffer view has 12",
         [](auto& f) {
             add_sparse(f, {1});
             f.json["accessors"][0]["sparse"]["values"]["byteOffset"] = 4;
         }},
    };
    test::check_refusals(defects);
}

TEST_CASE("accessors need not be aligned", "[validate]") {
    auto file = test::one_triangle();
    file.buffer.insert(file.buffer.begin(), std::byte{0});
    file.json["bufferViews"][0]["byteOffset"] = 1;
    file.json["bufferViews"][1]["byteOffset"] = 37;
    CHECK(file.load().meshes[0].primitives[0].positions[1] == glm::vec3(1, 0, 0));
}

TEST_CASE("a small file cannot ask for endless memory", "[validate]") {
    SECTION("an accessor of zeros with an absurd count") {
        auto file = test::one_triangle();
        file.json["accessors"][0].erase("bufferView");
        file.json["accessors"][0]["count"] = 9007199254740992;
        file.json["meshes"][0]["primitives"][0].erase("indices");
        const auto refusal = test::refusal_of(file);
        CHECK(refusal.pointer == "/meshes/0/primitives/0");
        CHECK_THAT(refusal.message, Contains("more memory"));
    }
    SECTION("many primitives that share an accessor") {
        auto file = test::one_triangle();
        file.json["accessors"][0].erase("bufferView");
        file.json["accessors"][0]["count"] = 4'000'000;
        auto& primitives = file.json["meshes"][0]["primitives"];
        primitives[0].erase("indices");
        for (int i = 0; i < 20; ++i) primitives.push_back(primitives[0]);
        CHECK_THAT(test::refusal_of(file).message, Contains("more memory"));
    }
    SECTION("an unused accessor of zeros costs nothing") {
        auto file = test::one_triangle();
        file.json["accessors"].push_back(
            {{"componentType", test::float32}, {"type", "MAT4"}, {"count", 9007199254740992}});
        CHECK(test::refusal_of(file).message.empty());
    }
}
