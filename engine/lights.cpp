#include "engine/lights.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace gridreel::engine {
namespace {

/// The falloff over distance, 1/m^2.
float distance_factor(const PosedLight& light, float distance) {
    if (light.falloff == Falloff::none) return 1.0f;
    const float inverse_square = 1.0f / (distance * distance);
    if (!light.range_m) return inverse_square;
    const float share = distance / *light.range_m;
    const float squared = share * share;
    return glm::clamp(1.0f - squared * squared, 0.0f, 1.0f) * inverse_square;
}

float cone_factor(const PosedLight& light, const glm::vec3& to_light) {
    if (light.kind != anim::Light::Kind::spot) return 1.0f;
    const float ramp =
        glm::clamp(-glm::dot(light.direction, to_light) * light.cone_scale + light.cone_offset, 0.0f, 1.0f);
    return ramp * ramp;
}

}  // namespace

std::optional<PosedLight> posed_light(const anim::Light& light, const glm::dmat4& world) {
    PosedLight posed{.kind = light.kind,
                     .intensity = glm::min(light.color * light.intensity, std::numeric_limits<float>::max()),
                     .position = glm::vec3(world[3]),
                     .range_m = light.range_m};
    if (light.kind != anim::Light::Kind::point) {
        const glm::dvec3 axis = -glm::dvec3(world[2]);
        const double length = glm::length(axis);
        if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
        posed.direction = glm::vec3(axis / length);
    }
    if (light.kind == anim::Light::Kind::spot) {
        const float cos_outer = std::cos(light.outer_cone_rad);
        posed.cone_scale = 1.0f / glm::max(0.001f, std::cos(light.inner_cone_rad) - cos_outer);
        posed.cone_offset = -cos_outer * posed.cone_scale;
    }
    return posed;
}

Arrival arrival_at(const PosedLight& light, const glm::vec3& point) {
    if (light.kind == anim::Light::Kind::directional) {
        return {.to_light = -light.direction,
                .distance = std::numeric_limits<float>::infinity(),
                .irradiance = light.intensity};
    }
    const glm::vec3 way = light.position - point;
    const float distance = glm::length(way);
    if (!(distance > 0.0f)) return {};  // a point in the light itself has no direction to it
    const glm::vec3 to_light = way / distance;
    return {
        .to_light = to_light,
        .distance = distance,
        .irradiance = light.intensity * (distance_factor(light, distance) * cone_factor(light, to_light))};
}

glm::vec3 Dome::radiance(const glm::vec3& direction) const {
    return glm::mix(ground, sky, 0.5f + 0.5f * direction.y);
}

glm::vec3 Dome::diffuse(const glm::vec3& normal) const {
    // The cosine-weighted mean of a + b y over the hemisphere about n is a + 2/3 b n.y.
    return glm::mix(ground, sky, 0.5f + normal.y / 3.0f);
}

}  // namespace gridreel::engine
