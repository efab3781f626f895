#pragma once
// A glTF file in memory: its JSON and the bytes its buffers hold.

#include "anim/gltf/accessor.h"
#include "anim/gltf/budget.h"
#include "anim/gltf/buffer_views.h"
#include "anim/gltf/json.h"
#include "anim/gltf/place.h"
#include "anim/scene.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace gridreel::anim::gltf {

/// What reading a file brought: its bytes, or the reason why there are none.
struct FileBytes {
    std::vector<std::byte> bytes{};
    std::string refusal{};  ///< empty: `bytes` are the file's
    std::string remedy{};
};

/// Everything the readers share while a file is turned into a scene. Not copied: `root()` refers to it.
class Document {
public:
    /// Parses the JSON; nothing is checked yet.
    ///
    /// @param bytes       the whole file; must outlive this
    /// @param path        its name, for messages and for finding the files beside it
    /// @param asset_root  as `load` takes it
    Document(std::span<const std::byte> bytes, const std::filesystem::path& path,
             std::filesystem::path asset_root);
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    [[nodiscard]] Place root() const { return {json_, file_}; }
    /// The array of that name; nothing when the file has none.
    [[nodiscard]] std::vector<Place> all(std::string_view array) const;

    /// Fetches every buffer, from the file itself or from beside it, decompresses buffer views, and resolves
    /// the accessors.
    /// The shape must have been validated.
    void read_buffers();

    [[nodiscard]] std::span<const Accessor> accessors() const { return accessors_; }
    [[nodiscard]] std::span<const std::byte> view(Index buffer_view) const {
        return views_.bytes[buffer_view];
    }

    /// Adds an accessor to those of the file; its index. Earlier `accessors()` are void.
    ///
    /// @param bytes  its elements, tightly packed, for which the budget has been charged
    Index add_accessor(Accessor accessor, std::vector<std::byte> bytes);
    /// For rewriting what refers to accessors. Places inside what is replaced are void.
    [[nodiscard]] Json& json() { return json_; }

    /// The bytes of the file that a URI names, if it leads to one that it may name.
    /// @throws Error at `place` when the budget does not allow it
    [[nodiscard]] FileBytes read_file(std::string_view uri, const Place& place);

    /// The accessor's values as floats, or as unsigned integers.
    /// @throws Error at `place` when the budget does not allow it
    [[nodiscard]] std::vector<float> floats(Index accessor, const Place& place);
    [[nodiscard]] std::vector<std::uint32_t> integers(Index accessor, const Place& place);

    [[nodiscard]] Budget& budget() { return budget_; }
    /// All warnings, once each: where several say the same, at the first place, with their number.
    [[nodiscard]] std::vector<Warning> merged_warnings() const;
    void warn(const Place& place, std::string text) {
        warnings_.push_back({place.pointer(), std::move(text)});
    }

private:
    [[nodiscard]] std::span<const std::byte> read_buffer(const Place& place, std::size_t number);

    std::string file_;
    std::filesystem::path folder_;
    std::filesystem::path asset_root_;
    Json json_;
    std::span<const std::byte> binary_;
    bool is_binary_ = false;
    std::vector<std::vector<std::byte>> owned_;  ///< buffers that are not the BIN chunk, and added accessors
    std::vector<std::span<const std::byte>> buffers_;
    BufferViews views_;
    std::vector<Accessor> accessors_;
    std::set<std::filesystem::path> files_read_;
    Budget budget_;
    std::vector<Warning> warnings_;
};

/// A whole file.
/// @throws Error when it cannot be read
[[nodiscard]] std::vector<std::byte> read_whole_file(const std::filesystem::path& path);

}  // namespace gridreel::anim::gltf
