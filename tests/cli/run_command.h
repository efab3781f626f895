#pragma once
// Runs the built `gridreel` as its users do.

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace gridreel::test {

struct Outcome {
    int exit_code = -1;  ///< 128 + the signal's number when a signal ended it
    std::string out;
    std::string err;
};

/// Where and how the command runs.
struct Setting {
    std::filesystem::path folder;                  ///< current folder
    std::function<void(int process)> meanwhile{};  ///< called once it has started
    std::vector<std::string> variables{};          ///< of the environment, `NAME=value`
    std::size_t most_memory = 0;                   ///< bytes of address space; 0: as many as it wants
    bool terminal = false;                         ///< stderr is a terminal of 100 columns
    std::filesystem::path out_file{};              ///< where stdout goes instead of `Outcome::out`
    std::filesystem::path err_file{};              ///< where stderr goes instead of `Outcome::err`
};

/// Runs `gridreel` with `arguments` and waits for its end.
[[nodiscard]] Outcome run_gridreel(const std::vector<std::string>& arguments, const Setting& setting);

/// The objects of a JSON-lines file.
[[nodiscard]] std::vector<nlohmann::json> read_log(const std::filesystem::path& file);

/// Of those, the frames.
[[nodiscard]] std::vector<nlohmann::json> frames_of(const std::filesystem::path& file);

}  // namespace gridreel::test
