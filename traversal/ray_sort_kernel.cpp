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

using UintTag = hn::RebindToUnsigned<LaneTag>;

/// Bounds of one face, a lane for every lane of rays.
struct LaneBounds {
    HWY_ALIGN float low_u[group], high_u[group], low_v[group], high_v[group];

    LaneBounds() {
        std::fill_n(low_u, group, 2.0f);
        std::fill_n(low_v, group, 2.0f);
        std::fill_n(high_u, group, -2.0f);
        std::fill_n(high_v, group, -2.0f);
    }

    HWY_INLINE void extend(hn::Mask<LaneTag> which, Lanes u, Lanes v) {
        const LaneTag d;
        const Lanes none = hn::Set(d, 2.0f);
        hn::Store(hn::Min(hn::Load(d, low_u), hn::IfThenElse(which, u, none)), d, low_u);
        hn::Store(hn::Min(hn::Load(d, low_v), hn::IfThenElse(which, v, none)), d, low_v);
        hn::Store(hn::Max(hn::Load(d, high_u), hn::IfThenElse(which, u, hn::Neg(none))), d, high_u);
        hn::Store(hn::Max(hn::Load(d, high_v), hn::IfThenElse(which, v, hn::Neg(none))), d, high_v);
    }

    [[nodiscard]] SlopeBounds across() const {
        return {.low_u = *std::min_element(low_u, low_u + group),
                .high_u = *std::max_element(high_u, high_u + group),
                .low_v = *std::min_element(low_v, low_v + group),
                .high_v = *std::max_element(high_v, high_v + group)};
    }
};

FaceBounds frame_rays(const RayBatch& rays, std::size_t begin, std::size_t end, FramedRay* framed,
                      std::uint32_t* faces) {
    const LaneTag d;
    const UintTag du;
    std::array<LaneBounds, face_count> bounds;
    std::size_t i = begin;
    for (; i + hn::Lanes(d) <= end; i += hn::Lanes(d)) {
        const auto read = [&](const rebuild::Buffer<float>& values) {
            return hn::LoadU(d, values.data() + i);
        };
        const FramedLanes ray = frame_lanes(read(rays.direction[0]), read(rays.direction[1]),
                                            read(rays.direction[2]), read(rays.t_min), read(rays.t_max));
        hn::StoreInterleaved4(ray.slope_u, ray.slope_v, ray.depth_min, ray.depth_max, d, &framed[i].slope_u);
        hn::StoreU(hn::BitCast(du, hn::ConvertTo(hn::RebindToSigned<LaneTag>(), ray.face)), du, faces + i);
        const std::uint32_t first = faces[i];
        const auto alike = hn::Eq(ray.face, hn::Set(d, static_cast<float>(first)));
        if (HWY_LIKELY(hn::AllTrue(d, alike))) {
            if (first < face_count) bounds[first].extend(alike, ray.slope_u, ray.slope_v);
            continue;
        }
        for (std::uint32_t f = 0; f < face_count; ++f) {
            bounds[f].extend(hn::Eq(ray.face, hn::Set(d, static_cast<float>(f))), ray.slope_u, ray.slope_v);
        }
    }
    FaceBounds result;
    for (std::size_t face = 0; face < face_count; ++face) result[face] = bounds[face].across();
    for (; i < end; ++i) {
        const RayFrame ray = ray_frame(rays, i);
        framed[i] = {ray.slope_u, ray.slope_v, ray.depth_min, ray.depth_max};
        faces[i] = ray.hits_nothing() ? face_count : ray.axes.face();
        if (faces[i] == face_count) continue;
        result[faces[i]].extend({ray.slope_u, ray.slope_u, ray.slope_v, ray.slope_v});
    }
    return result;
}

void make_keys(const KeyMap& map, const FramedRay* framed, const std::uint32_t* faces, std::size_t begin,
               std::size_t end, std::uint64_t* keys) {
    const LaneTag d;
    const UintTag du;
    const hn::RebindToSigned<LaneTag> di;
    const Lanes last = hn::Set(d, static_cast<float>(hilbert_side - 1));
    HWY_ALIGN std::uint32_t x[group], y[group], first[group];
    for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
        const std::size_t count = std::min(hn::Lanes(d), end - i);
        HWY_ALIGN FramedRay rest[group] = {};
        HWY_ALIGN std::uint32_t rest_faces[group] = {};
        const bool whole = count == hn::Lanes(d);
        if (!whole) {
            std::copy_n(framed + i, count, rest);
            std::copy_n(faces + i, count, rest_faces);
        }
        Lanes u, v, depth_min, depth_max;
        hn::LoadInterleaved4(d, whole ? &framed[i].slope_u : &rest[0].slope_u, u, v, depth_min, depth_max);
        const auto face = hn::BitCast(di, hn::LoadU(du, whole ? faces + i : rest_faces));
        const auto first_face = hn::GetLane(face);
        const bool alike = hn::AllTrue(di, hn::Eq(face, hn::Set(di, first_face)));
        const auto of_face = [&](auto tag, const auto& values) {  // gathering is slow
            return HWY_LIKELY(alike) ? hn::Set(tag, values[static_cast<std::size_t>(first_face)])
                                     : hn::GatherIndex(tag, values.data(), face);
        };
        const Lanes scale = of_face(d, map.scale);
        const auto place = [&](Lanes slope, const auto& low) {
            const Lanes at = hn::Mul(hn::Sub(slope, of_face(d, low)), scale);
            // The order of operands lets a NaN of a ray that hits nothing become a number.
            const Lanes held = hn::Min(hn::Max(at, hn::Zero(d)), last);
            return hn::BitCast(du, hn::ConvertTo(di, held));
        };
        hn::Store(place(u, map.low_u), du, x);
        hn::Store(place(v, map.low_v), du, y);
        hn::Store(of_face(du, map.first), du, first);
        for (std::size_t lane = 0; lane < count; ++lane) {
            const std::uint32_t key = first[lane] + hilbert_place(x[lane], y[lane]);
            keys[i + lane] = std::uint64_t{key} << 32 | (i + lane);
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gridreel::traversal {

HWY_EXPORT(frame_rays);
HWY_EXPORT(make_keys);

void SlopeBounds::extend(const SlopeBounds& other) {
    low_u = std::min(low_u, other.low_u);
    high_u = std::max(high_u, other.high_u);
    low_v = std::min(low_v, other.low_v);
    high_v = std::max(high_v, other.high_v);
}

FaceBounds frame_rays(const RayBatch& rays, std::size_t begin, std::size_t end, FramedRay* framed,
                      std::uint32_t* faces) {
    return HWY_DYNAMIC_DISPATCH(frame_rays)(rays, begin, end, framed, faces);
}

void make_keys(const KeyMap& map, const FramedRay* framed, const std::uint32_t* faces, std::size_t begin,
               std::size_t end, std::uint64_t* keys) {
    HWY_DYNAMIC_DISPATCH(make_keys)(map, framed, faces, begin, end, keys);
}

}  // namespace gridreel::traversal
#endif
