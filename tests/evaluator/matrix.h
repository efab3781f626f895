#pragma once
// The little linear algebra that glTF needs, in double precision.

#include <array>
#include <span>

namespace gridreel::evaluator {

using Vec3 = std::array<double, 3>;
using Vec4 = std::array<double, 4>;     ///< of quaternions: x, y, z, w
using Matrix = std::array<double, 16>;  ///< column-major, as in the file

inline constexpr Matrix identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

[[nodiscard]] Matrix operator*(const Matrix& a, const Matrix& b);

/// T * R * S (glTF 2.0, section 3.5.3).
/// @param rotation  a quaternion of any length but 0: only its direction counts
[[nodiscard]] Matrix compose(const Vec3& translation, const Vec4& rotation, const Vec3& scale);

[[nodiscard]] Vec3 transform_point(const Matrix& matrix, std::span<const double> point);

/// What makes normals of points that `matrix` moves: the inverse transpose of its upper left 3x3, times the
/// absolute value of the determinant, so that it exists for every matrix. Column-major.
[[nodiscard]] std::array<double, 9> normal_matrix(const Matrix& matrix);

/// Unit length, or zero where there is no direction.
[[nodiscard]] Vec3 transform_normal(const std::array<double, 9>& matrix, std::span<const double> normal);

}  // namespace gridreel::evaluator
