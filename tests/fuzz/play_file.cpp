#include "tests/fuzz/play_file.h"

#include "anim/clip.h"
#include "anim/error.h"
#include "anim/frame_geometry.h"
#include "anim/frame_size.h"
#include "anim/load.h"
#include "anim/variants.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace gridreel::test {
namespace {

/// Broken here means broken in anim: bytes cannot excuse it.
void require(bool holds, const std::string& promise) {
    if (!holds) throw std::logic_error("a promise of anim is broken: " + promise);
}

void check_frame(const anim::FrameGeometry& frame) {
    const std::size_t vertices = frame.positions.size();
    for (const glm::uvec3& triangle : frame.triangles)
        require(std::max({triangle.x, triangle.y, triangle.z}) < vertices, "triangles name vertices");
    require(frame.triangle_part.size() == frame.triangles.size(), "every triangle has a part");
    for (const std::uint32_t part : frame.triangle_part)
        require(part < frame.parts.size(), "triangles name parts");
}

Played play_clip(const anim::Scene& scene, const anim::Clip& clip) {
    // What a frame may ask for takes too long to fill many times a second.
    constexpr double most_bytes = 8.0 * 1024.0 * 1024.0;
    if (anim::measure_frame(scene, clip).bytes > most_bytes) return Played::too_large;

    anim::FrameGeometry frame = anim::lay_out(scene, clip);
    for (const double time_s : {0.0, 0.4 * clip.duration_s, clip.duration_s, -1.0}) {
        anim::deform(scene, anim::pose(scene, clip, time_s), frame);
        check_frame(frame);
    }
    return Played::whole;
}

void check_message(const Error& error) {
    require(error.where().find("fuzz.glb") != std::string::npos, "errors name the file");
    require(!error.remedy().empty(), std::string("errors name a remedy: ") + error.what());
}

}  // namespace

Played play_file(std::span<const std::byte> bytes, const std::filesystem::path& empty_folder) {
    anim::Scene scene;
    try {
        scene = anim::load_bytes(bytes, empty_folder / "fuzz.glb");
    } catch (const Error& error) {
        check_message(error);
        return Played::refused;
    }

    Played played = Played::whole;
    constexpr std::size_t most_scenes = 4;
    for (anim::Index i = 0; i < std::min(scene.scenes.size(), most_scenes); ++i)
        played = std::min(played, play_clip(scene, anim::choose_clip(scene, "auto", i)));
    return played;
}

}  // namespace gridreel::test
