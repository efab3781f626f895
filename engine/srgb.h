#pragma once
// The sRGB transfer curve, both ways.

namespace gridreel::engine {

/// Linear light from an sRGB-encoded value, both in [0, 1] (IEC 61966-2-1).
/// Values outside are continued by the same curve; negative ones by its linear foot.
[[nodiscard]] float linear_from_srgb(float encoded);

/// The inverse of `linear_from_srgb`.
[[nodiscard]] float srgb_from_linear(float linear);

}  // namespace gridreel::engine
