#pragma once
// How far off a surface a shadow ray must keep so that rounding cannot make the surface shadow itself.

#include <limits>

namespace gridreel::engine {

/// Distance along the geometric normal, metres.
///
/// What a tracer works with is wrong by a few roundings: of the hit point and the triangle's corners (half
/// an ulp of their coordinates each), of corners taken relative to the ray's origin, and of the ray's
/// direction (half an ulp of the distance each). Each moves a point against the triangle's plane by at most
/// eps/2 * sqrt(3) * magnitude; nine such terms stay below 8 eps * magnitude.
///
/// @param coordinate  largest absolute coordinate of the triangle's corners, metres
/// @param distance    from the point to the far end of the ray, metres; 0 for a ray without one
[[nodiscard]] constexpr float ray_offset(float coordinate, float distance) {
    return 8.0f * std::numeric_limits<float>::epsilon() * (coordinate + distance);
}

}  // namespace gridreel::engine
