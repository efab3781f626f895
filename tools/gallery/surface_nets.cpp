#include "tools/gallery/surface_nets.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gridreel::gallery {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

glm::dvec3 gradient(const Solid& solid, const glm::dvec3& p, double step) {
    glm::dvec3 slope;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 offset(0.0);
        offset[axis] = step;
        slope[axis] = solid.distance(p + offset) - solid.distance(p - offset);
    }
    return slope / (2.0 * step);
}

/// The grid of corners, and which of its blocks may hold the surface.
class Grid {
public:
    Grid(const Solid& solid, double cell_m)
        : solid_(solid), cell_(cell_m), origin_(solid.low - 1.5 * cell_m) {
        size_ = glm::ivec3(glm::ceil((solid.high - origin_) / cell_m)) + 2;
        blocks_ = (size_ + block - 1) / block;
        block_sign_.resize(std::size_t(blocks_.x) * std::size_t(blocks_.y) * std::size_t(blocks_.z));

        // A block is near when the surface may pass between its corners or their next neighbours.
        const double reach = (0.5 * block + 1.0) * 1.7320508 * cell_m;
        std::size_t next = 0;
        for (int z = 0; z < blocks_.z; ++z)
            for (int y = 0; y < blocks_.y; ++y)
                for (int x = 0; x < blocks_.x; ++x) {
                    const double d =
                        solid_.distance(point(glm::dvec3(x, y, z) * double(block) + 0.5 * block));
                    block_sign_[next++] = static_cast<std::int16_t>(d > reach ? 1 : d < -reach ? -1 : 0);
                }
    }

    [[nodiscard]] glm::ivec3 size() const { return size_; }
    [[nodiscard]] glm::dvec3 point(const glm::dvec3& corner) const { return origin_ + cell_ * corner; }

    /// Distances at the corners of slice z; only their sign counts far from the surface.
    void fill_slice(int z, std::vector<double>& distances) const {
        distances.resize(std::size_t(size_.x) * std::size_t(size_.y));
        tbb::parallel_for(0, size_.y, [&](int y) {
            for (int x = 0; x < size_.x; ++x) {
                const glm::ivec3 b = glm::ivec3(x, y, z) / block;
                const std::size_t index =
                    (std::size_t(b.z) * std::size_t(blocks_.y) + std::size_t(b.y)) * std::size_t(blocks_.x) +
                    std::size_t(b.x);
                const int sign = block_sign_[index];
                distances[std::size_t(y) * std::size_t(size_.x) + std::size_t(x)] =
                    sign != 0 ? double(sign) : solid_.distance(point(glm::dvec3(x, y, z)));
            }
        });
    }

private:
    static constexpr int block = 8;

    const Solid& solid_;
    double cell_;
    glm::dvec3 origin_;
    glm::ivec3 size_{0}, blocks_{0};
    std::vector<std::int16_t> block_sign_;  // -1, 0 or 1
};

class Polygoniser {
public:
    Polygoniser(const Solid& solid, double cell_m) : solid_(solid), cell_(cell_m), grid_(solid, cell_m) {
        row_ = std::size_t(grid_.size().x);
        for (auto& layer : vertex_in_cell_) layer.assign(row_ * std::size_t(grid_.size().y), none);
    }

    Shape run() {
        grid_.fill_slice(0, lower_);
        for (int z = 0; z + 1 < grid_.size().z; ++z) {
            grid_.fill_slice(z + 1, upper_);
            add_vertices(z);
            add_quads(z);
            std::swap(lower_, upper_);
            std::swap(vertex_in_cell_[0], vertex_in_cell_[1]);
        }
        settle_vertices();
        return std::move(shape_);
    }

private:
    /// One vertex per crossed cell of layer z: the mean of its edges' crossings.
    void add_vertices(int z) {
        for (int y = 0; y + 1 < grid_.size().y; ++y)
            for (int x = 0; x + 1 < grid_.size().x; ++x) {
                const std::size_t i = std::size_t(y) * row_ + std::size_t(x);
                const std::array<double, 8> d{
                    lower_[i], lower_[i + 1], lower_[i + row_], lower_[i + row_ + 1],
                    upper_[i], upper_[i + 1], upper_[i + row_], upper_[i + row_ + 1]};
                const auto inside = std::ranges::count_if(d, [](double v) { return v < 0.0; });
                vertex_in_cell_[1][i] = none;
                if (inside == 0 || inside == 8) continue;

                glm::dvec3 sum(0.0);
                double crossings = 0.0;
                for (unsigned a = 0; a < 8; ++a)
                    for (unsigned bit = 1; bit < 8; bit *= 2) {
                        const unsigned b = a | bit;
                        if (b == a || (d[a] < 0.0) == (d[b] < 0.0)) continue;
                        const double part = d[a] / (d[a] - d[b]);
                        sum += glm::mix(corner(a), corner(b), part);
                        crossings += 1.0;
                    }
                vertex_in_cell_[1][i] = static_cast<std::uint32_t>(shape_.positions.size());
                shape_.positions.emplace_back(grid_.point(glm::dvec3(x, y, z) + sum / crossings));
            }
    }

    static glm::dvec3 corner(unsigned bits) {
        return {double(bits & 1u), double(bits >> 1 & 1u), double(bits >> 2 & 1u)};
    }

    /// Moves every vertex onto the surface, by Newton steps along the gradient, and finds its normal.
    void settle_vertices() {
        shape_.normals.resize(shape_.positions.size());
        tbb::parallel_for(std::size_t{0}, shape_.positions.size(), [&](std::size_t vertex) {
            glm::dvec3 p(shape_.positions[vertex]);
            const double step = 1e-3 * cell_;
            for (int i = 0; i < 3; ++i) {
                const double distance = solid_.distance(p);
                if (std::abs(distance) < 1e-5 * cell_) break;
                const glm::dvec3 slope = gradient(solid_, p, step);
                const double steepness = glm::dot(slope, slope);
                if (steepness < 1e-6) break;
                const glm::dvec3 move = -(distance / steepness) * slope;
                p += move * std::min(1.0, 0.5 * cell_ / std::max(glm::length(move), 1e-300));
            }
            shape_.positions[vertex] = p;
            shape_.normals[vertex] = glm::normalize(gradient(solid_, p, step));
        });
    }

    /// A quad across each crossed edge whose four cells are in the layers below and at z.
    void add_quads(int z) {
        const auto& below = vertex_in_cell_[0];
        const auto& here = vertex_in_cell_[1];
        for (int y = 1; y + 1 < grid_.size().y; ++y)
            for (int x = 1; x + 1 < grid_.size().x; ++x) {
                const std::size_t i = std::size_t(y) * row_ + std::size_t(x);
                const bool inside = lower_[i] < 0.0;
                if (inside != (upper_[i] < 0.0))
                    add_quad({here[i - row_ - 1], here[i - row_], here[i], here[i - 1]}, inside);
                if (z == 0) continue;
                if (inside != (lower_[i + 1] < 0.0))
                    add_quad({below[i - row_], below[i], here[i], here[i - row_]}, inside);
                if (inside != (lower_[i + row_] < 0.0))
                    add_quad({below[i - 1], here[i - 1], here[i], below[i]}, inside);
            }
    }

    /// Corners counter-clockwise seen from the edge's far end, split along the shorter diagonal.
    void add_quad(std::array<std::uint32_t, 4> q, bool outward) {
        if (!outward) std::swap(q[1], q[3]);
        const auto& p = shape_.positions;
        const glm::vec3 ac = p[q[2]] - p[q[0]], bd = p[q[3]] - p[q[1]];
        if (glm::dot(ac, ac) <= glm::dot(bd, bd)) {
            shape_.triangles.emplace_back(q[0], q[1], q[2]);
            shape_.triangles.emplace_back(q[0], q[2], q[3]);
        } else {
            shape_.triangles.emplace_back(q[0], q[1], q[3]);
            shape_.triangles.emplace_back(q[1], q[2], q[3]);
        }
    }

    const Solid& solid_;
    double cell_;
    Grid grid_;
    std::size_t row_ = 0;
    std::vector<double> lower_, upper_;                         ///< corner slices z and z + 1
    std::array<std::vector<std::uint32_t>, 2> vertex_in_cell_;  ///< cell layers z - 1 and z
    Shape shape_;
};

}  // namespace

Shape polygonise(const Solid& solid, double cell_m) {
    return Polygoniser(solid, cell_m).run();
}

Shape polygonise_to_count(const Solid& solid, std::size_t triangles, double largest_cell_m) {
    // The count goes with the inverse square of the cell: correct a first guess until it fits.
    // Counting on a coarse grid first keeps the large meshes to one or two.
    const double wanted = double(std::max<std::size_t>(triangles, 1));
    const double first_wanted = std::min(wanted, 20'000.0);
    double cell = std::min(largest_cell_m, 3.0 / std::sqrt(first_wanted));
    Shape shape = polygonise(solid, cell);
    for (int attempt = 0; attempt < 8; ++attempt) {
        const double ratio = double(shape.triangles.size()) / wanted;
        if (ratio > 0.99 && ratio < 1.01) break;
        const double next = std::min(largest_cell_m, cell * std::sqrt(ratio));
        if (next == cell) break;
        cell = next;
        shape = polygonise(solid, cell);
    }
    return shape;
}

}  // namespace gridreel::gallery
