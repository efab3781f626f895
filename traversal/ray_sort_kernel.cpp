#include "traversal/ray_sort_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "traversal/ray_sort_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "rebuild/triangle_view.h"
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

/// Where rays stand on the curve's square, before `KeyMap`.
struct CurvePlaces {
    Lanes u, v, face;
};

/// Rays of a pencil at their slopes, framed.
struct PencilPlaces {
    const RayBatch& rays;
    FramedRay* framed;

    HWY_INLINE CurvePlaces at(std::size_t i) const {
        const LaneTag d;
        const auto read = [&](const rebuild::Buffer<float>& values) {
            return hn::Load(d, values.data() + i);
        };
        const FramedLanes ray = frame_lanes(read(rays.direction[0]), read(rays.direction[1]),
                                            read(rays.direction[2]), read(rays.t_min), read(rays.t_max));
        hn::StoreInterleaved4(ray.slope_u, ray.slope_v, ray.depth_min, ray.depth_max, d, &framed[i].slope_u);
        return {ray.slope_u, ray.slope_v, ray.face};
    }
};

/// Parallel rays where they cross the plane through the world's origin.
struct ParallelPlaces {
    const RayBatch& rays;
    RayFrame frame = frame_of_parallel(rays);

    HWY_INLINE CurvePlaces at(std::size_t i) const {
        const LaneTag d;
        const auto read = [&](const rebuild::Buffer<float>& values) {
            return hn::Load(d, values.data() + i);
        };
        const ParallelLanes lanes = parallel_lanes(rays, frame, read);
        const Lanes depth = hn::Mul(lanes.k, hn::Set(d, frame.axes.sign()));
        return {hn::NegMulAdd(hn::Set(d, frame.slope_u), depth, lanes.u),
                hn::NegMulAdd(hn::Set(d, frame.slope_v), depth, lanes.v),
                hn::IfThenElse(lanes.alive, hn::Set(d, static_cast<float>(frame.axes.face())),
                               hn::Set(d, static_cast<float>(face_count)))};
    }
};

template <class Places>
std::size_t make_keys(const Places& places, std::size_t begin, std::size_t end, const OcclusionBatch* only,
                      const KeyMap& map, std::uint64_t* keys) {
    const LaneTag d;
    const hn::RebindToSigned<LaneTag> di;
    const hn::RebindToUnsigned<LaneTag> du;
    const Lanes last = hn::Set(d, RayKey::last_cell);
    HWY_ALIGN std::uint32_t face[group], x[group], y[group], place[group];
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; i += group) {
        const auto is_wanted = [&](std::size_t lane) {
            return only == nullptr || (*only)[i + lane] == undecided;
        };
        if (only != nullptr) {
            const hn::CappedTag<std::uint8_t, group> du8;
            const auto marks = hn::LoadU(du8, only->data() + i);
            if (hn::AllFalse(du8, hn::Eq(marks, hn::Set(du8, undecided)))) continue;
        }
        for (std::size_t first = 0; first < group; first += hn::Lanes(d)) {
            const CurvePlaces at = places.at(i + first);
            const auto faces = hn::ConvertTo(di, at.face);
            const Lanes scale = of_faces(map.scale, faces);
            const auto cell = [&](Lanes where, const std::array<float, face_count + 1>& low) {
                const Lanes along = hn::Mul(hn::Sub(where, of_faces(low, faces)), scale);
                // The order of operands lets a NaN of a ray that hits nothing become a number.
                return hn::ConvertTo(di, hn::Min(hn::Max(along, hn::Zero(d)), last));
            };
            hn::Store(hn::BitCast(du, cell(at.u, map.low_u)), du, x + first);
            hn::Store(hn::BitCast(du, cell(at.v, map.low_v)), du, y + first);
            hn::Store(hn::BitCast(du, faces), du, face + first);
        }
        for (std::size_t lane = 0; lane < group; ++lane) {
            place[lane] = hilbert_index<RayKey::slope_bits>(x[lane], y[lane]);
        }
        const std::size_t last_lane = std::min(group, end - i);
        for (std::size_t lane = 0; lane < last_lane; ++lane) {
            keys[count] = (std::uint64_t{face[lane]} << RayKey::place_bits | place[lane])
                              << RayKey::position_bits |
                          (i + lane);
            count += is_wanted(lane) ? 1 : 0;
        }
    }
    return count;
}

std::size_t frame_and_key(const RayBatch& rays, std::size_t begin, std::size_t end,
                          const OcclusionBatch* only, const KeyMap& map, FramedRay* framed,
                          std::uint64_t* keys) {
    return rays.common_direction
               ? make_keys(ParallelPlaces{.rays = rays}, begin, end, only, map, keys)
               : make_keys(PencilPlaces{.rays = rays, .framed = framed}, begin, end, only, map, keys);
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
