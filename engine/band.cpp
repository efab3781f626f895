#include "engine/band.h"

#include "engine/brdf.h"
#include "engine/compact.h"
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
    const glm::vec3 mirror = glm::reflect(-view, surface.normal);
    const glm::vec3 specular = ambient_specular(surface.reflectance, glm::dot(surface.normal, view));
    // A rough highlight gathers from as wide around as diffuse light does.
    const glm::vec3 gathered =
        glm::mix(dome.radiance(mirror), dome.diffuse(surface.normal), surface.reflectance.alpha);
    return surface.emission +
           (glm::vec3(1.0f) - specular) * surface.reflectance.diffuse * dome.diffuse(surface.normal) +
           specular * gathered;
}

bool reaches(const Arrival& arrival, const Surface& surface) {
    return arrival.distance > 0.0f && arrival.irradiance != glm::vec3(0.0f) &&
           glm::dot(arrival.to_light, surface.normal) > 0.0f;
}

}  // namespace

BandReport Band::render(const Frame& frame, std::span<const Pixel> pixels, Film& film) {
    BandReport report;

    const Stopwatch making_rays;
    make_camera_rays(frame, pixels);
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

void Band::make_camera_rays(const Frame& frame, std::span<const Pixel> pixels) {
    const View& view = frame.view;
    const auto samples = static_cast<std::size_t>(frame.pattern.samples);
    const bool pinhole = view.kind == anim::Camera::Kind::perspective;
    camera_rays_.resize(pixels.size() * samples, pinhole ? std::optional(glm::vec3(view.eye)) : std::nullopt,
                        traversal::RayOrder::coherent);

    tbb::parallel_for(std::size_t{0}, pixels.size(), [&](std::size_t p) {
        const Pixel pixel = pixels[p];
        for (std::size_t s = 0; s < samples; ++s) {
            const std::size_t ray = p * samples + s;
            const glm::dvec2 place =
                glm::dvec2(pixel.x, pixel.y) +
                glm::dvec2(frame.pattern.place(pixel.x, pixel.y, static_cast<std::uint32_t>(s)));
            if (!pinhole) camera_rays_.set_origin(ray, view.ray_origin(place));
            camera_rays_.set_direction(ray, view.ray_direction(place));
            camera_rays_.t_min[ray] = static_cast<float>(view.near_m);
            camera_rays_.t_max[ray] = static_cast<float>(view.far_m);
        }
    });
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
        lit_[i] = hits_.triangle[i] != traversal::no_triangle &&
                  reaches(arrival_at(light, surfaces_[i].position), surfaces_[i]);
    });
    compact(lit_, sample_of_);
}

void Band::make_shadow_rays(const PosedLight& light) {
    // A light with a place is the common origin of its shadow rays, which the tracer sorts into packets.
    const bool from_light = light.kind != anim::Light::Kind::directional;
    shadow_rays_.resize(sample_of_.size(), from_light ? std::optional(light.position) : std::nullopt,
                        traversal::RayOrder::arbitrary);
    tbb::parallel_for(std::size_t{0}, sample_of_.size(), [&](std::size_t i) {
        const Surface& surface = surfaces_[sample_of_[i]];
        shadow_rays_.t_min[i] = 0.0f;
        const Arrival arrival = arrival_at(light, surface.position);
        const float cosine = glm::dot(arrival.to_light, surface.geometric_normal);
        const ShadowEnd end = shadow_end(surface, from_light ? arrival.distance : 0.0f, cosine);
        if (from_light) {
            shadow_rays_.set_direction(i, end.point - light.position);
            shadow_rays_.t_max[i] = 1.0f - end.gap;
        } else {
            shadow_rays_.set_origin(i, end.point);
            shadow_rays_.set_direction(i, arrival.to_light);
            shadow_rays_.t_max[i] = std::numeric_limits<float>::infinity();
        }
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
