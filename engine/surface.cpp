#include "engine/surface.h"

#include "engine/base_color.h"
#include "engine/ray_offset.h"
#include "traversal/rounding.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace gridreel::engine {
namespace {

/// Vertex normals on the side of `geometric_normal`'s viewer; nothing usable: that normal itself.
std::array<glm::vec3, 3> vertex_normals(const anim::FrameGeometry& geometry, const glm::uvec3& triangle,
                                        Side side, const glm::vec3& geometric_normal) {
    std::array<glm::vec3, 3> normals;
    for (int corner = 0; corner < 3; ++corner) {
        const glm::vec3& normal = geometry.normals[triangle[corner]];
        const bool usable = glm::dot(normal, normal) > 0.0f;
        normals[static_cast<std::size_t>(corner)] = !usable              ? geometric_normal
                                                    : side == Side::back ? -normal
                                                                         : normal;
    }
    return normals;
}

glm::vec3 interpolated_normal(const std::array<glm::vec3, 3>& normals, const glm::vec3& weights,
                              const glm::vec3& geometric_normal) {
    const glm::vec3 sum = weights.x * normals[0] + weights.y * normals[1] + weights.z * normals[2];
    const float length = glm::length(sum);
    return length > 0.0f && std::isfinite(length) ? sum / length : geometric_normal;
}

/// The point pushed out to the curved surface that the vertex normals suggest, so that shadows on coarse
/// meshes end where the shading does (Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, ch. 4).
glm::vec3 pushed_out(const HitPoint& point, const std::array<glm::vec3, 3>& normals) {
    const glm::vec3 position(point.position);
    const glm::vec3 weights(point.weights);
    glm::vec3 push{0.0f};
    for (int corner = 0; corner < 3; ++corner) {
        const auto i = static_cast<std::size_t>(corner);
        const float below = glm::min(0.0f, glm::dot(position - point.corners[i], normals[i]));
        push -= weights[corner] * below * normals[i];
    }
    return position + push;
}

/// Without the texture. Finite, so that black texels stay black.
glm::vec3 emitted(const anim::Material& material) {
    return glm::min(material.emissive * material.emissive_strength,
                    glm::vec3(std::numeric_limits<float>::max()));
}

}  // namespace

SurfaceShape shape_at(const anim::FrameGeometry& geometry, std::uint32_t triangle, const HitPoint& point,
                      const Ray& ray) {
    // Where it is, and which way it faces.
    const double doubled_area = glm::length(point.area_normal);
    const glm::dvec3 facing = point.side == Side::back ? -point.area_normal : point.area_normal;
    const glm::vec3 towards_ray(-glm::normalize(glm::dvec3(ray.direction)));
    SurfaceShape shape{
        .position = glm::vec3(point.position),
        .smooth_position = glm::vec3(point.position),
        .geometric_normal = doubled_area > 0.0 ? glm::vec3(facing / doubled_area) : towards_ray};
    shape.normal = shape.geometric_normal;
    if (geometry.parts[geometry.triangle_part[triangle]].smooth) {
        const auto normals =
            vertex_normals(geometry, geometry.triangles[triangle], point.side, shape.geometric_normal);
        shape.normal = interpolated_normal(normals, glm::vec3(point.weights), shape.geometric_normal);
        shape.smooth_position = pushed_out(point, normals);
    }

    // Size.
    for (const glm::vec3& corner : point.corners) {
        const glm::vec3 reach = glm::abs(corner);
        shape.coordinate = glm::max(shape.coordinate, glm::max(reach.x, glm::max(reach.y, reach.z)));
    }
    const double edges = double(glm::distance(point.corners[0], point.corners[1])) *
                         double(glm::distance(point.corners[0], point.corners[2]));
    shape.slimness = static_cast<float>(edges / doubled_area);
    return shape;
}

Surface surface_at(const PosedScene& scene, std::uint32_t triangle, const HitPoint& point, const Ray& ray,
                   float cone_width) {
    const anim::Material& material = scene.material_of(triangle);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(ray.direction));
    Surface surface{shape_at(scene.geometry, triangle, point, ray)};

    const double cosine = std::abs(glm::dot(glm::dvec3(surface.geometric_normal), direction));
    const TexturedPoint at{.triangle = triangle,
                           .point = point,
                           .width = static_cast<float>(cone_width / glm::max(cosine, 1e-4))};
    if (material.unlit) {
        surface.unlit = true;
        surface.emission = glm::vec3(base_color(scene, at));
        return surface;
    }
    const glm::vec4 metallic_roughness =
        textured(scene, at, material.metallic_roughness_texture, Encoding::linear);
    surface.reflectance = reflectance(glm::clamp(glm::vec3(base_color(scene, at)), 0.0f, 1.0f),
                                      glm::clamp(material.metallic * metallic_roughness.z, 0.0f, 1.0f),
                                      glm::clamp(material.roughness * metallic_roughness.y, 0.0f, 1.0f));
    surface.emission =
        emitted(material) * glm::vec3(textured(scene, at, material.emissive_texture, Encoding::srgb));
    return surface;
}

ShadowEnd shadow_end(const SurfaceShape& surface, float distance, float cosine) {
    const float steepness = std::abs(cosine);
    const float uncertain = glm::min(2.0f * traversal::rounding_margin * surface.slimness / steepness,
                                     static_cast<float>(traversal::depth_error));
    const bool behind = cosine < 0.0f;
    const float lift =
        ray_offset(surface.coordinate, distance) + (behind ? uncertain * distance * steepness : 0.0f);
    return {.point = surface.smooth_position + lift * surface.geometric_normal,
            .gap = behind ? 0.0f : uncertain};
}

}  // namespace gridreel::engine
