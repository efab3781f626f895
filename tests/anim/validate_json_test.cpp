#include "anim/error.h"
#include "anim/gltf/json.h"
#include "gltf_builder.h"

#include <catch2/catch.hpp>

using namespace gridreel;
using namespace gridreel::anim::gltf;
using Catch::Matchers::Contains;

TEST_CASE("JSON is written as it was read", "[validate]") {
    const std::string text = R"({"a":[1,-2,0.5,1e+20,true,false,null],"b":{"c":"\"\\é"},"d":[],"e":{}})";
    CHECK(write_json(parse_json(text, "x")) == text);
}

TEST_CASE("text that is not JSON is refused with its file's name", "[validate]") {
    for (const std::string text :
         {"", "{", "[1,]", "{\"a\":1", "{\"a\" 1}", "nul", "{} x", "\"\xff\"", "{\"a\":1e999}"})
        CHECK_THROWS_WITH(parse_json(text, "a.gltf"), Contains("a.gltf: the JSON cannot be read"));
}

TEST_CASE("a property named twice is refused", "[validate]") {
    CHECK_THROWS_WITH(parse_json(R"({"nodes":[],"x":1,"nodes":[{}]})", "a.gltf"),
                      Contains("two properties named \"nodes\""));
}

TEST_CASE("deep nesting is refused before it exhausts the stack", "[validate]") {
    const std::string bomb(1'000'000, '[');
    CHECK_THROWS_WITH(parse_json(bomb, "a.gltf"), Contains("nested deeper than 128"));
    const std::string deep = std::string(128, '[') + std::string(128, ']');
    CHECK_NOTHROW(parse_json(deep, "a.gltf"));
}

TEST_CASE("JSON that is not an object is not glTF", "[validate]") {
    CHECK_THAT(test::refusal_of(test::bytes_of("[]"), "a.gltf").message, Contains("not an object"));
    CHECK_THAT(test::refusal_of(test::bytes_of("{}"), "a.gltf").message, Contains("\"asset\" is missing"));
}
