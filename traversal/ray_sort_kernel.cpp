#include "traversal/ray_sort_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "traversal/ray_sort_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "traversal/framed_lanes-inl.h"
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

/// Bits of x at the even places, for x below 2^16.
template <class V>
HWY_INLINE V spread_bits(UintTag du, V x) {
    x = hn::And(hn::Or(x, hn::ShiftLeft<8>(x)), hn::Set(du, 0x00ff00ffu));
    x = hn::And(hn::Or(x, hn::ShiftLeft<4>(x)), hn::Set(du, 0x0f0f0f0fu));
    x = hn::And(hn::Or(x, hn::ShiftLeft<2>(x)), hn::Set(du, 0x33333333u));
    return hn::And(hn::Or(x, hn::ShiftLeft<1>(x)), hn::Set(du, 0x55555555u));
}

void make_keys(const KeyMap& map, const FramedRay* framed, const std::uint32_t* faces, std::size_t begin,
               std::size_t end, std::uint64_t* keys) {
    const LaneTag d;
    const UintTag du;
    const hn::RebindToSigned<LaneTag> di;
    const Lanes last = hn::Set(d, static_cast<float>(map.last));
    HWY_ALIGN std::uint32_t key[group];
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
        const Lanes scale = hn::GatherIndex(d, map.scale.data(), face);
        const auto place = [&](Lanes slope, const float* low) {
            const Lanes at = hn::Mul(hn::Sub(slope, hn::GatherIndex(d, low, face)), scale);
            // The order of operands lets a NaN of a ray that hits nothing become a number.
            const Lanes held = hn::Min(hn::Max(at, hn::Zero(d)), last);
            return spread_bits(du, hn::BitCast(du, hn::ConvertTo(di, held)));
        };
        const auto code = hn::Or(hn::ShiftLeft<1>(place(v, map.low_v.data())), place(u, map.low_u.data()));
        hn::Store(hn::Or(code, hn::GatherIndex(du, map.first.data(), face)), du, key);
        for (std::size_t lane = 0; lane < count; ++lane) {
            keys[i + lane] = std::uint64_t{key[lane]} << 32 | (i + lane);
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
