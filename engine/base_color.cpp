#include "engine/base_color.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>

namespace gridreel::engine {
namespace {

/// Width in texture coordinates of something `at.width` metres wide: the square root of the ratio between
/// the triangle's area in the texture and in the world.
float footprint(const PosedScene& scene, const TexturedPoint& at, const anim::TextureRef& ref) {
    const double area = glm::length(at.point.area_normal);
    const auto& texcoords = scene.geometry.texcoords[ref.texcoord];
    if (!(at.width > 0.0f) || !(area > 0.0) || texcoords.empty()) return 0.0f;
    const glm::uvec3 vertices = scene.geometry.triangles[at.triangle];
    const glm::vec2 ab = texcoords[vertices.y] - texcoords[vertices.x];
    const glm::vec2 ac = texcoords[vertices.z] - texcoords[vertices.x];
    const double texture_area = std::abs(double(ab.x) * double(ac.y) - double(ab.y) * double(ac.x));
    const double enlarged = std::abs(double(ref.transform.scale.x) * double(ref.transform.scale.y));
    return at.width * static_cast<float>(std::sqrt(texture_area * enlarged / area));
}

}  // namespace

glm::vec4 textured(const PosedScene& scene, const TexturedPoint& at,
                   const std::optional<anim::TextureRef>& ref, Encoding encoding) {
    if (!ref) return glm::vec4(1.0f);
    const glm::vec2 texcoord = texcoord_at(scene.geometry, at.triangle, at.point, ref->texcoord);
    return scene.textures.sample(ref, encoding, ref->transform.apply(texcoord), footprint(scene, at, *ref));
}

glm::vec4 base_color(const PosedScene& scene, const TexturedPoint& at) {
    const anim::Material& material = scene.material_of(at.triangle);
    return material.base_color * color_at(scene.geometry, at.triangle, at.point) *
           textured(scene, at, material.base_color_texture, Encoding::srgb);
}

}  // namespace gridreel::engine
