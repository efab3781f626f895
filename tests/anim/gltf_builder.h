#pragma once
// Small glTF files built in memory, whole or deliberately broken.

#include "anim/load.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace gridreel::test {

/// Component types as in the file.
enum Component { int8 = 5120, uint8, int16, uint16, uint32 = 5125, float32 };

/// A file under construction: JSON that tests change as they like, and the bytes of buffer 0.
struct GltfBuilder {
    nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
    std::vector<std::byte> buffer;

    /// Appends raw values as a buffer view of their own; its index.
    template <class T>
    std::size_t add_view(const std::vector<T>& values) {
        while (buffer.size() % 4 != 0) buffer.push_back(std::byte{0});
        const std::size_t offset = buffer.size(), length = values.size() * sizeof(T);
        buffer.resize(offset + length);
        if (length > 0) std::memcpy(buffer.data() + offset, values.data(), length);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}});
        return json["bufferViews"].size() - 1;
    }

    /// Appends values as an accessor of their own; its index.
    template <class T>
    std::size_t add_accessor(const std::vector<T>& values, Component component, std::string_view type,
                             std::size_t count) {
        const std::size_t view = add_view(values);
        json["accessors"].push_back(
            {{"bufferView", view}, {"componentType", int(component)}, {"type", type}, {"count", count}});
        return json["accessors"].size() - 1;
    }

    std::size_t add_scalars(const std::vector<float>& values) {
        return add_accessor(values, float32, "SCALAR", values.size());
    }
    std::size_t add_vec3s(const std::vector<float>& values) {
        return add_accessor(values, float32, "VEC3", values.size() / 3);
    }
    std::size_t add_vec4s(const std::vector<float>& values) {
        return add_accessor(values, float32, "VEC4", values.size() / 4);
    }

    [[nodiscard]] std::string gltf() const;            ///< the buffer embedded as a data URI
    [[nodiscard]] std::vector<std::byte> glb() const;  ///< the buffer as the BIN chunk
    [[nodiscard]] anim::Scene load() const;            ///< of `gltf()`, as though from "test.gltf"
};

/// One triangle (0,0,0) (1,0,0) (0,1,0), indexed, in one node of one scene.
/// Accessor 0 holds the positions, accessor 1 the indices (16 bit).
[[nodiscard]] GltfBuilder one_triangle();

/// Two triangles' worth of vertices under a two-joint skin: nodes 0 (mesh, skin), 1 and 2 (joints).
[[nodiscard]] GltfBuilder skinned_triangle();

[[nodiscard]] std::string base64(const std::vector<std::byte>& bytes);
[[nodiscard]] std::vector<std::byte> bytes_of(std::string_view text);

/// Why a file is refused: the JSON pointer, and the whole message. Both empty when it loads.
struct Refusal {
    std::string pointer;
    std::string message;
};

[[nodiscard]] Refusal refusal_of(const GltfBuilder& file);
[[nodiscard]] Refusal refusal_of(const std::vector<std::byte>& bytes, const std::filesystem::path& name);

/// The first warning at that JSON pointer; empty when there is none.
[[nodiscard]] std::string warning_at(const anim::Scene& scene, std::string_view pointer);

/// A folder of its own that goes away with its owner.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    std::filesystem::path write(const std::filesystem::path& name, const std::vector<std::byte>& bytes) const;
    std::filesystem::path write(const std::filesystem::path& name, std::string_view text) const;

private:
    std::filesystem::path path_;
};

}  // namespace gridreel::test
