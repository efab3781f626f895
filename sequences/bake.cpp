#include "sequences/bake.h"

#include "anim/frame_geometry.h"
#include "anim/load.h"
#include "anim/pose.h"
#include "sequences/errors.h"
#include "sequences/ply.h"
#include "sequences/render_camera.h"
#include "sequences/whole_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace gridreel::sequences {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Json to_json(const engine::View& view, Frame frame, double time_s) {
    const bool perspective = view.kind == anim::Camera::Kind::perspective;
    Json json{{"frame", frame},
              {"time_s", time_s},
              {"kind", perspective ? "perspective" : "orthographic"},
              {"eye", to_json(view.eye)},
              {"forward", to_json(view.forward)},
              {"up", to_json(view.up)}};
    if (perspective) {
        json["fov_y_rad"] = 2.0 * std::atan(view.half_height);
    } else {
        json["half_height_m"] = view.half_height;
    }
    json["aspect"] = view.half_width / view.half_height;
    return json;
}

void check_bake(const BakeJob& job) {
    if (job.output.extension() != ".ply") {
        throw UsageError("meshes are written as PLY", "--output", "end the file name in .ply");
    }
    check_numbered(job.take, job.output);
}

}  // namespace

std::filesystem::path camera_file(const BakeJob& job) {
    return job.output.folder() / (job.take.scene_file.stem().string() + ".cameras.json");
}

BakeResult bake(const BakeJob& job, const BakeReports& reports, const std::atomic<bool>& stop) {
    check_bake(job);
    const anim::Scene scene = anim::load(job.take.scene_file);
    for (const anim::Warning& warning : scene.warnings) {
        reports.warning(fmt::format("{}: {}", warning.where, warning.text));
    }
    const anim::Clip clip = choose_clip(scene, job.take);
    const std::vector<Frame> frames = choose_frames(job.take, clip, job.output);
    const RenderCamera camera(scene, clip, job.camera, job.width, job.height);
    make_folder(job.output.folder());

    BakeResult result;
    result.cameras = camera_file(job);
    Json views = Json::array();
    anim::FrameGeometry geometry = anim::lay_out(scene, clip);
    for (const Frame frame : frames) {
        result.interrupted = stop.load();
        if (result.interrupted) break;

        const double time_s = job.take.rate.time_of(frame);
        const anim::Pose pose = anim::pose(scene, clip, time_s);
        anim::deform(scene, pose, geometry);
        const std::filesystem::path file = job.output.path(frame);
        write_ply(geometry.positions,
                  job.normals ? std::span<const glm::vec3>(geometry.normals) : std::span<const glm::vec3>(),
                  geometry.triangles, file);
        views.push_back(to_json(camera.view(pose), frame, time_s));
        ++result.frames;
        reports.frame_done(frame, file, result.frames, frames.size());
    }
    const Json cameras{
        {"schema", "gridreel.cameras/1"}, {"camera", camera.name()}, {"frames", std::move(views)}};
    write_whole_file(result.cameras, cameras.dump(1, ' ', false, Json::error_handler_t::replace) + '\n');
    return result;
}

}  // namespace gridreel::sequences
