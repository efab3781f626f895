#include "anim/gltf/validate.h"

#include <fmt/format.h>

namespace gridreel::anim::gltf {
namespace {

void check_camera(const Place& camera) {
    const Place lens = camera.at(camera.at("type").text());
    if (const auto far = lens.find("zfar"); far && far->number() <= lens.at("znear").number())
        far->refuse(fmt::format("the far plane at {} is not beyond the near plane at {}", far->number(),
                                lens.at("znear").number()));
    for (const auto name : {"xmag", "ymag"})
        if (const auto size = lens.find(name); size && size->number() == 0.0)
            size->refuse(fmt::format("\"{}\" is zero: the camera sees nothing", name));
}

void check_light(const Place& light) {
    if (light.at("type").text() != "spot") return;
    const Place spot = light.at("spot");
    constexpr double default_outer = 0.785398163397448;
    const auto inner = spot.find("innerConeAngle"), outer = spot.find("outerConeAngle");
    const double outer_angle = outer ? outer->number() : default_outer;
    // The extension asks for less; equal angles are a hard edge, which exporters do write.
    if (inner && inner->number() > outer_angle)
        inner->refuse(fmt::format("the inner cone of {} is wider than the outer one of {}", inner->number(),
                                  outer_angle));
}

}  // namespace

void validate_cameras_and_lights(const Place& root) {
    const auto cameras = root.find("cameras");
    for (std::size_t i = 0; cameras && i < cameras->size(); ++i) check_camera((*cameras)[i]);

    const auto punctual = root.find_extension("KHR_lights_punctual");
    if (!punctual) return;
    const Place lights = punctual->at("lights");
    for (std::size_t i = 0; i < lights.size(); ++i) check_light(lights[i]);
}

}  // namespace gridreel::anim::gltf
