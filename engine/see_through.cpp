#include "engine/see_through.h"

#include "engine/base_color.h"

namespace gridreel::engine {

bool stops_at(const PosedScene& scene, std::uint32_t triangle, const Ray& ray, RayKind kind) {
    const anim::Material& material = scene.material_of(triangle);
    const bool culls = kind == RayKind::camera && !material.double_sided;
    const bool cut_out = material.alpha_mode == anim::AlphaMode::mask;
    if (!culls && !cut_out) return true;

    const HitPoint point = hit_point(scene.geometry, triangle, ray);
    if (culls && point.side == Side::back) return false;
    if (!cut_out) return true;
    const float alpha = base_color(scene, {.triangle = triangle, .point = point}).w;
    return alpha >= material.alpha_cutoff;
}

}  // namespace gridreel::engine
