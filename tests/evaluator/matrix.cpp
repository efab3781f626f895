#include "matrix.h"

#include <cmath>
#include <cstddef>

namespace gridreel::evaluator {

Matrix operator*(const Matrix& a, const Matrix& b) {
    Matrix product{};
    for (std::size_t column = 0; column < 4; ++column) {
        for (std::size_t row = 0; row < 4; ++row) {
            for (std::size_t k = 0; k < 4; ++k)
                product[4 * column + row] += a[4 * k + row] * b[4 * column + k];
        }
    }
    return product;
}

Matrix compose(const Vec3& translation, const Vec4& rotation, const Vec3& scale) {
    const auto [qx, qy, qz, qw] = rotation;
    const double length = std::sqrt(qx * qx + qy * qy + qz * qz + qw * qw);
    const double x = qx / length, y = qy / length, z = qz / length, w = qw / length;
    const Matrix turn{1 - 2 * (y * y + z * z),
                      2 * (x * y + z * w),
                      2 * (x * z - y * w),
                      0,  //
                      2 * (x * y - z * w),
                      1 - 2 * (x * x + z * z),
                      2 * (y * z + x * w),
                      0,  //
                      2 * (x * z + y * w),
                      2 * (y * z - x * w),
                      1 - 2 * (x * x + y * y),
                      0,  //
                      0,
                      0,
                      0,
                      1};
    Matrix move = identity, stretch = identity;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        move[12 + axis] = translation[axis];
        stretch[5 * axis] = scale[axis];
    }
    return move * turn * stretch;
}

Vec3 transform_point(const Matrix& m, std::span<const double> p) {
    Vec3 moved{};
    for (std::size_t row = 0; row < 3; ++row)
        moved[row] = m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row];
    return moved;
}

std::array<double, 9> normal_matrix(const Matrix& m) {
    // inverse(A)^T = cofactors(A) / det(A); the column i of the cofactors is the cross product of the
    // other two columns of A.
    std::array<double, 9> cofactors{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double* const a = m.data() + 4 * ((i + 1) % 3);
        const double* const b = m.data() + 4 * ((i + 2) % 3);
        for (std::size_t row = 0; row < 3; ++row) {
            const std::size_t y = (row + 1) % 3, z = (row + 2) % 3;
            cofactors[3 * i + row] = a[y] * b[z] - a[z] * b[y];
        }
    }
    const double determinant = m[0] * cofactors[0] + m[1] * cofactors[1] + m[2] * cofactors[2];
    if (determinant < 0)
        for (double& cofactor : cofactors) cofactor = -cofactor;
    return cofactors;
}

Vec3 transform_normal(const std::array<double, 9>& m, std::span<const double> n) {
    Vec3 turned{};
    for (std::size_t row = 0; row < 3; ++row)
        turned[row] = m[row] * n[0] + m[3 + row] * n[1] + m[6 + row] * n[2];
    const double length = std::hypot(turned[0], turned[1], turned[2]);
    if (length > 0)
        for (double& coordinate : turned) coordinate /= length;
    return turned;
}

}  // namespace gridreel::evaluator
