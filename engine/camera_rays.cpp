#include "engine/camera_rays.h"

#include <oneapi/tbb/parallel_for.h>

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>

namespace gridreel::engine {

void make_camera_rays(const View& view, const SamplePattern& pattern, std::span<const Pixel> pixels,
                      traversal::RayBatch& rays) {
    const auto samples = static_cast<std::size_t>(pattern.samples);
    const bool pinhole = view.kind == anim::Camera::Kind::perspective;
    const std::size_t count = pixels.size() * samples;
    if (pinhole) {
        rays.resize(count, glm::vec3(view.eye), traversal::RayOrder::coherent);
    } else {
        rays.resize_parallel(count, glm::vec3(view.forward), traversal::RayOrder::coherent);
    }

    tbb::parallel_for(std::size_t{0}, pixels.size(), [&](std::size_t p) {
        const Pixel pixel = pixels[p];
        for (std::size_t s = 0; s < samples; ++s) {
            const std::size_t ray = p * samples + s;
            const glm::dvec2 place =
                glm::dvec2(pixel.x, pixel.y) +
                glm::dvec2(pattern.place(pixel.x, pixel.y, static_cast<std::uint32_t>(s)));
            if (pinhole) {
                rays.set_direction(ray, view.ray_direction(place));
            } else {
                rays.set_origin(ray, view.ray_origin(place));
            }
            rays.t_min[ray] = static_cast<float>(view.near_m);
            rays.t_max[ray] = static_cast<float>(view.far_m);
        }
    });
}

}  // namespace gridreel::engine
