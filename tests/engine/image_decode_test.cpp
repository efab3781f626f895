#include "engine/image_decode.h"

#include "anim/error.h"
#include "encoded_images.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstddef>
#include <span>

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

TEST_CASE("WebP is read", "[engine]") {
    // One texel of (255, 0, 64), lossy: oiiotool --create 1x1 3 --fill:color=1,0,0.25 1x1 -o a.webp
    constexpr std::array<unsigned char, 72> file{
        0x52, 0x49, 0x46, 0x46, 0x40, 0x00, 0x00, 0x00, 0x57, 0x45, 0x42, 0x50, 0x56, 0x50, 0x38,
        0x20, 0x34, 0x00, 0x00, 0x00, 0xf0, 0x01, 0x00, 0x9d, 0x01, 0x2a, 0x01, 0x00, 0x01, 0x00,
        0x00, 0x00, 0x00, 0x25, 0xa0, 0x02, 0x74, 0xba, 0x01, 0xf8, 0x00, 0x06, 0x42, 0x00, 0x00,
        0xfe, 0xff, 0x15, 0x0f, 0x7f, 0xe7, 0xe6, 0x77, 0x6e, 0x2f, 0xea, 0xb7, 0xff, 0xf7, 0xfa,
        0x7f, 0xf7, 0xfa, 0x7f, 0xf7, 0xfa, 0x7f, 0xff, 0x7f, 0x3c, 0x00, 0x00};
    const auto bytes = std::as_bytes(std::span(file));
    const anim::Image image{
        .name = "a.webp", .mime_type = "image/webp", .encoded = {bytes.begin(), bytes.end()}};
    const engine::DecodedImage decoded = engine::decode(image);
    REQUIRE(decoded.texels.size() == 1);
    CHECK(decoded.texels[0].x == Approx(65535).margin(2 * 257));
    CHECK(decoded.texels[0].y == Approx(0).margin(2 * 257));
    CHECK(decoded.texels[0].z == Approx(64 * 257).margin(2 * 257));
    CHECK(decoded.texels[0].w == 65535);
}

TEST_CASE("KTX2 is refused with the command that converts it", "[engine]") {
    const auto magic = std::as_bytes(std::span("\xabKTX 20\xbb\r\n\x1a\n"));
    const anim::Image image{.name = "brick", .mime_type = {}, .encoded = {magic.begin(), magic.end()}};
    CHECK_THROWS_WITH(engine::decode(image), Catch::Contains("brick") && Catch::Contains("ktxdecompress"));
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
