#include "tests/cli/tiny_scene.h"

#include "tests/sequences/scratch_folder.h"

#include <array>
#include <cstring>
#include <string>

namespace gridreel::test {
namespace {

constexpr std::array<float, 17> numbers{
    0, 0, 0, 1, 0, 0, 0, 1, 0,  // the triangle
    0, 1,                       // key times
    0, 0, 0, 2, 0, 0,           // translations
};

constexpr const char* json = R"({
  "asset": {"version": "2.0"},
  "scene": 0,
  "scenes": [{"nodes": [0, 1, 2]}],
  "nodes": [
    {"name": "Slider", "mesh": 0},
    {"name": "Still", "mesh": 0, "translation": [0, 0, -1]},
    {"name": "Cam", "camera": 0, "translation": [1, 0.5, 5]}
  ],
  "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "aspectRatio": 2.0, "znear": 0.1}}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
  "materials": [{"name": "Red", "doubleSided": true, "pbrMetallicRoughness": {"baseColorFactor": [1, 0.1, 0.1, 1]}}],
  "animations": [{
    "name": "Slide",
    "samplers": [{"input": 1, "output": 2}],
    "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]
  }],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
    {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
    {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}
  ],
  "bufferViews": [
    {"buffer": 0, "byteOffset": 0, "byteLength": 36},
    {"buffer": 0, "byteOffset": 36, "byteLength": 8},
    {"buffer": 0, "byteOffset": 44, "byteLength": 24}
  ],
  "buffers": [{"uri": "tiny.bin", "byteLength": 68}]
})";

}  // namespace

std::filesystem::path write_tiny_scene(const std::filesystem::path& folder) {
    std::string bytes(sizeof numbers, '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    write_file(folder / "tiny.bin", bytes);
    write_file(folder / "tiny.gltf", json);
    return folder / "tiny.gltf";
}

}  // namespace gridreel::test
