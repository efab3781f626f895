#pragma once
// Bringing rays next to each other that start together and point alike, or that are parallel and near.

#include "rebuild/buffer.h"
#include "traversal/ray_batch.h"
#include "traversal/ray_frame.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gridreel::traversal {

/// What packets need of a ray whose frame's axes are known: 16 bytes, so that rays read in any order cost one
/// cache line each. Fields as in `RayFrame`.
struct alignas(16) FramedRay {
    float slope_u, slope_v, depth_min, depth_max;
};

/// The rays of a batch with a common origin, by dominant axis and along Hilbert's curve through their slopes
/// within it; or those of a batch with a common direction, along the curve through where they cross a plane.
struct SortedRays {
    rebuild::Buffer<FramedRay> framed;     ///< one per ray of the batch, in its order; none of parallel rays
    rebuild::Buffer<std::uint32_t> order;  ///< positions in the batch: face after face, then the dead
    /// Where each face's rays begin in `order`; the last entry is where the rays that hit nothing begin.
    std::array<std::size_t, face_count + 1> face_begin{};
};

/// How keys are laid out: face, place along the curve, position in the batch. Rays are scattered by the face
/// and the upper bits of the place, in parallel; what shares those is sorted in cache, bucket by bucket.
struct RayKey {
    static constexpr unsigned slope_bits = 16;                       ///< of each slope
    static constexpr unsigned place_bits = 2 * slope_bits;           ///< along the curve
    static constexpr unsigned bucket_bits = 10;                      ///< upper bits of the place
    static constexpr unsigned rest_bits = place_bits - bucket_bits;  ///< sorted within a bucket
    static constexpr unsigned position_bits = 29;                    ///< in the batch
    static constexpr std::uint64_t position_mask = (std::uint64_t{1} << position_bits) - 1;
    /// The dead count as a face of their own.
    static constexpr std::size_t bucket_count = (face_count + 1) << bucket_bits;
    static constexpr float last_cell = float((1u << slope_bits) - 1);

    [[nodiscard]] static std::size_t bucket(std::uint64_t key) { return key >> (position_bits + rest_bits); }
};

/// Sorts batch after batch in the same memory. Parallel; the same order for any number of threads (ties keep
/// the batch's order).
class RaySort {
public:
    /// @return valid until the next call
    /// @throws std::length_error for 2^29 rays or more
    const SortedRays& sort(const RayBatch& rays) { return sort(rays, nullptr); }
    /// Only the rays that are `undecided`.
    const SortedRays& sort_undecided(const RayBatch& rays, const OcclusionBatch& of) {
        return sort(rays, &of);
    }

private:
    using Histogram = std::array<std::uint32_t, RayKey::bucket_count>;

    const SortedRays& sort(const RayBatch& rays, const OcclusionBatch* only);
    void key_and_count(const RayBatch& rays, const OcclusionBatch* only);
    void scatter();
    void sort_buckets();
    [[nodiscard]] std::size_t chunk_begin(std::size_t chunk) const;
    [[nodiscard]] std::span<const std::uint64_t> keys_of(std::size_t chunk) const;

    SortedRays sorted_;
    /// Some rays of the batch.
    struct Chunk {
        std::size_t key_count;
        Histogram next;  ///< keys in each bucket, then where its next one goes
    };
    std::vector<Chunk> chunks_;
    std::array<std::uint32_t, RayKey::bucket_count + 1> bucket_begin_{};
    rebuild::Buffer<std::uint64_t> keys_;        ///< in the batch's order, each chunk's from its begin on
    rebuild::Buffer<std::uint64_t> in_buckets_;  ///< the same, bucket after bucket
};

}  // namespace gridreel::traversal
