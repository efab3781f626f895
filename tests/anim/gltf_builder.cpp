#include "gltf_builder.h"

#include "anim/error.h"

#include <fstream>
#include <random>

namespace gridreel::test {
namespace {

void append_word(std::vector<std::byte>& bytes, std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8)
        bytes.push_back(static_cast<std::byte>(value >> shift & 0xff));
}

void append_chunk(std::vector<std::byte>& bytes, std::string_view type, std::vector<std::byte> data,
                  std::byte padding) {
    while (data.size() % 4 != 0) data.push_back(padding);
    append_word(bytes, data.size());
    for (const char c : type) bytes.push_back(static_cast<std::byte>(c));
    bytes.insert(bytes.end(), data.begin(), data.end());
}

}  // namespace

std::string base64(const std::vector<std::byte>& bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0u;
        };
        const std::uint32_t bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        text += digits[bits >> 18 & 63];
        text += digits[bits >> 12 & 63];
        text += i + 1 < bytes.size() ? digits[bits >> 6 & 63] : '=';
        text += i + 2 < bytes.size() ? digits[bits & 63] : '=';
    }
    return text;
}

std::vector<std::byte> bytes_of(std::string_view text) {
    std::vector<std::byte> bytes;
    for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
    return bytes;
}

std::string GltfBuilder::gltf() const {
    auto whole = json;
    if (!buffer.empty() && !whole.contains("buffers"))
        whole["buffers"] = {{{"byteLength", buffer.size()},
                             {"uri", "data:application/octet-stream;base64," + base64(buffer)}}};
    return whole.dump();
}

std::vector<std::byte> GltfBuilder::glb() const {
    auto whole = json;
    if (!buffer.empty() && !whole.contains("buffers")) whole["buffers"] = {{{"byteLength", buffer.size()}}};
    std::vector<std::byte> chunks;
    append_chunk(chunks, "JSON", bytes_of(whole.dump()), std::byte{' '});
    if (!buffer.empty()) append_chunk(chunks, std::string_view("BIN\0", 4), buffer, std::byte{0});

    auto bytes = bytes_of("glTF");
    append_word(bytes, 2);
    append_word(bytes, 12 + chunks.size());
    bytes.insert(bytes.end(), chunks.begin(), chunks.end());
    return bytes;
}

anim::Scene GltfBuilder::load() const {
    return anim::load_bytes(bytes_of(gltf()), "test.gltf");
}

GltfBuilder one_triangle() {
    GltfBuilder file;
    file.add_vec3s({0, 0, 0, 1, 0, 0, 0, 1, 0});
    file.add_accessor<std::uint16_t>({0, 1, 2}, uint16, "SCALAR", 3);
    file.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}};
    file.json["nodes"] = {{{"mesh", 0}}};
    file.json["scenes"] = {{{"nodes", {0}}}};
    file.json["scene"] = 0;
    return file;
}

GltfBuilder skinned_triangle() {
    GltfBuilder file = one_triangle();
    const auto joints =
        file.add_accessor<std::uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, uint8, "VEC4", 3);
    const auto weights = file.add_vec4s({0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    auto& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = joints;
    attributes["WEIGHTS_0"] = weights;
    file.json["skins"] = {{{"joints", {1, 2}}}};
    file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"children", {2}}}, nlohmann::json::object()};
    file.json["scenes"][0]["nodes"] = {0, 1};
    return file;
}

Refusal refusal_of(const std::vector<std::byte>& bytes, const std::filesystem::path& name) {
    try {
        static_cast<void>(anim::load_bytes(bytes, name));
        return {};
    } catch (const Error& error) {
        const auto colon = error.where().find(": ");
        return {.pointer = colon == std::string::npos ? "" : error.where().substr(colon + 2),
                .message = error.what()};
    }
}

Refusal refusal_of(const GltfBuilder& file) {
    return refusal_of(bytes_of(file.gltf()), "test.gltf");
}

std::string warning_at(const anim::Scene& scene, std::string_view pointer) {
    for (const anim::Warning& warning : scene.warnings)
        if (warning.where == pointer) return warning.text;
    return {};
}

TemporaryFolder::TemporaryFolder() {
    std::random_device random;
    path_ = std::filesystem::temp_directory_path() / ("gridreel-test-" + std::to_string(random()));
    std::filesystem::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryFolder::write(const std::filesystem::path& name,
                                             const std::vector<std::byte>& bytes) const {
    const auto path = path_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream stream(path, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return path;
}

std::filesystem::path TemporaryFolder::write(const std::filesystem::path& name, std::string_view text) const {
    return write(name, bytes_of(text));
}

}  // namespace gridreel::test
