#include "traversal/resumed_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "traversal/resumed_rays.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "traversal/lane_ray-inl.h"

#include <limits>

#if HWY_ONCE
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#endif

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

void meet_again(const RayBatch& rays, const rebuild::TriangleView& triangles, std::size_t begin,
                std::size_t end, float* depths) {
    for (std::size_t i = begin; i < end; ++i) {
        const LaneRay ray(rays.origin_of(i), ray_frame(rays.direction_of(i), 0.0f, rays.t_max[i]));
        float met[LaneRay::width];
        ray.meet_triangles(triangles, &rays.after_triangle[i], 1, std::numeric_limits<float>::infinity(),
                           met);
        depths[i] = met[0];
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gridreel::traversal {

HWY_EXPORT(meet_again);

void ResumedRays::begin(const RayBatch& rays, const rebuild::TriangleView& triangles) {
    if (rays.after_triangle.empty()) return;
    depths_.resize(rays.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), 1024), [&](const auto& range) {
        HWY_DYNAMIC_DISPATCH(meet_again)(rays, triangles, range.begin(), range.end(), depths_.data());
    });
}

}  // namespace gridreel::traversal
#endif
