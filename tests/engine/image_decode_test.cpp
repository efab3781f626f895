#include "engine/image_decode.h"

#include "anim/error.h"
#include "encoded_images.h"

#include <catch2/catch.hpp>

#include <cstddef>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
/// OpenImageIO's PNG reader jumps over destructors when a file ends early: some 30 bytes a file are its own.
using OthersLeaks = __lsan::ScopedDisabler;
#else
struct OthersLeaks {};
#endif

using namespace gridreel;

TEST_CASE("colours under transparent texels are kept", "[engine]") {
    const engine::DecodedImage image = engine::decode(test::png(2, 1, 4, {255, 128, 0, 0, 1, 2, 3, 51}));
    REQUIRE(image.width == 2);
    REQUIRE(image.height == 1);
    CHECK(image.texels[0] == glm::u16vec4(65535, 128 * 257, 0, 0));
    CHECK(image.texels[1] == glm::u16vec4(1 * 257, 2 * 257, 3 * 257, 51 * 257));
}

TEST_CASE("grey images spread over the colours, and absent alpha is opaque", "[engine]") {
    CHECK(engine::decode(test::png(1, 1, 1, {10})).texels[0] == glm::u16vec4(2570, 2570, 2570, 65535));
    CHECK(engine::decode(test::png(1, 1, 2, {10, 20})).texels[0] == glm::u16vec4(2570, 2570, 2570, 5140));
    CHECK(engine::decode(test::png(1, 1, 3, {10, 20, 30})).texels[0] ==
          glm::u16vec4(2570, 5140, 7710, 65535));
}

TEST_CASE("16-bit images keep their bits", "[engine]") {
    CHECK(engine::decode(test::png16(1, 1, 3, {1, 513, 65534})).texels[0] ==
          glm::u16vec4(1, 513, 65534, 65535));
}

TEST_CASE("rows run from the top", "[engine]") {
    const engine::DecodedImage image = engine::decode(test::png(1, 2, 1, {7, 9}));
    CHECK(image.texels[0].x == 7 * 257);
    CHECK(image.texels[1].x == 9 * 257);
}

TEST_CASE("JPEG is told by its bytes, whatever its type says", "[engine]") {
    anim::Image image = test::jpeg(8, 8, std::vector<std::uint8_t>(8 * 8 * 3, 200));
    image.mime_type = "image/png";
    const engine::DecodedImage decoded = engine::decode(image);
    CHECK(decoded.texels[0].x == Approx(200 * 257).margin(2 * 257));
    CHECK(decoded.texels[0].w == 65535);
}

TEST_CASE("an image that cannot be decoded is an error that names it", "[engine]") {
    anim::Image damaged = test::png(16, 16, 3, std::vector<std::uint8_t>(16 * 16 * 3, 100));
    damaged.name = "skin.png";
    damaged.encoded.resize(60);
    {
        [[maybe_unused]] const OthersLeaks others_leaks;
        CHECK_THROWS_WITH(engine::decode(damaged), Catch::Contains("skin.png"));
        CHECK_THROWS_AS(engine::decode(damaged), Error);
    }

    const anim::Image unknown{
        .name = "notes.txt", .mime_type = "image/png", .encoded = std::vector<std::byte>(100)};
    CHECK_THROWS_WITH(engine::decode(unknown), Catch::Contains("notes.txt") && Catch::Contains("PNG"));
    CHECK_THROWS_AS(engine::decode(anim::Image{}), Error);
}
