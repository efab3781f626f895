// Deforming a million vertices, skinned and rigid, beside plain copies of as many bytes, and loading a large
// file. Compare the bytes per second of `deform` and `copy`:
// --benchmark_filter='skin|rigid' --benchmark_enable_random_interleaving --benchmark_repetitions=5

#include "anim/frame_geometry.h"
#include "anim/load.h"
#include "anim/pose.h"

#include <benchmark/benchmark.h>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace gridreel;

constexpr std::size_t vertex_count = 1'000'000;
constexpr anim::Index joint_count = 64;

/// A tube of a million vertices, four joints each, under a chain of joints that all turn.
anim::Scene tube() {
    anim::Primitive skin;
    skin.influences.per_vertex = 4;
    for (std::size_t v = 0; v < vertex_count; ++v) {
        const float along = float(v) / float(vertex_count), around = float(v % 1000) * 0.00628f;
        skin.positions.emplace_back(std::cos(around), 64.0f * along, std::sin(around));
        skin.normals.emplace_back(std::cos(around), 0.0f, std::sin(around));
        const auto joint = static_cast<std::uint16_t>(along * float(joint_count - 4));
        for (std::uint16_t i = 0; i < 4; ++i) {
            skin.influences.joints.push_back(static_cast<std::uint16_t>(joint + i));
            skin.influences.weights.push_back(0.25f);
        }
    }
    skin.triangles = {{0, 1, 2}};

    anim::Scene scene;
    scene.meshes.push_back({.name = "tube", .primitives = {std::move(skin)}, .weights = {}});
    anim::Node bearer;
    bearer.mesh = 0;
    bearer.skin = 0;
    scene.nodes.push_back(bearer);
    anim::Skin joints;
    anim::Animation wave;
    wave.samplers.push_back({.times_s = {0, 1}, .values = {0, 0, 0, 1, 0.1f, 0, 0, 0.995f}, .width = 4});
    for (anim::Index i = 1; i <= joint_count; ++i) {
        anim::Node joint;
        joint.trs.translation = {0, i == 1 ? 0 : 1, 0};
        if (i > 1) joint.parent = i - 1;
        if (i < joint_count) joint.children = {i + 1};
        scene.nodes.push_back(joint);
        joints.joints.push_back(i);
        joints.inverse_bind.emplace_back(1.0);
        wave.channels.push_back({.object = i, .path = anim::ChannelPath::rotation});
    }
    scene.skins.push_back(joints);
    scene.animations.push_back(wave);
    scene.scenes = {{0, 1}};
    return scene;
}

/// The same tube as one stiff piece that a node carries along.
anim::Scene stiff_tube() {
    anim::Scene scene = tube();
    scene.meshes[0].primitives[0].influences = {};
    scene.skins.clear();
    scene.nodes[0].skin.reset();
    scene.animations[0].channels = {{.object = 0, .path = anim::ChannelPath::rotation}};
    return scene;
}

// What a vertex reads and writes: position and normal, and of a skin four joints and weights.
constexpr std::size_t vertex_bytes = 12 + 12, skinned_bytes = vertex_bytes + 8 + 16;

std::int64_t bytes_processed(const benchmark::State& state, std::size_t bytes_read) {
    return state.iterations() * static_cast<std::int64_t>(vertex_count * (bytes_read + vertex_bytes));
}

void deform(benchmark::State& state, const anim::Scene& scene, std::size_t bytes_read) {
    const anim::Clip clip = anim::choose_clip(scene);
    anim::FrameGeometry geometry = anim::lay_out(scene, clip);
    tbb::task_arena arena(static_cast<int>(state.range(0)));
    int frame = 0;
    for (auto _ : state) {
        const anim::Pose pose = anim::pose(scene, clip, 0.001 * (++frame % 1000));
        arena.execute([&] { anim::deform(scene, pose, geometry); });
    }
    state.SetBytesProcessed(bytes_processed(state, bytes_read));
}

/// Writes `vertex_bytes` for each vertex: the k-th word is `word(in, k)`.
template <class Word>
void copy(benchmark::State& state, std::size_t bytes_read, Word word) {
    constexpr std::size_t run = 2048;
    std::vector<std::uint64_t> from(vertex_count * bytes_read / 8, 1), to(vertex_count * vertex_bytes / 8);
    tbb::task_arena arena(static_cast<int>(state.range(0)));
    for (auto _ : state) {
        arena.execute([&] {
            tbb::parallel_for(std::size_t{0}, (vertex_count + run - 1) / run, [&](std::size_t i) {
                const std::size_t first = i * run, count = std::min(run, vertex_count - first);
                const std::uint64_t* const in = from.data() + first * bytes_read / 8;
                std::uint64_t* const out = to.data() + first * vertex_bytes / 8;
                for (std::size_t k = 0; k < count * vertex_bytes / 8; ++k) out[k] = word(in, k);
            });
        });
        benchmark::DoNotOptimize(to.data());
        benchmark::ClobberMemory();
    }
    state.SetBytesProcessed(bytes_processed(state, bytes_read));
}

void skin_deform(benchmark::State& state) {
    deform(state, tube(), skinned_bytes);
}

void skin_copy(benchmark::State& state) {
    copy(state, skinned_bytes,
         [](const std::uint64_t* in, std::size_t k) { return in[2 * k] + in[2 * k + 1]; });
}

void rigid_deform(benchmark::State& state) {
    deform(state, stiff_tube(), vertex_bytes);
}

void rigid_copy(benchmark::State& state) {
    copy(state, vertex_bytes, [](const std::uint64_t* in, std::size_t k) { return in[k]; });
}

/// A binary glTF of `mebibytes` of positions, normals and indices.
std::vector<std::byte> large_file(std::size_t mebibytes) {
    const std::size_t vertices = (mebibytes << 20) / 28;
    const std::size_t attribute = vertices * 12, indices = vertices / 3 * 3 * 4;
    const std::size_t binary = 2 * attribute + indices;
    const auto view = [](std::size_t offset, std::size_t length) {
        return R"({"buffer": 0, "byteOffset": )" + std::to_string(offset) + R"(, "byteLength": )" +
               std::to_string(length) + "}";
    };
    const auto accessor = [](int number, int type, const char* element, std::size_t count) {
        return R"({"bufferView": )" + std::to_string(number) + R"(, "componentType": )" +
               std::to_string(type) + R"(, "type": ")" + element + R"(", "count": )" + std::to_string(count) +
               "}";
    };
    std::string json =
        R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": )"
        R"([{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2}]}], "buffers": [{"byteLength": )" +
        std::to_string(binary) + R"(}], "bufferViews": [)" + view(0, attribute) + ", " +
        view(attribute, attribute) + ", " + view(2 * attribute, indices) + R"(], "accessors": [)" +
        accessor(0, 5126, "VEC3", vertices) + ", " + accessor(1, 5126, "VEC3", vertices) + ", " +
        accessor(2, 5125, "SCALAR", indices / 4) + "]}";
    json.resize((json.size() + 3) / 4 * 4, ' ');

    std::vector<std::byte> file(12 + 8 + json.size() + 8 + binary);
    std::size_t at = 0;
    const auto put = [&](const void* data, std::size_t size) {
        std::memcpy(file.data() + at, data, size);
        at += size;
    };
    const auto put_words = [&](std::initializer_list<std::size_t> words) {
        for (const std::size_t word : words) {
            const auto value = static_cast<std::uint32_t>(word);
            put(&value, sizeof value);
        }
    };
    put_words({0x46546C67, 2, file.size(), json.size(), 0x4E4F534A});
    put(json.data(), json.size());
    put_words({binary, 0x004E4942});
    std::vector<float> numbers(2 * attribute / 4);
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = float(i % 1009) / 1009.0f;
    put(numbers.data(), numbers.size() * sizeof(float));
    std::vector<std::uint32_t> order(indices / 4);
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    put(order.data(), indices);
    return file;
}

void load_large(benchmark::State& state) {
    const std::vector<std::byte> file = large_file(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(anim::load_bytes(file, "large.glb"));
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(file.size()));
}

BENCHMARK(skin_deform)->Arg(1)->Arg(2)->ArgName("threads")->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(skin_copy)->Arg(1)->Arg(2)->ArgName("threads")->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(rigid_deform)->Arg(1)->Arg(2)->ArgName("threads")->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(rigid_copy)->Arg(1)->Arg(2)->ArgName("threads")->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(load_large)->Arg(50)->ArgName("MiB")->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
