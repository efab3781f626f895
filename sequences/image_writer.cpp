#include "sequences/image_writer.h"

#include "sequences/errors.h"
#include "sequences/pending_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <memory>
#include <string>

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

[[noreturn]] void fail(const std::filesystem::path& file, std::string reason) {
    while (!reason.empty() && (reason.back() == '\n' || reason.back() == '.')) reason.pop_back();
    throw OutputError(fmt::format("the frame cannot be written ({})", reason), file.string(),
                      "check the folder, its permissions and the free space");
}

}  // namespace

void write_image(const Picture& picture, const ImageSettings& settings, const std::filesystem::path& file) {
    PendingFile pending(file);
    const char* format = settings.format == ImageFormat::exr ? "openexr" : "png";
    const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(format);
    if (!out) fail(file, OIIO::geterror());

    const OIIO::ImageSpec spec = describe(picture, settings);
    const bool written = out->open(pending.temporary().string(), spec) &&
                         out->write_image(OIIO::TypeDesc::UNKNOWN, picture.pixels.data());
    // Closed in any case, and asked: the last bytes may fail too.
    const bool closed = out->close();
    if (!written || !closed) fail(file, out->geterror());
    pending.commit();
}

void limit_image_threads(int threads) {
    OIIO::attribute("threads", threads);
    OIIO::attribute("exr_threads", threads == 1 ? -1 : threads);
}

}  // namespace gridreel::sequences
