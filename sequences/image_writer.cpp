#include "sequences/image_writer.h"

#include "sequences/errors.h"
#include "sequences/whole_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <memory>
#include <span>
#include <vector>

namespace gridreel::sequences {
namespace {

OIIO::TypeDesc type_of(PixelType type) {
    switch (type) {
        case PixelType::byte:
            return OIIO::TypeDesc::UINT8;
        case PixelType::half_float:
            return OIIO::TypeDesc::HALF;
        case PixelType::single_float:
            return OIIO::TypeDesc::FLOAT;
    }
    return OIIO::TypeDesc::UNKNOWN;
}

OIIO::ImageSpec describe(const Picture& picture, const ImageSettings& settings) {
    OIIO::ImageSpec spec(picture.width, picture.height, static_cast<int>(picture.channels.size()),
                         type_of(picture.channels.front().type));
    spec.channelnames.clear();
    for (const PictureChannel& channel : picture.channels) {
        spec.channelnames.push_back(channel.name);
        spec.channelformats.push_back(type_of(channel.type));
    }
    spec.alpha_channel = 3;
    spec.z_channel = settings.aov_z ? 4 : -1;
    if (settings.format == ImageFormat::exr) {
        // Left to itself the writer stamps the time of writing, and equal pictures would differ.
        spec.attribute("DateTime", "1970:01:01 00:00:00");
        spec.attribute("compression", settings.compression);
        spec.attribute("oiio:ColorSpace", "Linear");
    } else {
        spec.channelformats.clear();
        spec.attribute("oiio:ColorSpace", "sRGB");
        spec.attribute("oiio:UnassociatedAlpha", 1);
    }
    return spec;
}

/// @return the file's bytes
/// @throws OutputError
std::vector<unsigned char> encode(const Picture& picture, const ImageSettings& settings,
                                  const std::filesystem::path& file) {
    const char* format = settings.format == ImageFormat::exr ? "openexr" : "png";
    const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(format);
    // Into memory first: left to write files, the PNG writer does not notice a full disk.
    OIIO::Filesystem::IOVecOutput bytes;
    const bool written = out && out->set_ioproxy(&bytes) &&
                         out->open(file.filename().string(), describe(picture, settings)) &&
                         out->write_image(OIIO::TypeDesc::UNKNOWN, picture.pixels.data()) && out->close();
    if (written) return bytes.buffer();
    throw OutputError(
        fmt::format("the frame cannot be encoded ({})", out ? out->geterror() : OIIO::geterror()),
        file.string());
}

}  // namespace

void write_image(const Picture& picture, const ImageSettings& settings, const std::filesystem::path& file) {
    const std::vector<unsigned char> bytes = encode(picture, settings, file);
    write_whole_file(file, std::as_bytes(std::span(bytes)));
}

void limit_image_threads(int threads) {
    OIIO::attribute("threads", threads);
    OIIO::attribute("exr_threads", threads == 1 ? -1 : threads);
}

}  // namespace gridreel::sequences
