#include "sequences/image_settings.h"

#include "sequences/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace gridreel::sequences {

ImageFormat image_format(std::string_view extension) {
    if (extension == ".exr") return ImageFormat::exr;
    if (extension == ".png") return ImageFormat::png;
    const auto what = extension.empty()
                          ? std::string("the file name has no extension")
                          : fmt::format("'{}' is not a format that frames are written in", extension);
    throw UsageError(what, "--output", "end it in .exr or .png");
}

const std::vector<std::string>& compressions() {
    static const std::vector<std::string> names{"none", "rle", "zips", "zip", "piz"};
    return names;
}

void choose_aovs(std::string_view list, ImageSettings& settings) {
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t comma = std::min(list.find(',', begin), list.size());
        const std::string_view name = list.substr(begin, comma - begin);
        begin = comma + 1;
        if (name != "z" && name != "n" && name != "all") {
            throw UsageError(fmt::format("'{}' is not a channel group", name), "--aov",
                             "choose from z, n, all, separated by commas");
        }
        settings.aov_z = settings.aov_z || name != "n";
        settings.aov_n = settings.aov_n || name != "z";
    }
}

void check(const ImageSettings& settings) {
    const auto& names = compressions();
    if (std::find(names.begin(), names.end(), settings.compression) == names.end()) {
        throw UsageError(fmt::format("'{}' is not a compression", settings.compression), "--compression",
                         fmt::format("choose from {}", fmt::join(names, ", ")));
    }
    if (settings.format != ImageFormat::png) return;
    if (settings.aov_z || settings.aov_n) {
        throw UsageError("PNG holds no extra channels", "--aov", "write .exr");
    }
    if (settings.depth == Depth::single_float) {
        throw UsageError("PNG holds 8 bits a channel", "--depth", "write .exr");
    }
    if (settings.compression != "zip") {
        throw UsageError("PNG is always compressed with zip", "--compression", "leave it out, or write .exr");
    }
}

}  // namespace gridreel::sequences
