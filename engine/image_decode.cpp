#include "engine/image_decode.h"

#include "anim/error.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <string>
#include <string_view>

namespace gridreel::engine {
namespace {

/// What the reader complains of, on one line.
std::string complaint_of(const OIIO::ImageInput& input) {
    std::string text = input.geterror();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

constexpr int largest_side = 16384;

std::string place_of(const anim::Image& image) {
    return fmt::format("image \"{}\"", image.name);
}

std::string_view bytes_at(const anim::Image& image, std::size_t first, std::size_t count) {
    if (image.encoded.size() < first + count) return {};
    return {reinterpret_cast<const char*>(image.encoded.data()) + first, count};
}

/// OpenImageIO's name for the file's format; empty for one we do not read.
std::string_view format_of(const anim::Image& image) {
    if (bytes_at(image, 0, 4) == "\x89PNG") return "png";
    if (bytes_at(image, 0, 3) == "\xff\xd8\xff") return "jpeg";
    if (bytes_at(image, 0, 4) == "RIFF" && bytes_at(image, 8, 4) == "WEBP") return "webp";
    return {};
}

/// Spreads `channels` interleaved values a texel to RGBA.
std::vector<glm::u16vec4> to_rgba(const std::vector<std::uint16_t>& values, std::size_t channels) {
    constexpr std::uint16_t opaque = 65535;
    std::vector<glm::u16vec4> texels(values.size() / channels);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const std::uint16_t* v = values.data() + i * channels;
        if (channels < 3) {
            texels[i] = {v[0], v[0], v[0], channels == 2 ? v[1] : opaque};
        } else {
            texels[i] = {v[0], v[1], v[2], channels == 3 ? opaque : v[3]};
        }
    }
    return texels;
}

}  // namespace

DecodedImage decode(const anim::Image& image) {
    if (bytes_at(image, 0, 7) == "\xabKTX 20") {
        throw Error("the image is KTX2, which is not read", place_of(image),
                    "convert the textures: npx @gltf-transform/cli ktxdecompress IN.glb OUT.glb");
    }
    const std::string_view format = format_of(image);
    if (format.empty()) {
        throw Error("the image is neither PNG, JPEG nor WebP", place_of(image),
                    "convert it to PNG or JPEG and export the scene again");
    }

    OIIO::Filesystem::IOMemReader bytes(image.encoded.data(), image.encoded.size());
    const auto input = OIIO::ImageInput::create(std::string(format));
    if (!input || !input->set_ioproxy(&bytes)) {
        throw Error(fmt::format("OpenImageIO was built without a reader of {} in memory", format),
                    place_of(image), "convert it to PNG or JPEG and export the scene again");
    }
    OIIO::ImageSpec spec;
    OIIO::ImageSpec wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);
    if (!input->open(image.name, spec, wishes)) {
        throw Error(fmt::format("the image cannot be read ({})", complaint_of(*input)), place_of(image),
                    "export the scene again");
    }
    if (spec.width < 1 || spec.height < 1 || spec.width > largest_side || spec.height > largest_side) {
        throw Error(fmt::format("the image is {} x {} pixels", spec.width, spec.height), place_of(image),
                    fmt::format("scale it down to at most {0} x {0}", largest_side));
    }

    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<std::uint16_t> values(static_cast<std::size_t>(spec.width) *
                                      static_cast<std::size_t>(spec.height) * channels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT16, values.data())) {
        throw Error(fmt::format("the image is damaged ({})", complaint_of(*input)), place_of(image),
                    "export the scene again");
    }
    return {.width = spec.width, .height = spec.height, .texels = to_rgba(values, channels)};
}

}  // namespace gridreel::engine
