#include "sequences/frame_log.h"

#include "sequences/build_info.h"
#include "sequences/errors.h"
#include "sequences/whole_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <utility>

namespace gridreel::sequences {
namespace {

using Json = nlohmann::ordered_json;

std::string_view name_of(engine::LightChoice lights) {
    switch (lights) {
        case engine::LightChoice::automatic:
            return "auto";
        case engine::LightChoice::file:
            return "file";
        case engine::LightChoice::standard:
            return "default";
    }
    return "";
}

/// The number that was written, not the float nearest to it: 0.18 and not 0.18000000715255737.
double as_written(float value) {
    return std::stod(fmt::format("{}", value));
}

/// Names in the file need not be UTF-8; a log must be.
std::string one_line(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json aovs_of(const ImageSettings& image) {
    Json aovs = Json::array();
    if (image.aov_z) aovs.push_back("z");
    if (image.aov_n) aovs.push_back("n");
    return aovs;
}

/// Every option that makes the picture, as in effect, under its long name.
Json options_of(const RunRecord& run) {
    const Job& job = run.job;
    const engine::RenderSettings& render = job.render;
    const auto& background = render.background;
    const auto& resolution = render.tracer.resolution;
    const bool by_cost = render.tracer.lambda == traversal::LambdaRule::by_cost;
    return {{"output", job.output.text()},
            {"frames", to_string(run.frames)},
            {"fps", to_string(job.take.rate)},
            {"animation", job.take.animation},
            {"scene", job.take.scene ? Json(*job.take.scene) : Json()},
            {"asset-root", job.take.asset_root.empty() ? Json() : Json(job.take.asset_root.string())},
            {"variant", job.take.variant.empty() ? Json() : Json(job.take.variant)},
            {"camera", render.camera},
            {"size", {run.width, run.height}},
            {"spp", render.samples},
            {"seed", render.seed},
            {"lights", name_of(render.lights)},
            {"background",
             {as_written(background.r), as_written(background.g), as_written(background.b),
              as_written(background.a)}},
            {"exposure", as_written(render.exposure_stops)},
            {"aov", aovs_of(job.image)},
            {"depth", job.image.depth == Depth::half_float ? "half" : "float"},
            {"compression", job.image.compression},
            {"accel", traversal::name_of(render.tracer.kind)},
            {"lambda", by_cost ? Json("auto") : Json(as_written(resolution.lambda))},
            {"max-cells", resolution.max_cells},
            {"keep-going", job.keep_going}};
}

/// A log that a crash cut off mid-line must not swallow the next line.
bool ends_mid_line(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary | std::ios::ate);
    if (!stream || stream.tellg() <= 0) return false;
    stream.seekg(-1, std::ios::end);
    return stream.get() != '\n';
}

}  // namespace

std::string log_line(const RunRecord& run) {
    return one_line({{"schema", "gridreel.run/1"},
                     {"version", version()},
                     {"compiler", compiler()},
                     {"cpu", cpu_name()},
                     {"instruction_set", run.instruction_set},
                     {"threads", run.job.threads},
                     {"overlapped", {"write"}},  // with the next frame's other phases
                     {"scene", {{"file", run.job.take.scene_file.string()}, {"sha256", run.scene_sha256}}},
                     {"animations", run.animations},
                     {"frames", run.frames.size()},
                     {"options", options_of(run)}});
}

std::string log_line(const FrameRecord& frame) {
    Json line{{"schema", "gridreel.frame/1"}, {"frame", frame.frame}, {"time_s", frame.time_s}};
    if (frame.failed()) {
        line["file"] = frame.file.string();
        line["error"] = frame.error;
        return one_line(line);
    }
    const engine::FrameReport& render = frame.render;
    const rebuild::BuildReport& built = render.rebuild;
    line["triangles"] = {{"moving", render.moving_triangles}, {"still", render.still_triangles}};
    line["grid"] = {{"lambda", as_written(built.lambda)},
                    {"cells", {built.resolution.x, built.resolution.y, built.resolution.z}},
                    {"cells_with_nested", built.cells},
                    {"references", built.references},
                    {"bytes", built.bytes}};
    line["ms"] = {{"animate", render.animate_ms},
                  {"rebuild",
                   {{"bounds", built.bounds_ms},
                    {"count", built.count_ms},
                    {"scan", built.scan_ms},
                    {"scatter", built.scatter_ms},
                    {"total", built.total_ms}}},
                  {"trace", render.trace_ms},
                  {"shade", render.shade_ms},
                  {"write", frame.write_ms},
                  {"total", frame.total_ms()}};
    line["rays"] = {{"primary", render.primary.rays}, {"shadow", render.shadow.rays}, {"secondary", 0}};
    line["steps"] = {{"cells", render.primary.cells + render.shadow.cells},
                     {"tests", render.primary.triangle_tests + render.shadow.triangle_tests}};
    if (render.predicted) {
        line["predicted_ms"] = {{"rebuild", render.predicted->rebuild_ms},
                                {"trace", render.predicted->trace_ms}};
    }
    line["peak_bytes"] = frame.peak_bytes;
    line["file"] = frame.file.string();
    line["pixels_sha256"] = frame.pixels_sha256;
    return one_line(line);
}

FrameLog::FrameLog(std::filesystem::path file) : file_(std::move(file)) {
    make_folder(file_.parent_path());
    const bool broken = ends_mid_line(file_);
    stream_.open(file_, std::ios::binary | std::ios::app);
    if (!stream_) throw OutputError("the log cannot be opened", file_.string(), "choose another with --log");
    if (broken) write("\n");
}

void FrameLog::write(const std::string& text) {
    stream_ << text << std::flush;
    if (!stream_) throw OutputError("the log cannot be written", file_.string(), "check the free space");
}

}  // namespace gridreel::sequences
