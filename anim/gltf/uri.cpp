#include "anim/gltf/uri.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <string>
#include <utility>

namespace gridreel::anim::gltf {
namespace {

constexpr std::array<std::int8_t, 256> base64_digits = [] {
    std::array<std::int8_t, 256> table{};
    table.fill(-1);
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < digits.size(); ++i)
        table[static_cast<unsigned char>(digits[i])] = static_cast<std::int8_t>(i);
    return table;
}();

/// RFC 4648, section 4; the padding may be missing.
std::optional<std::vector<std::byte>> decode_base64(std::string_view text) {
    for (int padding = 0; padding < 2 && text.ends_with('='); ++padding) text.remove_suffix(1);
    if (text.size() % 4 == 1) return {};

    std::vector<std::byte> bytes;
    bytes.reserve(text.size() * 3 / 4);
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        const std::int8_t digit = base64_digits[static_cast<unsigned char>(c)];
        if (digit < 0) return {};
        bits = (bits << 6 | static_cast<std::uint32_t>(digit)) & 0xffffu;
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            bytes.push_back(static_cast<std::byte>(bits >> bit_count & 0xffu));
        }
    }
    return bytes;
}

std::optional<int> hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return {};
}

/// RFC 3986, section 2.1; absent when a % is not followed by two hexadecimal digits.
std::optional<std::string> percent_decode(std::string_view uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            text += uri[i];
            continue;
        }
        const auto high = i + 1 < uri.size() ? hex_digit(uri[i + 1]) : std::nullopt;
        const auto low = i + 2 < uri.size() ? hex_digit(uri[i + 2]) : std::nullopt;
        if (!high || !low) return {};
        text += static_cast<char>(*high * 16 + *low);
        i += 2;
    }
    return text;
}

std::optional<std::vector<std::byte>> decode_percent(std::string_view uri) {
    const auto text = percent_decode(uri);
    if (!text) return {};
    std::vector<std::byte> bytes(text->size());
    std::transform(text->begin(), text->end(), bytes.begin(),
                   [](char c) { return static_cast<std::byte>(c); });
    return bytes;
}

/// RFC 3986, section 3.1: a letter, then letters, digits, + - . up to the colon.
bool has_scheme(std::string_view uri) {
    const auto colon = uri.find(':');
    if (colon == uri.npos || colon == 0) return false;
    const auto scheme = uri.substr(0, colon);
    return std::isalpha(static_cast<unsigned char>(scheme[0])) &&
           std::all_of(scheme.begin(), scheme.end(),
                       [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; });
}

bool has_drive(std::string_view path) {
    return path.size() >= 2 && std::isalpha(static_cast<unsigned char>(path[0])) && path[1] == ':';
}

bool is_inside(const std::filesystem::path& path, const std::filesystem::path& folder) {
    const auto [folder_end, _] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return folder_end == folder.end();
}

}  // namespace

std::optional<DataUri> decode_data_uri(std::string_view uri, const Place& place) {
    constexpr std::string_view scheme = "data:", marker = ";base64";
    if (!uri.starts_with(scheme)) return {};
    uri.remove_prefix(scheme.size());

    const auto comma = uri.find(',');
    if (comma == uri.npos) place.refuse("the data URI has no comma", "write it as data:TYPE;base64,...");
    const std::string_view head = uri.substr(0, comma);
    const bool is_base64 = head.ends_with(marker);
    auto bytes = is_base64 ? decode_base64(uri.substr(comma + 1)) : decode_percent(uri.substr(comma + 1));
    if (!bytes)
        place.refuse(is_base64 ? "the data URI is not valid base64"
                               : "the data URI has a % that no two hexadecimal digits follow");
    return DataUri{.mime_type = head.substr(0, head.find(';')), .bytes = std::move(*bytes)};
}

UriTarget resolve_uri(std::string_view uri, const std::filesystem::path& folder,
                      const std::filesystem::path& asset_root) {
    const auto refused = [](std::string why) {
        return UriTarget{.refusal = std::move(why),
                         .remedy = "put the file beside the model and name it by a relative URI"};
    };
    if (uri.empty()) return refused("the URI is empty");
    if (has_scheme(uri)) return refused("the URI has a scheme; only relative URIs and data URIs are read");

    auto relative = percent_decode(uri);
    if (!relative) return refused("the URI has a % that no two hexadecimal digits follow");
    if (relative->find('\0') != relative->npos) return refused("the URI holds a zero byte");
    // Exporters on Windows write \ between segments.
    std::replace(relative->begin(), relative->end(), '\\', '/');
    if (relative->front() == '/' || has_drive(*relative)) return refused("the URI is absolute");

    // Dots first, as URIs have it: links below a folder that is not there would not be followed.
    std::error_code failed;
    const auto home = std::filesystem::weakly_canonical(folder.empty() ? "." : folder, failed);
    if (failed) return refused(fmt::format("the model's folder cannot be found ({})", failed.message()));
    const auto target = std::filesystem::weakly_canonical((home / *relative).lexically_normal(), failed);
    if (failed) return refused(fmt::format("the URI cannot be followed ({})", failed.message()));
    if (is_inside(target, home)) return {.path = target};

    if (!asset_root.empty()) {
        const auto root = std::filesystem::canonical(asset_root, failed);
        if (failed) return refused(fmt::format("the asset root cannot be found ({})", failed.message()));
        if (is_inside(target, root)) return {.path = target};
    }
    return {.refusal = fmt::format("the URI leads out of the model's folder{}",
                                   asset_root.empty() ? "" : " and of the asset root"),
            .remedy =
                "put the file beside the model or below its folder, or allow the folder that it lies in "
                "with --asset-root"};
}

}  // namespace gridreel::anim::gltf
