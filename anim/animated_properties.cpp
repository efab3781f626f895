#include "anim/animated_properties.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gridreel::anim {
namespace {

constexpr float smallest = std::numeric_limits<float>::min();  // for what must be above zero
constexpr float quarter_turn = std::numbers::pi_v<float> / 2.0f;

// --- Cameras -----------------------------------------------------------------------------------

double above_zero(const float* value) {
    return double(std::max(value[0], smallest));
}

/// Half a picture, which may be mirrored but not empty.
double not_zero(const float* value) {
    return value[0] == 0.0f ? double(smallest) : double(value[0]);
}

/// Without aspectRatio and xmag: all pictures of a sequence have one shape.
const AnimatedProperty<Camera> of_cameras[] = {
    {"perspective/yfov", 1,
     [](Camera& camera, const float* value) {
         camera.fov_y_rad = std::clamp(double(value[0]), 1e-6, std::numbers::pi - 1e-6);
     }},
    {"perspective/znear", 1, [](Camera& camera, const float* value) { camera.near_m = above_zero(value); }},
    {"perspective/zfar", 1, [](Camera& camera, const float* value) { camera.far_m = above_zero(value); }},
    {"orthographic/ymag", 1, [](Camera& camera, const float* value) { camera.y_mag = not_zero(value); }},
    {"orthographic/znear", 1,
     [](Camera& camera, const float* value) { camera.near_m = std::max(0.0, double(value[0])); }},
    {"orthographic/zfar", 1, [](Camera& camera, const float* value) { camera.far_m = above_zero(value); }},
};

// --- Lights ------------------------------------------------------------------------------------

/// Components that are not negative.
glm::vec3 color(const float* value) {
    return glm::max(glm::vec3(glm::make_vec3(value)), glm::vec3(0.0f));
}

float not_negative(const float* value) {
    return std::max(value[0], 0.0f);
}

const AnimatedProperty<Light> of_lights[] = {
    {"color", 3, [](Light& light, const float* value) { light.color = color(value); }},
    {"intensity", 1, [](Light& light, const float* value) { light.intensity = not_negative(value); }},
    {"range", 1, [](Light& light, const float* value) { light.range_m = std::max(value[0], smallest); }},
    {"spot/innerConeAngle", 1,
     [](Light& light, const float* value) {
         light.inner_cone_rad = std::clamp(value[0], 0.0f, quarter_turn);
     }},
    {"spot/outerConeAngle", 1,
     [](Light& light, const float* value) {
         light.outer_cone_rad = std::clamp(value[0], smallest, quarter_turn);
     }},
};

}  // namespace

std::span<const AnimatedProperty<Camera>> camera_properties() {
    return of_cameras;
}

std::span<const AnimatedProperty<Light>> light_properties() {
    return of_lights;
}

}  // namespace gridreel::anim
