#include "engine/srgb.h"

#include <catch2/catch.hpp>

using namespace gridreel;

TEST_CASE("sRGB decodes to the values of its standard", "[engine]") {
    CHECK(engine::linear_from_srgb(0.0f) == 0.0f);
    CHECK(engine::linear_from_srgb(1.0f) == Approx(1.0f));
    CHECK(engine::linear_from_srgb(0.5f) == Approx(0.21404114f));
    CHECK(engine::linear_from_srgb(0.04f) == Approx(0.04f / 12.92f));  // the linear foot
    CHECK(engine::linear_from_srgb(188.0f / 255.0f) == Approx(0.50288653f));
}

TEST_CASE("every 8-bit sRGB value survives the way to linear and back", "[engine]") {
    for (int value = 0; value < 256; ++value) {
        const float encoded = static_cast<float>(value) / 255.0f;
        CHECK(engine::srgb_from_linear(engine::linear_from_srgb(encoded)) == Approx(encoded).margin(1e-6));
    }
}
