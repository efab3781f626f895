#include "sequences/bake.h"

#include "anim/frame_geometry.h"
#include "anim/load.h"
#include "anim/pose.h"
#include "engine/render_camera.h"
#include "sequences/camera_file.h"
#include "sequences/errors.h"
#include "sequences/fingerprint.h"
#include "sequences/ply.h"
#include "sequences/whole_file.h"

#include <fmt/format.h>

#include <span>
#include <string>
#include <vector>

namespace gridreel::sequences {
namespace {

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
    const anim::Scene scene = load_scene(job.take).scene;
    for (const anim::Warning& warning : scene.warnings) {
        reports.warning(describe(warning));
    }
    const anim::Clip clip = choose_clip(scene, job.take);
    const std::vector<Frame> frames = choose_frames(job.take, scene, clip, job.output);
    check_camera(scene, clip, job.camera);
    const engine::RenderCamera camera(scene, clip, job.camera, job.width, job.height);
    make_folder(job.output.folder());

    BakeResult result;
    result.cameras = camera_file(job);
    std::vector<BakedView> views;
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
        views.push_back({.frame = frame, .time_s = time_s, .view = camera.view(pose)});
        ++result.frames;
        reports.frame_done(frame, file, result.frames, frames.size());
    }
    const CameraFileHead head{.camera = std::string(camera.name()),
                              .aspect = camera.aspect(),
                              .scene_sha256 = scene_sha256(job.take.scene_file, job.take.asset_root),
                              .scene = clip.scene,
                              .animations = clip.animations,
                              .rate = job.take.rate};
    const std::string dropped = write_camera_file(result.cameras, head, views);
    if (!dropped.empty()) reports.note(dropped);
    return result;
}

}  // namespace gridreel::sequences
