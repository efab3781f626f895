#pragma once
// Rays that go on behind a triangle they have met.

#include "rebuild/buffer.h"
#include "rebuild/triangle_view.h"
#include "traversal/ray_batch.h"
#include "traversal/ray_frame.h"

#include <cstddef>

namespace gridreel::traversal {

/// Frames of a batch's rays, each beginning where `RayBatch::after_triangle` says. Keeps its memory from
/// batch to batch.
class ResumedRays {
public:
    /// Finds again where each ray met the triangle it goes on behind: the same bits as when it was hit.
    void begin(const RayBatch& rays, const rebuild::TriangleView& triangles);

    /// `ray_frame` of the batch last begun.
    [[nodiscard]] RayFrame frame(const RayBatch& rays, std::size_t ray) const {
        RayFrame frame = ray_frame(rays, ray);
        if (!rays.after_triangle.empty()) {
            frame.depth_min = depths_[ray];
            frame.after = rays.after_triangle[ray];
        }
        return frame;
    }

private:
    rebuild::Buffer<float> depths_;
};

}  // namespace gridreel::traversal
