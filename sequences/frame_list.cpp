#include "sequences/frame_list.h"

#include "sequences/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <optional>
#include <unordered_set>

namespace gridreel::sequences {
namespace {

struct Range {
    Frame first = 0;
    Frame last = 0;
    Frame step = 1;

    [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>((last - first) / step + 1); }
};

/// Takes an integer off the front of `text`.
std::optional<Frame> take_number(std::string_view& text) {
    Frame value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || value > max_frame_number || value < -max_frame_number) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

bool take(std::string_view& text, char wanted) {
    if (text.empty() || text.front() != wanted) return false;
    text.remove_prefix(1);
    return true;
}

/// `first`, `first-last`, `first-lastxstep` or `last`; nothing when the item is none of them.
std::optional<Range> parse_range(std::string_view item) {
    if (item == "last") return Range{.first = clip_end, .last = clip_end};
    const auto first = take_number(item);
    if (!first) return std::nullopt;
    if (item.empty()) return Range{.first = *first, .last = *first};

    if (!take(item, '-')) return std::nullopt;
    const auto last = take_number(item);
    if (!last || *last < *first) return std::nullopt;
    if (item.empty()) return Range{.first = *first, .last = *last};

    if (!take(item, 'x')) return std::nullopt;
    const auto step = take_number(item);
    if (!step || *step < 1 || !item.empty()) return std::nullopt;
    return Range{.first = *first, .last = *last, .step = *step};
}

}  // namespace

std::vector<Frame> parse_frame_list(std::string_view text) {
    std::vector<Frame> frames;
    std::unordered_set<Frame> seen;
    std::size_t named = 0;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t comma = std::min(text.find(',', begin), text.size());
        const std::string_view item = text.substr(begin, comma - begin);
        begin = comma + 1;

        const auto range = parse_range(item);
        if (!range) {
            throw UsageError(fmt::format("'{}' is not a frame or a range of frames", item), "--frames",
                             "write them as 7, 1-240, 1-240x2, 1,5,10-20, -5--1 or last");
        }
        // Counted before it is written out, so that 1-999999999 costs nothing.
        named += range->count();
        if (named > max_frames) {
            throw UsageError(fmt::format("'{}' names more than {} frames", text, max_frames), "--frames",
                             "split the job");
        }
        for (Frame frame = range->first; frame <= range->last; frame += range->step) {
            if (seen.insert(frame).second) frames.push_back(frame);
        }
    }
    return frames;
}

std::vector<Frame> frame_range(Frame first, Frame last) {
    if (first > last) return {};
    std::vector<Frame> frames(static_cast<std::size_t>(last - first + 1));
    std::iota(frames.begin(), frames.end(), first);
    return frames;
}

std::string to_string(std::span<const Frame> frames) {
    std::string text;
    for (std::size_t i = 0; i < frames.size();) {
        std::size_t end = i + 1;
        while (end < frames.size() && frames[end] == frames[end - 1] + 1) ++end;
        if (!text.empty()) text += ',';
        text +=
            end - i == 1 ? fmt::format("{}", frames[i]) : fmt::format("{}-{}", frames[i], frames[end - 1]);
        i = end;
    }
    return text;
}

}  // namespace gridreel::sequences
