#include "tests/fuzz/mutate_file.h"

#include "anim/error.h"
#include "anim/gltf/container.h"
#include "tests/anim/gltf_builder.h"
#include "tests/fuzz/mutate_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

namespace gridreel::test {
namespace {

/// What a binary glTF is made of; of a plain one, the JSON.
struct Parts {
    nlohmann::json json;
    std::vector<std::byte> binary;
};

std::optional<Parts> take_apart(std::span<const std::byte> file) {
    try {
        const auto container = anim::gltf::split_container(file, "");
        auto json = nlohmann::json::parse(container.json, nullptr, false);
        if (json.is_discarded()) return {};
        return Parts{.json = std::move(json), .binary = {container.binary.begin(), container.binary.end()}};
    } catch (const Error&) {
        return {};
    }
}

void mutate_binary(Parts& parts, const MutateBytes& mutate) {
    constexpr std::size_t spare = 64;
    const std::size_t used = parts.binary.size();
    parts.binary.resize(used + spare);
    parts.binary.resize(mutate(parts.binary, used));

    // The buffer that is the chunk is as long as it again.
    const auto buffers = parts.json.find("buffers");
    if (buffers == parts.json.end() || !buffers->is_array() || buffers->empty()) return;
    if (auto& first = buffers->front(); first.is_object() && !first.contains("uri"))
        first["byteLength"] = parts.binary.size();
}

}  // namespace

std::size_t mutate_file(std::span<std::byte> room, std::size_t used, unsigned seed,
                        const MutateBytes& mutate) {
    std::mt19937 random(seed);
    const auto way = random() % 8;
    auto parts = way == 0 ? std::nullopt : take_apart(room.first(used));
    if (!parts || !parts->json.is_object()) return mutate(room, used);

    if (way < 3 && !parts->binary.empty())
        mutate_binary(*parts, mutate);
    else
        mutate_json(parts->json, random);
    const auto file = GltfBuilder{.json = std::move(parts->json), .buffer = std::move(parts->binary)}.glb();
    if (file.size() > room.size()) return mutate(room, used);
    std::copy(file.begin(), file.end(), room.begin());
    return file.size();
}

}  // namespace gridreel::test
