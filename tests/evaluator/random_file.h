#pragma once
// Small valid glTF files that use everything that moves vertices at once.

#include "tests/anim/gltf_builder.h"

#include <cstdint>

namespace gridreel::test {

/// A tree of up to a dozen nodes (matrices, mirrored and non-uniform scales, hidden ones, instances), meshes
/// of every layout and component type (strips and fans, with and without indices, normals, morph targets, one
/// or two sets of joints whose weights sum to anything), and up to three animations of every interpolation,
/// through nodes and through pointers, with one key or many, starting late. The same for the same seed.
[[nodiscard]] GltfBuilder random_file(std::uint32_t seed);

}  // namespace gridreel::test
