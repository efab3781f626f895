#include "anim/gltf/document.h"

#include "anim/error.h"
#include "anim/gltf/container.h"
#include "anim/gltf/uri.h"

#include <fmt/format.h>

#include <fstream>
#include <map>

namespace gridreel::anim::gltf {
namespace {

/// Absent when the file cannot be opened or read to its end.
std::optional<std::vector<std::byte>> read_bytes(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    std::vector<std::byte> bytes;
    constexpr std::size_t piece = 1 << 20;
    while (stream) {
        const std::size_t size = bytes.size();
        bytes.resize(size + piece);
        stream.read(reinterpret_cast<char*>(bytes.data() + size), piece);
        bytes.resize(size + static_cast<std::size_t>(stream.gcount()));
    }
    if (!stream.eof()) return {};
    bytes.shrink_to_fit();
    return bytes;
}

/// What an object of the JSON may cost, whatever it describes: itself, tinygltf's and our own form of it (a
/// material has 616 bytes), and its part in a pose. Measured for files of nothing but empty nodes: 1566.
constexpr std::size_t object_bytes = 2048;

/// Nesting is bounded by the parser.
std::size_t count_objects(const Json& json) {
    std::size_t count = 0;
    if (const auto* const array = std::get_if<Json::Array>(&json.value)) {
        for (const Json& item : *array) count += count_objects(item);
    } else if (const auto* const object = std::get_if<Json::Object>(&json.value)) {
        count = 1;
        for (const auto& property : *object) count += count_objects(property.second);
    }
    return count;
}

}  // namespace

std::vector<std::byte> read_whole_file(const std::filesystem::path& path) {
    const auto name = path.string();
    std::error_code failed;
    const auto status = std::filesystem::status(path, failed);
    if (!std::filesystem::exists(status)) throw Error("there is no such file", name, "check the path");
    if (std::filesystem::is_directory(status))
        throw Error("this is a folder", name, "name a .gltf or .glb file in it");
    auto bytes = read_bytes(path);
    if (!bytes) throw Error("the file cannot be read", name, "check its permissions");
    return std::move(*bytes);
}

Document::Document(std::span<const std::byte> bytes, const std::filesystem::path& path,
                   std::filesystem::path asset_root)
    : file_(path.string()), folder_(path.parent_path()), asset_root_(std::move(asset_root)) {
    const Container parts = split_container(bytes, file_);
    json_ = parse_json(parts.json, file_);
    binary_ = parts.binary;
    is_binary_ = parts.is_binary;
    budget_.add_bytes_read(bytes.size());
    budget_.spend(count_objects(json_) * object_bytes, root());
    if (parts.trailing_bytes > 0)
        warn(root(),
             fmt::format("{} bytes after the end of the binary glTF are ignored", parts.trailing_bytes));
}

std::vector<Place> Document::all(std::string_view array) const {
    std::vector<Place> places;
    const auto found = root().find(array);
    for (std::size_t i = 0; found && i < found->size(); ++i) places.push_back((*found)[i]);
    return places;
}

std::span<const std::byte> Document::read_buffer(const Place& place, std::size_t number) {
    const std::size_t length = place.at("byteLength").integer();
    // What only stands in for compressed views may be missing, or be some other chunk's number.
    const bool may_be_missing = is_fallback(place);

    std::span<const std::byte> bytes;
    const auto uri = place.find("uri");
    if (uri) {
        if (auto embedded = decode_data_uri(uri->text(), *uri)) {
            owned_.push_back(std::move(embedded->bytes));
        } else {
            auto beside = read_file(uri->text(), *uri);
            if (!beside.refusal.empty() && !may_be_missing) uri->refuse(beside.refusal, beside.remedy);
            owned_.push_back(std::move(beside.bytes));
        }
        bytes = owned_.back();
    } else if (number == 0 && is_binary_) {
        bytes = binary_;
    }

    // A buffer without a source is a defect only when something reads it.
    if (bytes.size() < length && (uri || !bytes.empty())) {
        if (may_be_missing) return {};
        place.refuse(fmt::format("the buffer states {} bytes but there are {}", length, bytes.size()),
                     "the data is cut short: fetch or export it again");
    }
    return bytes.first(std::min(length, bytes.size()));
}

void Document::read_buffers() {
    const auto places = all("buffers");
    for (std::size_t i = 0; i < places.size(); ++i) buffers_.push_back(read_buffer(places[i], i));
    views_ = resolve_views(root(), buffers_, budget_);
    warnings_.insert(warnings_.end(), views_.warnings.begin(), views_.warnings.end());
    accessors_ = resolve_accessors(root(), views_.bytes);
}

Index Document::add_accessor(Accessor accessor, std::vector<std::byte> bytes) {
    owned_.push_back(std::move(bytes));
    accessor.data = owned_.back().data();
    accessor.stride = accessor.element.components() * byte_count(accessor.component);
    accessor.sparse = {};
    accessors_.push_back(accessor);
    return static_cast<Index>(accessors_.size() - 1);
}

std::vector<Warning> Document::merged_warnings() const {
    std::vector<Warning> merged;
    std::vector<std::size_t> counts;
    std::map<std::string_view, std::size_t> known;  // text -> its place in `merged`
    for (const Warning& warning : warnings_) {
        const auto [entry, is_new] = known.emplace(warning.text, merged.size());
        if (is_new) {
            merged.push_back(warning);
            counts.push_back(0);
        } else {
            ++counts[entry->second];
        }
    }
    for (std::size_t i = 0; i < merged.size(); ++i)
        if (counts[i] > 0) merged[i].text += fmt::format(" (here and in {} more places)", counts[i]);
    return merged;
}

FileBytes Document::read_file(std::string_view uri, const Place& place) {
    const UriTarget target = resolve_uri(uri, folder_, asset_root_);
    if (!target.refusal.empty()) return {.refusal = target.refusal, .remedy = target.remedy};

    const FileBytes unreadable{.refusal = fmt::format("the file \"{}\" cannot be read", uri),
                               .remedy = "check that it is there and may be read"};
    std::error_code failed;
    if (!std::filesystem::is_regular_file(target.path, failed)) return unreadable;
    const std::size_t size = std::filesystem::file_size(target.path, failed);
    if (failed) return unreadable;

    // One file read many times is paid for; the first time it counts as part of the model.
    if (files_read_.insert(target.path).second)
        budget_.add_bytes_read(size);
    else
        budget_.spend(size, place);
    auto bytes = read_bytes(target.path);
    if (!bytes) return unreadable;
    return {.bytes = std::move(*bytes)};
}

std::vector<float> Document::floats(Index accessor, const Place& place) {
    const Accessor& source = accessors_[accessor];
    budget_.spend(source.count * source.element.components() * sizeof(float), place);
    return read_floats(source);
}

std::vector<std::uint32_t> Document::integers(Index accessor, const Place& place) {
    const Accessor& source = accessors_[accessor];
    budget_.spend(source.count * source.element.components() * sizeof(std::uint32_t), place);
    return read_integers(source);
}

}  // namespace gridreel::anim::gltf
