#include "sequences/render_text.h"
#include "sequences/errors.h"

#include <catch2/catch.hpp>

#include <string>

using namespace gridreel::sequences;

TEST_CASE("picture sizes", "[render_text]") {
    CHECK(parse_size("1280x720").width == 1280);
    CHECK(parse_size("1280x720").height == 720);
    CHECK_FALSE(parse_size("1280x").height);
    for (const std::string text : {"", "x", "1280", "x720", "0x10", "10x0", "-1x10", "10x-1", "1e3x10",
                                   "10x10x10", "32769x1", "1x99999999999", "10 x 10"}) {
        INFO(text);
        CHECK_THROWS_AS(parse_size(text), UsageError);
    }
}

TEST_CASE("hex backgrounds are sRGB, numbers are linear light", "[render_text]") {
    CHECK(parse_background("#ffffff") == glm::vec4{1, 1, 1, 1});
    CHECK(parse_background("#00000080").a == 128 / 255.0f);
    CHECK(parse_background("#808080").g == Approx(0.2158605));
    CHECK(parse_background("#FF0000") == glm::vec4{1, 0, 0, 1});
    CHECK(parse_background("0.25,0.5,2") == glm::vec4{0.25f, 0.5f, 2.0f, 1.0f});
    CHECK(parse_background("0.25,0.5,2,0.5") == glm::vec4{0.25f, 0.5f, 2.0f, 0.5f});
    CHECK(parse_background("transparent") == glm::vec4{0.0f});
    for (const std::string text : {"", "red", "#fff", "#gggggg", "#ff00000", "0.1,0.2", "0.1,0.2,0.3,0.4,0.5",
                                   "-1,0,0", "nan,0,0", "0,0,0,2", "1,,1", "#-10000"}) {
        INFO(text);
        CHECK_THROWS_AS(parse_background(text), UsageError);
    }
}

TEST_CASE("lambda is a number, the paper's five, or nothing", "[render_text]") {
    CHECK(parse_lambda("0.4") == 0.4f);
    CHECK(parse_lambda("paper") == 5.0f);
    CHECK(parse_lambda("auto") == std::nullopt);
    for (const std::string text : {"", "0", "-1", "nan", "inf", "five", "Auto", "auto "}) {
        INFO(text);
        CHECK_THROWS_AS(parse_lambda(text), UsageError);
        CHECK_THROWS_WITH(parse_lambda(text), Catch::Matchers::Contains("auto"));
    }
}
