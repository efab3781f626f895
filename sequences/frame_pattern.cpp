#include "sequences/frame_pattern.h"

#include "sequences/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

namespace gridreel::sequences {
namespace {

struct Place {
    std::size_t begin = 0;
    std::size_t end = 0;
    int digits = 1;
    bool printf = false;
};

/// `%d` or `%0<width>d` at `begin`.
std::optional<Place> printf_place(std::string_view name, std::size_t begin) {
    std::size_t end = begin + 1;
    int digits = 0;
    if (end < name.size() && name[end] == '0') {
        for (++end; end < name.size() && std::isdigit(static_cast<unsigned char>(name[end])); ++end) {
            digits = std::min(digits * 10 + (name[end] - '0'), 99);
        }
    }
    if (end >= name.size() || name[end] != 'd') return std::nullopt;
    return Place{.begin = begin, .end = end + 1, .digits = std::max(digits, 1), .printf = true};
}

/// The first place for a number at or after `from`.
std::optional<Place> find_place(std::string_view name, std::size_t from) {
    for (std::size_t i = from; i < name.size(); ++i) {
        if (name[i] == '#') {
            const std::size_t end = std::min(name.find_first_not_of('#', i), name.size());
            return Place{.begin = i, .end = end, .digits = static_cast<int>(end - i)};
        }
        if (name[i] == '%') {
            if (const auto place = printf_place(name, i)) return place;
        }
    }
    return std::nullopt;
}

}  // namespace

FramePattern::FramePattern(std::string_view text, std::string_view option) {
    const std::filesystem::path path{text};
    const std::string name = path.filename().string();
    if (name.empty() || name == "." || name == "..") {
        throw UsageError(fmt::format("'{}' names no file", text), option,
                         "write folder and file name, such as frames/fox.####.exr");
    }
    folder_ = path.parent_path();

    const auto place = find_place(name, 0);
    if (!place) {
        before_ = name;
        return;
    }
    if (find_place(name, place->end)) {
        throw UsageError(fmt::format("'{}' has two places for the frame number", name), option,
                         "keep one run of # or one %04d");
    }
    before_ = name.substr(0, place->begin);
    after_ = name.substr(place->end);
    number_text_ = name.substr(place->begin, place->end - place->begin);
    digits_ = place->digits;
    printf_ = place->printf;
}

FramePattern FramePattern::numbered(const std::filesystem::path& folder, std::string_view name,
                                    std::string_view extension) {
    FramePattern pattern;
    pattern.folder_ = folder;
    pattern.before_ = fmt::format("{}.", name);
    pattern.after_ = extension;
    pattern.digits_ = 4;
    pattern.number_text_ = "####";
    return pattern;
}

std::filesystem::path FramePattern::path(Frame frame) const {
    if (!has_number()) return folder_ / before_;
    const int width = digits_ + (frame < 0 && !printf_ ? 1 : 0);
    return folder_ / fmt::format("{}{:0{}}{}", before_, frame, width, after_);
}

std::string FramePattern::extension() const {
    std::string extension = std::filesystem::path(has_number() ? "0" + after_ : before_).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

std::string FramePattern::stem() const {
    std::string name = has_number() ? before_ + after_ : before_;
    name.resize(name.size() - extension().size());
    // The separators that stood around the number.
    while (!name.empty() && (name.back() == '.' || name.back() == '_' || name.back() == '-')) name.pop_back();
    return name;
}

std::string FramePattern::text() const {
    return (folder_ / (before_ + number_text_ + after_)).string();
}

}  // namespace gridreel::sequences
