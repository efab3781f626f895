#pragma once
// Ray against triangle where single precision cannot tell inside from outside.

#include <optional>

namespace gridreel::traversal {

/// A point relative to the ray's origin, in the order K, U, V of the ray's frame.
struct FramedPoint {
    float k = 0.0f, u = 0.0f, v = 0.0f;
};

/// Decides in double precision whether a ray passes inside the triangle, edges and corners included.
///
/// The edge functions change sign exactly when the edge's ends change places, as those of the float kernel
/// do, and err by some 2^-52 of distance times edge, far less than those: around a vertex that a ray hits
/// squarely, one triangle always feels responsible (compare Woop, Benthin & Wald 2013, section 3.2).
///
/// @param sign  1 or -1: the ray's direction along K
/// @return depth along K, or nothing; a triangle seen edge-on is never hit
[[nodiscard]] std::optional<float> meet_in_double(const FramedPoint& a, const FramedPoint& b,
                                                  const FramedPoint& c, float sign, float slope_u,
                                                  float slope_v);

}  // namespace gridreel::traversal
