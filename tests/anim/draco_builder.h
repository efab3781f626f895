#pragma once
// Small files whose one primitive Draco's own encoder compressed.

#include "gltf_builder.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gridreel::test {

/// What is compressed. Empty attributes are left out.
struct PlainMesh {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> texcoords;
    std::vector<glm::u8vec4> colors;  ///< normalized
    std::vector<glm::u16vec4> joints;
    std::vector<glm::vec4> weights;
    std::vector<glm::uvec3> triangles;
};

struct DracoSettings {
    bool sequential = false;
    int speed = 0;  ///< 0 (smallest) to 10; chooses the predictions
    int position_bits = 14, other_bits = 12;
};

/// A bumpy sheet of `cells` times `cells` squares, split along its middle by a seam of texture coordinates.
/// Joint 0 of each vertex is the vertex's number, and no weight is zero: so every vertex can be told after
/// decoding.
[[nodiscard]] PlainMesh bumpy_sheet(std::uint32_t seed, std::uint32_t cells);

/// A Draco stream; its attributes' identifiers are 0 and up in the order of `PlainMesh`, absent ones skipped.
[[nodiscard]] std::vector<std::byte> encode_draco(const PlainMesh& plain, const DracoSettings& settings);

/// A file with that stream as buffer view 0, and accessors without buffer views.
[[nodiscard]] GltfBuilder draco_file(const PlainMesh& mesh, const std::vector<std::byte>& stream);
[[nodiscard]] GltfBuilder draco_file(const PlainMesh& mesh, const DracoSettings& settings);

}  // namespace gridreel::test
