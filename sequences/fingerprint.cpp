#include "sequences/fingerprint.h"

#include "anim/error.h"
#include "anim/gltf/uri.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <openssl/evp.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

namespace gridreel::sequences {
namespace {

class Sha256 {
public:
    Sha256() : context_(EVP_MD_CTX_new()) {
        if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1)
            throw std::bad_alloc();
    }

    void add(const void* bytes, std::size_t count) { EVP_DigestUpdate(context_.get(), bytes, count); }

    /// Eight bytes, the lowest first.
    void add_length(std::uint64_t length) {
        std::array<unsigned char, 8> bytes{};
        for (unsigned char& byte : bytes) {
            byte = static_cast<unsigned char>(length & 0xff);
            length >>= 8;
        }
        add(bytes.data(), bytes.size());
    }

    [[nodiscard]] std::string hex() {
        std::array<unsigned char, 32> digest{};
        EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr);
        std::string text;
        for (const unsigned char byte : digest) text += fmt::format("{:02x}", byte);
        return text;
    }

private:
    struct Free {
        void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
    };
    std::unique_ptr<EVP_MD_CTX, Free> context_;
};

std::optional<std::string> read_file(const std::filesystem::path& file) {
    // Opening a pipe would wait for somebody to write into it.
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(stream), {});
}

/// The bytes of a file that the scene names; none when the loader would not follow the URI either.
std::string read_named(const std::string& uri, const std::filesystem::path& folder,
                       const std::filesystem::path& asset_root) {
    const anim::gltf::UriTarget target = anim::gltf::resolve_uri(uri, folder, asset_root);
    if (!target.refusal.empty()) return {};
    return read_file(target.path).value_or("");
}

/// URIs of the other files a `.gltf` is made of; none when it is not valid JSON, as a `.glb` is not.
std::vector<std::string> named_files(std::string_view gltf) {
    std::vector<std::string> uris;
    const auto json = nlohmann::json::parse(gltf, nullptr, false);
    if (!json.is_object()) return uris;
    for (const char* list : {"buffers", "images"}) {
        const auto entries = json.find(list);
        if (entries == json.end() || !entries->is_array()) continue;
        for (const auto& entry : *entries) {
            const auto uri = entry.is_object() ? entry.find("uri") : entry.end();
            if (!entry.is_object() || uri == entry.end() || !uri->is_string()) continue;
            if (const auto text = uri->get<std::string>(); !text.starts_with("data:")) uris.push_back(text);
        }
    }
    return uris;
}

}  // namespace

std::string sha256_hex(std::span<const std::byte> bytes) {
    Sha256 hash;
    hash.add(bytes.data(), bytes.size());
    return hash.hex();
}

std::string scene_sha256(const std::filesystem::path& file, const std::filesystem::path& asset_root) {
    const auto content = read_file(file);
    if (!content) throw Error("the file cannot be read", file.string(), "check the path and its permissions");
    Sha256 hash;
    hash.add(content->data(), content->size());
    for (const std::string& uri : named_files(*content)) {
        const std::string other = read_named(uri, file.parent_path(), asset_root);
        hash.add_length(other.size());
        hash.add(other.data(), other.size());
    }
    return hash.hex();
}

}  // namespace gridreel::sequences
