#pragma once
// File names of numbered frames: `frames/fox.####.exr`, `frames/fox_%04d.png`.

#include "sequences/frame_list.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace gridreel::sequences {

/// A path with at most one place for the frame number, in its file name.
///
/// A run of `#` is as many digits, at least: frame 7 of `####` is `0007`, frame -7 is `-0007`.
/// `%d` and `%04d` are as in printf: a width counts the minus sign, frame -7 of `%04d` is `-007`.
/// Everything else, folders included, is taken as it stands.
class FramePattern {
public:
    FramePattern() = default;

    /// @param option  for messages
    /// @throws UsageError when `text` has no file name or more than one place for the number
    explicit FramePattern(std::string_view text, std::string_view option = "--output");

    /// `folder/name.####extension`; nothing in `name` is special.
    [[nodiscard]] static FramePattern numbered(const std::filesystem::path& folder, std::string_view name,
                                               std::string_view extension);

    [[nodiscard]] bool has_number() const { return digits_ > 0; }
    [[nodiscard]] std::filesystem::path path(Frame frame) const;
    [[nodiscard]] std::filesystem::path folder() const { return folder_; }  ///< may be empty: here

    /// With the dot, lower case; empty when there is none.
    [[nodiscard]] std::string extension() const;

    /// What remains of the file name without number and extension: `fox` of `fox.####.exr`; may be empty.
    [[nodiscard]] std::string stem() const;

    /// As written.
    [[nodiscard]] std::string text() const;

private:
    std::filesystem::path folder_;
    std::string before_;
    std::string after_;
    int digits_ = 0;           ///< 0: no number
    bool printf_ = false;      ///< the sign counts as a digit
    std::string number_text_;  ///< `####` or `%04d`
};

}  // namespace gridreel::sequences
