#include "encoded_images.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>

#include <cstddef>
#include <cstring>
#include <string>

namespace gridreel::test {
namespace {

anim::Image encoded(const std::string& name, const OIIO::ImageSpec& spec, const void* values) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput sink(bytes);
    const auto output = OIIO::ImageOutput::create(name, &sink);
    REQUIRE(output);
    REQUIRE(output->open(name, spec));
    REQUIRE(output->write_image(spec.format, values));
    REQUIRE(output->close());
    anim::Image image{.name = name, .mime_type = {}, .encoded = std::vector<std::byte>(bytes.size())};
    std::memcpy(image.encoded.data(), bytes.data(), bytes.size());
    return image;
}

OIIO::ImageSpec specification(int width, int height, int channels, OIIO::TypeDesc type) {
    OIIO::ImageSpec spec(width, height, channels, type);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    return spec;
}

}  // namespace

anim::Image png(int width, int height, int channels, const std::vector<std::uint8_t>& values) {
    return encoded("test.png", specification(width, height, channels, OIIO::TypeDesc::UINT8), values.data());
}

anim::Image png16(int width, int height, int channels, const std::vector<std::uint16_t>& values) {
    return encoded("test.png", specification(width, height, channels, OIIO::TypeDesc::UINT16), values.data());
}

anim::Image jpeg(int width, int height, const std::vector<std::uint8_t>& values) {
    return encoded("test.jpg", specification(width, height, 3, OIIO::TypeDesc::UINT8), values.data());
}

}  // namespace gridreel::test
