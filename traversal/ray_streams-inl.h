// Rays that walk through a grid side by side, each on its own way. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_RAY_STREAMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_RAY_STREAMS_INL_H_
#undef GRIDREEL_TRAVERSAL_RAY_STREAMS_INL_H_
#else
#define GRIDREEL_TRAVERSAL_RAY_STREAMS_INL_H_
#endif

#include "traversal/cell_pieces-inl.h"
#include "traversal/ray_walk.h"
#include "traversal/reference_boxes.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One value for each stream.
inline constexpr std::size_t stream_count = 32;
template <class T>
using PerStream = std::array<T, stream_count>;

/// Where streams are in their grids, in units of cells, and how they go on: depths are along each ray's K
/// axis. Everything is in double, so that walks err far less than the slack with which triangles are listed.
struct alignas(64) StreamPlaces {
    PerStream<double> cell[3];     ///< on x, y, z; whole
    PerStream<double> origin[3];   ///< of the ray
    PerStream<double> slope[3];    ///< cells per depth; never 0
    PerStream<double> inverse[3];  ///< depth per cell
    PerStream<double> last[3];     ///< cells on the axis, less 1
    PerStream<double> row, layer;  ///< cells from one to the next on y, on z
    PerStream<double> first;       ///< of the grid's cells in `CellDistances`
    PerStream<double> depth;       ///< where the stream entered the cell
    PerStream<double> end;         ///< where it leaves the grid, or needs no more cells
    PerStream<double> ahead;       ///< steps to the next cell that may hold anything, at least 1
};

/// Walks streams as one, in SIMD lanes.
class StreamWalk {
    using Depth = hn::CappedTag<double, 8>;
    using V = hn::Vec<Depth>;
    using M = hn::Mask<Depth>;

public:
    /// Streams at occupied cells, and streams that are at their end, a bit each.
    struct Stops {
        unsigned occupied = 0, ended = 0;
    };

    /// Takes every stream in `alive` to its next occupied cell or end, but for a few stragglers: they go on
    /// the next time.
    /// @param fresh      those of them that look into the cell where they are before they step
    /// @param distances  `CellDistances::data`
    /// @param cells      is added the number of cells looked at
    static HWY_INLINE Stops walk(StreamPlaces& at, unsigned alive, unsigned fresh,
                                 const std::uint8_t* distances, std::uint64_t& cells) {
        Stops stops;
        unsigned going = alive & ~fresh, looking = fresh;
        do {
            // One register's lanes wait for memory while the next one's are worked out.
            unsigned going_on = 0;
            for (std::size_t i = 0; i < stream_count; i += lanes) {
                const Step step =
                    step_lanes(at, i, going >> i & lane_bits, looking >> i & lane_bits, distances);
                stops.ended |= step.ended << i;
                stops.occupied |= step.occupied << i;
                going_on |= step.going << i;
            }
            cells += static_cast<std::uint64_t>(std::popcount(going | looking));
            going = going_on;
            looking = 0;
        } while (std::popcount(going) > stragglers);
        return stops;
    }

    /// Cuts the ways of streams through their cells in pieces, up to `reach`.
    /// @param pieces  `piece_count` of each stream
    static HWY_INLINE void cut(const StreamPlaces& at, const PerStream<double>& reach, unsigned streams,
                               PerStream<std::array<std::uint64_t, piece_count>>& pieces) {
        const Depth d;
        const hn::Rebind<float, Depth> df;
        const hn::RebindToUnsigned<Depth> du;
        for (std::size_t lane = 0; lane < stream_count; lane += lanes) {
            if ((streams >> lane & lane_bits) == 0) continue;
            const V from = hn::Load(d, &at.depth[lane]);
            V cell[3], origin[3], slope[3];
            V leave = hn::Load(d, &reach[lane]);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                cell[axis] = hn::Load(d, &at.cell[axis][lane]);
                origin[axis] = hn::Load(d, &at.origin[axis][lane]);
                slope[axis] = hn::Load(d, &at.slope[axis][lane]);
                const V up = hn::IfThenElseZero(hn::Gt(slope[axis], hn::Zero(d)), hn::Set(d, 1.0));
                leave = hn::Min(leave, hn::Mul(hn::Sub(hn::Add(cell[axis], up), origin[axis]),
                                               hn::Load(d, &at.inverse[axis][lane])));
            }
            const V to = hn::Max(from, leave);
            hn::Vec<decltype(df)> begin[3], end[3];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto place = [&](V depth) HWY_ATTR {
                    const V in_cell = hn::Sub(hn::MulAdd(depth, slope[axis], origin[axis]), cell[axis]);
                    return hn::DemoteTo(df, hn::MulAdd(in_cell, hn::Set(d, double(CellPlace::per_cell)),
                                                       hn::Set(d, double(CellPlace::cell_begin))));
                };
                begin[axis] = place(from);
                end[axis] = place(to);
            }
            const auto halves = cut_in_pieces(df, begin, end);
            for (std::size_t i = 0; i < piece_count; ++i) {
                const auto last = hn::ShiftLeft<32>(hn::PromoteTo(du, halves.last[i]));
                HWY_ALIGN std::uint64_t piece[lanes];
                hn::Store(hn::Or(hn::PromoteTo(du, halves.first[i]), last), du, piece);
                for (std::size_t k = 0; k < lanes; ++k) pieces[lane + k][i] = piece[k];
            }
        }
    }

private:
    static constexpr int stragglers = stream_count / 2;
    static constexpr std::size_t lanes = hn::MaxLanes(Depth());
    static constexpr unsigned lane_bits = (1u << lanes) - 1;

    static HWY_INLINE unsigned bits(M mask) {
        std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(Depth(), mask, bytes);
        return bytes[0];
    }
    static HWY_INLINE M mask_of(unsigned bits) {
        const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits)};
        return hn::LoadMaskBits(Depth(), bytes);
    }

    static HWY_INLINE V look(const std::uint8_t* distances, V index) {
        const Depth d;
        const hn::RebindToSigned<Depth> di;
        const hn::RebindToUnsigned<Depth> du;
        const auto words =
            hn::GatherOffset(du, reinterpret_cast<const std::uint64_t*>(distances), hn::ConvertTo(di, index));
        // A whole number below 2^52 is the last bits of 2^52 and itself.
        const V base = hn::Set(d, 0x1p52);
        const auto steps = hn::And(words, hn::Set(du, 0xff));
        return hn::Sub(hn::BitCast(d, hn::Or(steps, hn::BitCast(du, base))), base);
    }

    struct Step {
        unsigned going, occupied, ended;
    };

    /// Takes those that are `going` as far as nothing is in their way, and looks into their cells, and into
    /// those of `looking` as they are.
    static HWY_INLINE Step step_lanes(StreamPlaces& at, std::size_t lane, unsigned going_bits,
                                      unsigned looking_bits, const std::uint8_t* distances) {
        const Depth d;
        const V one = hn::Set(d, 1.0);
        const V depth = hn::Load(d, &at.depth[lane]), ahead = hn::Load(d, &at.ahead[lane]);
        V cell[3], stride[3], plane[3];
        // Out of the cube of empty cells: through the nearest of the three planes ahead.
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const V slope = hn::Load(d, &at.slope[axis][lane]);
            const V up = hn::IfThenElseZero(hn::Gt(slope, hn::Zero(d)), one);
            cell[axis] = hn::Load(d, &at.cell[axis][lane]);
            stride[axis] = hn::MulAdd(hn::CopySign(one, slope), hn::Sub(ahead, one), cell[axis]);
            plane[axis] = hn::Mul(hn::Sub(hn::Add(stride[axis], up), hn::Load(d, &at.origin[axis][lane])),
                                  hn::Load(d, &at.inverse[axis][lane]));
        }
        const V leave = hn::Min(plane[0], hn::Min(plane[1], plane[2]));
        const V next = hn::Max(depth, leave);  // a plane that the ray lies in is crossed nowhere
        const M set_out = mask_of(going_bits);
        const M ended = hn::And(set_out, hn::Ge(next, hn::Load(d, &at.end[lane])));
        const M going = hn::AndNot(ended, set_out);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const V slope = hn::Load(d, &at.slope[axis][lane]);
            // Across, the ray is where it is, rounded: but in the cube, in the grid, and never behind.
            const V far = hn::Min(hn::Max(stride[axis], hn::Zero(d)), hn::Load(d, &at.last[axis][lane]));
            const V across = hn::Floor(hn::MulAdd(next, slope, hn::Load(d, &at.origin[axis][lane])));
            const V held = hn::Min(hn::Max(across, hn::Min(cell[axis], far)), hn::Max(cell[axis], far));
            const V through = hn::Add(stride[axis], hn::CopySign(one, slope));
            const V entered = hn::IfThenElse(hn::Le(plane[axis], leave), through, held);
            cell[axis] = hn::IfThenElse(going, entered, cell[axis]);
            hn::Store(cell[axis], d, &at.cell[axis][lane]);
        }
        hn::Store(hn::IfThenElse(going, next, depth), d, &at.depth[lane]);

        const M looking = hn::Or(going, mask_of(looking_bits));
        const V index = hn::MulAdd(
            cell[2], hn::Load(d, &at.layer[lane]),
            hn::MulAdd(cell[1], hn::Load(d, &at.row[lane]), hn::Add(cell[0], hn::Load(d, &at.first[lane]))));
        const V steps = look(distances, hn::IfThenElseZero(looking, index));
        const M empty = hn::Gt(steps, hn::Zero(d));
        hn::Store(hn::IfThenElse(looking, hn::Max(steps, one), ahead), d, &at.ahead[lane]);
        return {.going = bits(hn::And(looking, empty)),
                .occupied = bits(hn::AndNot(empty, looking)),
                .ended = bits(ended)};
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
