#pragma once
// Bringing rays that start together and point alike next to each other.

#include "rebuild/buffer.h"
#include "traversal/ray_batch.h"
#include "traversal/ray_frame.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gridreel::traversal {

/// What packets need of a ray whose frame's axes are known: 16 bytes, so that rays read in any order cost one
/// cache line each. Fields as in `RayFrame`.
struct alignas(16) FramedRay {
    float slope_u, slope_v, depth_min, depth_max;
};

/// A ray, or four that follow each other in the batch and point alike: sorted as one, and read as one cache
/// line. Most rays come in fours, since a batch follows the picture.
class RayRun {
public:
    static constexpr std::size_t longest = 4;

    RayRun() = default;
    RayRun(std::uint32_t first, bool four) : bits_(first | (four ? four_mark : 0)) {}
    explicit RayRun(std::uint32_t bits) : bits_(bits) {}

    [[nodiscard]] std::uint32_t first() const { return bits_ & ~four_mark; }
    [[nodiscard]] std::uint32_t count() const { return (bits_ & four_mark) != 0 ? 4 : 1; }
    [[nodiscard]] std::uint32_t bits() const { return bits_; }

private:
    static constexpr std::uint32_t four_mark = 1u << 31;  // batches are smaller by far
    std::uint32_t bits_;
};

/// The rays of a batch with a common origin, by dominant axis and along Hilbert's curve through their slopes
/// within it.
struct SortedRays {
    rebuild::Buffer<FramedRay> framed;  ///< one per ray, in the batch's order
    rebuild::Buffer<RayRun> order;      ///< face after face, then the dead, which are in no run of four
    /// Where each face's runs begin in `order`; the last entry is where the rays that hit nothing begin.
    std::array<std::size_t, face_count + 1> face_begin{};
};

/// Where a run belongs: its face, then its place along the curve. Runs are scattered by the upper bits of the
/// place, in parallel; what shares them is sorted in cache, bucket by bucket.
struct RayKey {
    static constexpr unsigned slope_bits = 12;              ///< of each slope
    static constexpr unsigned place_bits = 2 * slope_bits;  ///< along the curve
    static constexpr unsigned bucket_bits = 10;             ///< of the place
    static constexpr unsigned low_bits = place_bits - bucket_bits;
    static constexpr std::size_t bucket_count = (face_count + 1) << bucket_bits;  ///< the last for the dead
};

/// Sorts batch after batch in the same memory. Parallel; the same order for any number of threads (ties keep
/// the batch's order).
class RaySort {
public:
    /// @return valid until the next call
    const SortedRays& sort(const RayBatch& rays);

private:
    /// A part of the batch, of which one thread makes the keys.
    struct Chunk {
        std::size_t begin = 0, end = 0;  ///< rays; its keys begin there, too
        std::size_t run_count = 0;
        std::array<std::uint32_t, RayKey::bucket_count> next;  ///< runs of each bucket, then where one goes
    };

    void cut_chunks(std::size_t ray_count);
    void make_keys(const RayBatch& rays);
    void scatter();
    void sort_buckets();

    SortedRays sorted_;
    std::vector<Chunk> chunks_;
    std::array<std::uint32_t, RayKey::bucket_count + 1> bucket_begin_{};
    rebuild::Buffer<std::uint64_t> keys_;        ///< key << 32 | run, in the batch's order
    rebuild::Buffer<std::uint64_t> in_buckets_;  ///< the same, bucket after bucket
};

}  // namespace gridreel::traversal
