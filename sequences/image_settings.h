#pragma once
// How frames are stored: file format, channels, depth, compression.

#include <string>
#include <string_view>
#include <vector>

namespace gridreel::sequences {

enum class ImageFormat { exr, png };
enum class Depth { half_float, single_float };  ///< of colour and normals in EXR; Z is always single

struct ImageSettings {
    ImageFormat format = ImageFormat::exr;
    Depth depth = Depth::half_float;
    std::string compression = "zip";  ///< one of `compressions()`; PNG has only zip
    bool aov_z = false;               ///< channel Z; EXR only
    bool aov_n = false;               ///< channels N.X N.Y N.Z; EXR only
};

/// The format of a file name's extension (".exr", ".png", in lower case).
/// @throws UsageError listing the formats
[[nodiscard]] ImageFormat image_format(std::string_view extension);

/// Lossless ones only: the log promises that the pixels it hashed are those in the file.
[[nodiscard]] const std::vector<std::string>& compressions();

/// Sets `aov_z` and `aov_n` from a comma-separated list of `z` and `n`, or `all`.
/// @throws UsageError listing the names
void choose_aovs(std::string_view list, ImageSettings& settings);

/// @throws UsageError when the format cannot hold what is asked for
void check(const ImageSettings& settings);

}  // namespace gridreel::sequences
