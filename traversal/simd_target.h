#pragma once
// Which SIMD instructions the kernels use.

#include <string_view>
#include <vector>

namespace gridreel::traversal {

/// Instruction sets that this program has kernels for and this machine can run, best first: names such as
/// "AVX3", "AVX2", "SSE4", "SSSE3", "NEON".
[[nodiscard]] std::vector<std::string_view> simd_targets();

/// What the kernels use now: the best, unless limited.
[[nodiscard]] std::string_view simd_target();

/// Makes the kernels of the whole process use no more than `name` (any case; "avx512" means "AVX3",
/// an empty name lifts the limit). Not while something is being traced.
///
/// Pixels are the same bit for bit on every target with fused multiply-add (AVX2 and up); SSE4 and SSSE3,
/// the same among themselves, differ from those by rounding.
///
/// @return false, and nothing changed, when there is no such target here
bool limit_simd_target(std::string_view name);

}  // namespace gridreel::traversal
