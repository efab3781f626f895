#pragma once
// A few vertices as kernels take them: whole registers at once.

#include "anim/vertex_spans.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace gridreel::anim {

/// As many vertices as a register has lanes, to be read here and written there. Null: no such attribute.
struct VertexBlock {
    const glm::vec3* positions = nullptr;
    const glm::vec3* normals = nullptr;
    const glm::vec4* tangents = nullptr;
    glm::vec3* to_positions = nullptr;
    glm::vec3* to_normals = nullptr;
    glm::vec4* to_tangents = nullptr;
};

/// The vertices from `first` on, where they lie.
[[nodiscard]] inline VertexBlock block_at(std::size_t first, const ShapeSpans& from, const VertexSpans& to) {
    VertexBlock block{.positions = &from.positions[first], .to_positions = &to.positions[first]};
    if (!to.normals.empty()) {
        block.normals = &from.normals[first];
        block.to_normals = &to.normals[first];
    }
    if (!to.tangents.empty()) {
        block.tangents = &from.tangents[first];
        block.to_tangents = &to.tangents[first];
    }
    return block;
}

/// The last vertices of a run, too few for a register: a copy, filled up with copies of the last of them, so
/// that nothing behind the run is touched. Neighbouring runs belong to other threads.
class PaddedBlock {
public:
    static constexpr std::size_t most_lanes = 16;

    /// Copies the vertices from `first` on: at least one, fewer than `most_lanes`.
    PaddedBlock(std::size_t first, const ShapeSpans& from, const VertexSpans& to) : first_(first), to_(to) {
        copy(from.positions, positions_);
        if (!to.normals.empty()) copy(from.normals, normals_);
        if (!to.tangents.empty()) copy(from.tangents, tangents_);
    }

    [[nodiscard]] VertexBlock block() {
        const bool smooth = !to_.normals.empty(), has_tangents = !to_.tangents.empty();
        return {.positions = positions_.data(),
                .normals = smooth ? normals_.data() : nullptr,
                .tangents = has_tangents ? tangents_.data() : nullptr,
                .to_positions = positions_.data(),
                .to_normals = smooth ? normals_.data() : nullptr,
                .to_tangents = has_tangents ? tangents_.data() : nullptr};
    }

    /// Moves the block's vertices to their places in the run.
    void write_back() const {
        write(positions_, to_.positions);
        if (!to_.normals.empty()) write(normals_, to_.normals);
        if (!to_.tangents.empty()) write(tangents_, to_.tangents);
    }

private:
    template <class Vector>
    void copy(std::span<const Vector> from, std::array<Vector, most_lanes>& out) const {
        const auto end = std::copy(from.begin() + std::ptrdiff_t(first_), from.end(), out.begin());
        std::fill(end, out.end(), from.back());
    }

    template <class Vector>
    void write(const std::array<Vector, most_lanes>& vectors, std::span<Vector> to) const {
        std::copy_n(vectors.begin(), to.size() - first_, to.begin() + std::ptrdiff_t(first_));
    }

    std::size_t first_;
    VertexSpans to_;
    std::array<glm::vec3, most_lanes> positions_, normals_;
    std::array<glm::vec4, most_lanes> tangents_;
};

}  // namespace gridreel::anim
