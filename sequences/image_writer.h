#pragma once
// Pictures into files.

#include "sequences/image_settings.h"
#include "sequences/picture.h"

#include <filesystem>

namespace gridreel::sequences {

/// Writes `picture` to `file`, which appears whole or not at all and replaces what was there.
/// The bytes depend on picture and settings only: they hold no clock, host or path.
///
/// @param settings  checked; the same that `picture` was stored with
/// @throws OutputError naming the file
void write_image(const Picture& picture, const ImageSettings& settings, const std::filesystem::path& file);

/// How many threads image files are compressed with, for the whole process.
/// @param threads  >= 1; 1: only the calling one
void limit_image_threads(int threads);

}  // namespace gridreel::sequences
