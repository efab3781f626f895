#include "traversal/ray_sort_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "traversal/ray_sort_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "traversal/framed_lanes-inl.h"
#include "traversal/hilbert_curve.h"
#include "traversal/lanes-inl.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

static_assert(rays_per_step % group == 0 && group <= rebuild::Buffer<float>::padding);

/// One value per ray's face, which most often is the same for all: gathering is slow.
HWY_INLINE Lanes of_faces(const std::array<float, face_count + 1>& values,
                          hn::Vec<hn::RebindToSigned<LaneTag>> faces) {
    const LaneTag d;
    const hn::RebindToSigned<LaneTag> di;
    const auto first = hn::GetLane(faces);
    return HWY_LIKELY(hn::AllTrue(di, hn::Eq(faces, hn::Set(di, first))))
               ? hn::Set(d, values[static_cast<std::size_t>(first)])
               : hn::GatherIndex(d, values.data(), faces);
}

std::size_t frame_and_key(const RayBatch& rays, std::size_t begin, std::size_t end,
                          const OcclusionBatch* only, const KeyMap& map, FramedRay* framed,
                          std::uint64_t* keys) {
    const LaneTag d;
    const hn::RebindToSigned<LaneTag> di;
    const Lanes last = hn::Set(d, RayKey::last_cell);
    HWY_ALIGN std::int32_t face[group], x[group], y[group];
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
        const std::size_t last_lane = std::min(hn::Lanes(d), end - i);
        const auto is_wanted = [&](std::size_t lane) {
            return only == nullptr || (*only)[i + lane] == undecided;
        };
        if (only != nullptr) {
            const hn::Rebind<std::uint8_t, LaneTag> du8;
            const auto marks = hn::LoadU(du8, only->data() + i);
            if (hn::AllFalse(du8, hn::Eq(marks, hn::Set(du8, undecided)))) continue;
        }
        const auto read = [&](const rebuild::Buffer<float>& values) {
            return hn::Load(d, values.data() + i);
        };
        const FramedLanes ray = frame_lanes(read(rays.direction[0]), read(rays.direction[1]),
                                            read(rays.direction[2]), read(rays.t_min), read(rays.t_max));
        hn::StoreInterleaved4(ray.slope_u, ray.slope_v, ray.depth_min, ray.depth_max, d, &framed[i].slope_u);

        const auto faces = hn::ConvertTo(di, ray.face);
        const Lanes scale = of_faces(map.scale, faces);
        const auto cell = [&](Lanes slope, const std::array<float, face_count + 1>& low) {
            const Lanes along = hn::Mul(hn::Sub(slope, of_faces(low, faces)), scale);
            // The order of operands lets a NaN of a ray that hits nothing become a number.
            return hn::ConvertTo(di, hn::Min(hn::Max(along, hn::Zero(d)), last));
        };
        hn::Store(cell(ray.slope_u, map.low_u), di, x);
        hn::Store(cell(ray.slope_v, map.low_v), di, y);
        hn::Store(faces, di, face);
        for (std::size_t lane = 0; lane < last_lane; ++lane) {
            if (!is_wanted(lane)) continue;
            const auto bits = [lane](const std::int32_t* lanes) {
                return static_cast<std::uint32_t>(lanes[lane]);
            };
            const std::uint32_t place = hilbert_index<RayKey::slope_bits>(bits(x), bits(y));
            keys[count++] = (std::uint64_t{bits(face)} << RayKey::place_bits | place)
                                << RayKey::position_bits |
                            (i + lane);
        }
    }
    return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gridreel::traversal {

HWY_EXPORT(frame_and_key);

std::size_t frame_and_key(const RayBatch& rays, std::size_t begin, std::size_t end,
                          const OcclusionBatch* only, const KeyMap& map, FramedRay* framed,
                          std::uint64_t* keys) {
    return HWY_DYNAMIC_DISPATCH(frame_and_key)(rays, begin, end, only, map, framed, keys);
}

}  // namespace gridreel::traversal
#endif
