#include "engine/see_through.h"

#include "engine/base_color.h"
#include "traversal/ray_batch.h"

namespace gridreel::engine {
namespace {

enum class Meeting { stops, passes, meets_back };

Meeting meeting(const PosedScene& scene, std::uint32_t triangle, const Ray& ray, RayKind kind) {
    const anim::Material& material = scene.material_of(triangle);
    const bool culls = kind == RayKind::camera && !material.double_sided;
    const bool cut_out = material.alpha_mode == anim::AlphaMode::mask;
    if (!culls && !cut_out) return Meeting::stops;

    const HitPoint point = hit_point(scene.geometry, triangle, ray);
    if (culls && point.side == Side::back) return Meeting::meets_back;
    if (!cut_out) return Meeting::stops;
    const float alpha = base_color(scene, {.triangle = triangle, .point = point}).w;
    return alpha < material.alpha_cutoff ? Meeting::passes : Meeting::stops;
}

}  // namespace

std::uint32_t stopping_triangle(const PosedScene& scene, std::uint32_t triangle, const Ray& ray,
                                RayKind kind) {
    switch (meeting(scene, triangle, ray, kind)) {
        case Meeting::stops:
            return triangle;
        case Meeting::passes:
            return traversal::no_triangle;
        case Meeting::meets_back:
            break;
    }
    const std::uint32_t twin = scene.twins.twin_of(scene.geometry, triangle);
    if (twin == traversal::no_triangle || meeting(scene, twin, ray, kind) != Meeting::stops) {
        return traversal::no_triangle;
    }
    return twin;
}

}  // namespace gridreel::engine
