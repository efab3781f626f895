#include "anim/parse_number.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <string_view>

using gridreel::parse_number;

TEST_CASE("a text is a number as a whole or not at all", "[parse_number]") {
    CHECK(parse_number<int>("-12") == -12);
    CHECK(parse_number<double>("2.5e1") == 25.0);
    for (const char* const text : {"", " 1", "1 ", "+1", "1x", "x", "1,5", "0x10", "--1"}) {
        INFO(text);
        CHECK_FALSE(parse_number<int>(text));
        CHECK_FALSE(parse_number<double>(text));
    }
    CHECK_FALSE(parse_number<int>("1.5"));
    CHECK(parse_number<int>(std::string_view("123").substr(0, 2)) == 12);
}

TEST_CASE("a number that its type cannot hold is none", "[parse_number]") {
    CHECK(parse_number<std::uint8_t>("255") == 255);
    CHECK_FALSE(parse_number<std::uint8_t>("256"));
    CHECK_FALSE(parse_number<unsigned>("-1"));
    CHECK_FALSE(parse_number<double>("1e999"));
}
