#pragma once
// The one exception for bad input: what is wrong, where, and what to do about it.

#include <stdexcept>
#include <string>
#include <string_view>

namespace gridreel {

/// Bad input. `tools` catches it once and picks the exit code from the type:
/// this class itself means an unreadable, invalid or unsupported scene (exit 3);
/// `sequences::UsageError` and `sequences::OutputError` derive from it.
class Error : public std::runtime_error {
public:
    /// @param what    the defect, a sentence without a full stop ("accessor reads past its buffer view")
    /// @param where   file and JSON pointer, or the option ("Fox.glb: /accessors/3"); may be empty
    /// @param remedy  what the user can do, imperative ("re-export the file"); may be empty
    Error(std::string_view what, std::string_view where, std::string_view remedy = {});

    [[nodiscard]] const std::string& where() const noexcept { return where_; }
    [[nodiscard]] const std::string& remedy() const noexcept { return remedy_; }

private:
    std::string where_;
    std::string remedy_;
};

}  // namespace gridreel
