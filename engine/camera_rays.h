#pragma once
// The first wave of a frame: rays from the camera through the samples of a run of pixels.

#include "engine/camera.h"
#include "engine/pixel_order.h"
#include "engine/sample_pattern.h"
#include "traversal/ray_batch.h"

#include <span>

namespace gridreel::engine {

/// One ray per sample: pixel after pixel, the samples of a pixel side by side. A perspective camera's rays
/// have their eye in common, an orthographic one's their direction. t is the depth along the view axis,
/// metres.
///
/// @param pixels  a run of `pixel_order`
/// @param rays    resized
void make_camera_rays(const View& view, const SamplePattern& pattern, std::span<const Pixel> pixels,
                      traversal::RayBatch& rays);

}  // namespace gridreel::engine
