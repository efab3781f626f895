#pragma once
// How far single precision can be trusted.

namespace gridreel::traversal {

/// Eight roundings of a float, relative to the largest term. Bounds over many rays are widened by it, so that
/// culling never drops what a ray would hit; `EdgeFunctions::error` says what it means for an edge.
inline constexpr float rounding_margin = 0x1p-21f;

/// A hit's depth may be off by this part of itself, more rightly 1e-5: worse ones are computed in double
/// precision. A walk goes on so much past its nearest hit, since a hit that belongs to a later cell may round
/// to a nearer depth.
inline constexpr double depth_error = 0x1p-13;

}  // namespace gridreel::traversal
