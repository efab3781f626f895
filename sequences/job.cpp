#include "sequences/job.h"

#include <string>

namespace gridreel::sequences {

FramePattern default_output(const std::filesystem::path& scene_file, std::string_view extension) {
    return FramePattern::numbered("frames", scene_file.stem().string(), extension);
}

std::filesystem::path default_log(const FramePattern& output, const std::filesystem::path& scene_file) {
    const std::string stem = output.stem();
    return output.folder() / ((stem.empty() ? scene_file.stem().string() : stem) + ".jsonl");
}

}  // namespace gridreel::sequences
