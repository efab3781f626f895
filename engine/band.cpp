#include "engine/band.h"

#include "engine/brdf.h"
#include "engine/camera_rays.h"
#include "engine/compact.h"
#include "engine/shadow_rays.h"
#include "engine/stopwatch.h"

#include <oneapi/tbb/parallel_for.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <limits>

namespace gridreel::engine {
namespace {

/// The viewer's direction, bent where needed so that interpolated normals never face away from it.
glm::vec3 viewer_above(const glm::vec3& towards_viewer, const glm::vec3& normal) {
    constexpr float smallest_cosine = 1e-3f;
    const float cosine = glm::dot(towards_viewer, normal);
    if (cosine >= smallest_cosine) return towards_viewer;
    return glm::normalize(towards_viewer + (smallest_cosine - cosine) * normal);
}

/// Light that needs no shadow ray: the surface's own and the dome's.
glm::vec3 unshadowed(const Surface& surface, const Dome& dome, const glm::vec3& view) {
    if (surface.unlit) return surface.emission;
    const glm::vec3 mirror = glm::reflect(-view, surface.normal);
    const glm::vec3 specular = ambient_specular(surface.reflectance, glm::dot(surface.normal, view));
    // A rough highlight gathers from as wide around as diffuse light does.
    const glm::vec3 gathered =
        glm::mix(dome.radiance(mirror), dome.diffuse(surface.normal), surface.reflectance.alpha);
    return surface.emission +
           (glm::vec3(1.0f) - specular) * surface.reflectance.diffuse * dome.diffuse(surface.normal) +
           specular * gathered;
}

}  // namespace

BandReport Band::render(const Frame& frame, std::span<const Pixel> pixels, Film& film) {
    BandReport report;

    const Stopwatch making_rays;
    make_camera_rays(frame.view, frame.pattern, pixels, camera_rays_);
    report.primary_ms += making_rays.ms();

    const TraceCost primary =
        opaque_hits_.closest(frame.tracer, camera_rays_, frame.scene, RayKind::camera, hits_);
    report.primary += primary.report;
    report.primary_ms += primary.ms;

    find_surfaces(frame);
    for (const PosedLight& light : frame.lighting.lights) add_light(frame, light, report);
    resolve(frame, pixels, film);
    return report;
}

void Band::find_surfaces(const Frame& frame) {
    surfaces_.resize(camera_rays_.size());
    radiance_.resize(camera_rays_.size());
    // Samples share a pixel's cone between them.
    const double cone_share = 1.0 / std::sqrt(double(frame.pattern.samples));

    tbb::parallel_for(std::size_t{0}, camera_rays_.size(), [&](std::size_t i) {
        radiance_[i] = glm::vec3(0.0f);
        const std::uint32_t triangle = hits_.triangle[i];
        if (triangle == traversal::no_triangle) return;
        const Ray ray{.origin = camera_rays_.origin_of(i), .direction = camera_rays_.direction_of(i)};
        const HitPoint point = hit_point(frame.scene.geometry, triangle, ray);
        const double cone_width = cone_share * frame.view.pixel_width(frame.view.depth(point.position));
        surfaces_[i] = surface_at(frame.scene, triangle, point, ray, static_cast<float>(cone_width));
        const glm::vec3 view = viewer_above(frame.view.towards_viewer(point.position), surfaces_[i].normal);
        radiance_[i] = unshadowed(surfaces_[i], frame.lighting.dome, view);
    });
}

void Band::add_light(const Frame& frame, const PosedLight& light, BandReport& report) {
    choose_lit(light);

    const Stopwatch making_rays;
    make_shadow_rays(light);
    report.shadow_ms += making_rays.ms();
    find_shadowed(frame, report);

    tbb::parallel_for(std::size_t{0}, sample_of_.size(), [&](std::size_t i) {
        if (occluded_[i] != 0) return;
        const std::size_t sample = sample_of_[i];
        const Surface& surface = surfaces_[sample];
        const Arrival arrival = arrival_at(light, surface.position);
        const glm::vec3 view = viewer_above(frame.view.towards_viewer(surface.position), surface.normal);
        radiance_[sample] += brdf(surface.reflectance, surface.normal, view, arrival.to_light) *
                             arrival.irradiance * glm::dot(surface.normal, arrival.to_light);
    });
}

void Band::choose_lit(const PosedLight& light) {
    lit_.resize(camera_rays_.size());
    tbb::parallel_for(std::size_t{0}, camera_rays_.size(), [&](std::size_t i) {
        lit_[i] = hits_.triangle[i] != traversal::no_triangle && !surfaces_[i].unlit &&
                  may_light(light, surfaces_[i]);
    });
    compact(lit_, sample_of_);
}

void Band::make_shadow_rays(const PosedLight& light) {
    begin_shadow_rays(light, sample_of_.size(), shadow_rays_);
    tbb::parallel_for(std::size_t{0}, sample_of_.size(), [&](std::size_t i) {
        set_shadow_ray(light, surfaces_[sample_of_[i]], i, shadow_rays_);
    });
}

void Band::find_shadowed(const Frame& frame, BandReport& report) {
    if (!frame.cut_outs) {
        const Stopwatch tracing;
        report.shadow += frame.tracer.any_hits(shadow_rays_, occluded_);
        report.shadow_ms += tracing.ms();
        return;
    }
    const TraceCost cost =
        opaque_hits_.closest(frame.tracer, shadow_rays_, frame.scene, RayKind::shadow, shadow_hits_);
    report.shadow += cost.report;
    report.shadow_ms += cost.ms;
    occluded_.resize(shadow_rays_.size());
    tbb::parallel_for(std::size_t{0}, shadow_rays_.size(), [&](std::size_t i) {
        occluded_[i] = shadow_hits_.triangle[i] != traversal::no_triangle;
    });
}

void Band::resolve(const Frame& frame, std::span<const Pixel> pixels, Film& film) const {
    const auto samples = static_cast<std::size_t>(frame.pattern.samples);
    const auto count = static_cast<float>(samples);
    const glm::vec3 behind = glm::vec3(frame.background) * frame.background.w;

    tbb::parallel_for(std::size_t{0}, pixels.size(), [&](std::size_t p) {
        glm::vec3 color{0.0f};
        float alpha = 0.0f;
        double nearest = std::numeric_limits<double>::infinity();
        glm::vec3 normal{0.0f};
        for (std::size_t i = p * samples; i < (p + 1) * samples; ++i) {
            if (hits_.triangle[i] == traversal::no_triangle) {
                color += behind;
                alpha += frame.background.w;
                continue;
            }
            color += radiance_[i];
            alpha += 1.0f;
            const double depth = frame.view.depth(surfaces_[i].position);
            if (depth < nearest) {
                nearest = depth;
                normal = surfaces_[i].normal;
            }
        }
        color *= frame.exposure / count;

        float* const out = film.pixel(pixels[p].x, pixels[p].y);
        out[Film::R] = color.x;
        out[Film::G] = color.y;
        out[Film::B] = color.z;
        out[Film::A] = alpha / count;
        out[Film::Z] = static_cast<float>(nearest);
        out[Film::NX] = normal.x;
        out[Film::NY] = normal.y;
        out[Film::NZ] = normal.z;
    });
}

}  // namespace gridreel::engine
