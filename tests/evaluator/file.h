#pragma once
// A glTF file as it lies on disk: its JSON, and the bytes of its buffers.

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gridreel::evaluator {

struct File {
    nlohmann::json json;
    std::vector<std::string> buffers;  ///< bytes, one string per buffer
};

/// Reads a `.glb` or `.gltf` file and every buffer of it (glTF 2.0, sections 2.8, 3.6.1 and 4).
/// @throws std::exception when it is not valid; what is wrong with it is not this evaluator's business
[[nodiscard]] File read_file(const std::filesystem::path& path);

}  // namespace gridreel::evaluator
