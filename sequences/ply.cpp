#include "sequences/ply.h"

#include "sequences/whole_file.h"

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace gridreel::sequences {
namespace {

static_assert(std::endian::native == std::endian::little, "values are copied as they stand");
static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::uvec3) == 12);

std::string header(std::size_t vertices, std::size_t faces, bool with_normals) {
    return fmt::format(
        "ply\nformat binary_little_endian 1.0\n"
        "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n{}"
        "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        vertices, with_normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "", faces);
}

template <class T>
void append(std::string& bytes, const T& value) {
    const std::size_t size = bytes.size();
    bytes.resize(size + sizeof value);
    std::memcpy(bytes.data() + size, &value, sizeof value);
}

}  // namespace

void write_ply(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
               std::span<const glm::uvec3> triangles, const std::filesystem::path& file) {
    assert(normals.empty() || normals.size() == positions.size());
    std::string bytes = header(positions.size(), triangles.size(), !normals.empty());
    bytes.reserve(bytes.size() + positions.size() * 24 + triangles.size() * 13);
    for (std::size_t vertex = 0; vertex < positions.size(); ++vertex) {
        append(bytes, positions[vertex]);
        if (!normals.empty()) append(bytes, normals[vertex]);
    }
    for (const glm::uvec3& triangle : triangles) {
        append(bytes, std::uint8_t{3});
        append(bytes, triangle);
    }

    write_whole_file(file, bytes);
}

}  // namespace gridreel::sequences
