#include "engine/shadow_rays.h"

#include <glm/geometric.hpp>

#include <limits>

namespace gridreel::engine {
namespace {

bool has_place(const PosedLight& light) {
    return light.kind != anim::Light::Kind::directional;
}

}  // namespace

bool may_light(const PosedLight& light, const SurfaceShape& surface) {
    const Arrival arrival = arrival_at(light, surface.position);
    return arrival.distance > 0.0f && arrival.irradiance != glm::vec3(0.0f) &&
           glm::dot(arrival.to_light, surface.normal) > 0.0f;
}

void begin_shadow_rays(const PosedLight& light, std::size_t count, traversal::RayBatch& rays) {
    if (has_place(light)) {
        rays.resize(count, light.position, traversal::RayOrder::arbitrary);
    } else {
        rays.resize_parallel(count, -light.direction, traversal::RayOrder::arbitrary);
    }
}

void set_shadow_ray(const PosedLight& light, const SurfaceShape& surface, std::size_t index,
                    traversal::RayBatch& rays) {
    const bool from_light = has_place(light);
    const Arrival arrival = arrival_at(light, surface.position);
    const float cosine = glm::dot(arrival.to_light, surface.geometric_normal);
    const ShadowEnd end = shadow_end(surface, from_light ? arrival.distance : 0.0f, cosine);
    rays.t_min[index] = 0.0f;
    if (from_light) {
        rays.set_direction(index, end.point - light.position);
        rays.t_max[index] = 1.0f - end.gap;
    } else {
        rays.set_origin(index, end.point);
        rays.t_max[index] = std::numeric_limits<float>::infinity();
    }
}

}  // namespace gridreel::engine
