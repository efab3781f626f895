#include "sequences/camera_file.h"

#include "sequences/whole_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>

namespace gridreel::sequences {
namespace {

using Json = nlohmann::ordered_json;
using Frames = std::map<Frame, Json>;

constexpr std::string_view schema = "gridreel.cameras/1";

Json to_json(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Json to_json(const BakedView& baked) {
    const engine::View& view = baked.view;
    const bool perspective = view.kind == anim::Camera::Kind::perspective;
    Json json{{"frame", baked.frame},
              {"time_s", baked.time_s},
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

Json to_json(const CameraFileHead& head) {
    return {{"schema", schema},     {"camera", head.camera},         {"scene_sha256", head.scene_sha256},
            {"scene", head.scene},  {"animations", head.animations}, {"fps", to_string(head.rate)},
            {"aspect", head.aspect}};
}

/// Null for what cannot be read or is not JSON.
Json read_json(const std::filesystem::path& file) {
    // Opening a pipe would wait for somebody to write into it.
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return nullptr;
    std::ifstream stream(file, std::ios::binary);
    Json json = Json::parse(stream, nullptr, false);
    return json.is_discarded() ? Json() : json;
}

/// What stood in the file: frames of the same bake, or why there are none to keep.
struct Earlier {
    Frames frames;
    std::string dropped;
};

Earlier drop(std::string_view reason) {
    return {.frames = {}, .dropped = std::string(reason)};
}

Earlier read_earlier(const std::filesystem::path& file, const Json& head) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return {};
    Json json = read_json(file);
    if (!json.is_object() || json.value("schema", Json()) != schema) return drop("it is no camera file");
    for (const auto& [key, value] : head.items()) {
        if (json.value(key, Json()) != value) return drop(fmt::format("it is of another bake (\"{}\")", key));
    }

    Earlier earlier;
    for (Json& frame : json["frames"]) {
        const Json number = frame.is_object() ? frame.value("frame", Json()) : Json();
        if (!number.is_number_integer()) return drop("its frames are damaged");
        earlier.frames.insert_or_assign(number.get<Frame>(), std::move(frame));
    }
    return earlier;
}

}  // namespace

std::string write_camera_file(const std::filesystem::path& file, const CameraFileHead& head,
                              std::span<const BakedView> views) {
    // As the file will have it: names that are not UTF-8 are mended on the way.
    constexpr auto mend = Json::error_handler_t::replace;
    Json json = Json::parse(to_json(head).dump(-1, ' ', false, mend));

    Earlier earlier = read_earlier(file, json);
    for (const BakedView& view : views) earlier.frames.insert_or_assign(view.frame, to_json(view));

    Json frames = Json::array();
    for (auto& [number, frame] : earlier.frames) frames.push_back(std::move(frame));
    json["frames"] = std::move(frames);
    write_whole_file(file, json.dump(1, ' ', false, mend) + '\n');
    if (earlier.dropped.empty()) return {};
    return fmt::format("{} is written anew: {}", file.string(), earlier.dropped);
}

}  // namespace gridreel::sequences
