// Buffer views packed by meshoptimizer's own encoder, held against what went in.

#include "anim/gltf/compressed_view.h"

#include "anim/error.h"
#include "gltf_builder.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

using namespace gridreel;
using namespace gridreel::anim::gltf;
using Catch::Matchers::Contains;

namespace {

using Bytes = std::vector<std::byte>;

/// A stream together with what its extension object says.
struct Packed {
    std::string mode = "ATTRIBUTES", filter = "NONE";
    std::size_t count = 0, stride = 0;
    Bytes encoded;
};

template <class T>
Bytes bytes_of_values(const std::vector<T>& values) {
    const auto* const data = reinterpret_cast<const std::byte*>(values.data());
    return {data, data + values.size() * sizeof(T)};
}

Packed pack_attributes(const Bytes& bytes, std::size_t stride, std::string filter = "NONE") {
    Packed packed{
        .filter = std::move(filter), .count = bytes.size() / stride, .stride = stride, .encoded = {}};
    packed.encoded.resize(meshopt_encodeVertexBufferBound(packed.count, stride));
    auto* const out = reinterpret_cast<unsigned char*>(packed.encoded.data());
    packed.encoded.resize(
        meshopt_encodeVertexBuffer(out, packed.encoded.size(), bytes.data(), packed.count, stride));
    return packed;
}

Packed pack_indices(const std::vector<std::uint32_t>& indices, std::size_t stride, const std::string& mode) {
    Packed packed{.mode = mode, .count = indices.size(), .stride = stride, .encoded = {}};
    packed.encoded.resize(meshopt_encodeIndexSequenceBound(indices.size(), 70000) +
                          meshopt_encodeIndexBufferBound(indices.size(), 70000));
    auto* const out = reinterpret_cast<unsigned char*>(packed.encoded.data());
    const auto encode = [&] {
        return mode == "TRIANGLES"
                   ? meshopt_encodeIndexBuffer(out, packed.encoded.size(), indices.data(), indices.size())
                   : meshopt_encodeIndexSequence(out, packed.encoded.size(), indices.data(), indices.size());
    };
    packed.encoded.resize(encode());
    return packed;
}

DecompressedView unpack(const Packed& packed, Budget budget = {}) {
    const std::string file = "test.gltf";
    const Json json = parse_json(
        fmt::format(
            R"({{"byteLength":{0},"x":{{"count":{1},"byteStride":{2},"mode":"{3}","filter":"{4}"}}}})",
            packed.count * packed.stride, packed.count, packed.stride, packed.mode, packed.filter),
        file);
    const Place view(json, file);
    return decompress_view(view, view.at("x"), packed.encoded, budget);
}

template <class T>
std::vector<T> unpack_as(const Packed& packed) {
    const auto unpacked = unpack(packed);
    REQUIRE(unpacked.refusal.empty());
    std::vector<T> values(unpacked.bytes.size() / sizeof(T));
    std::memcpy(values.data(), unpacked.bytes.data(), values.size() * sizeof(T));
    return values;
}

/// Slowly changing bytes, such as attributes are, with noise in every fourth.
Bytes random_bytes(std::mt19937& random, std::size_t size) {
    Bytes bytes(size);
    for (std::size_t i = 0; i < size; ++i)
        bytes[i] = static_cast<std::byte>(i % 4 == 0 ? random() : i / 64 + random() % 3);
    return bytes;
}

std::vector<std::uint32_t> random_triangles(std::mt19937& random, std::size_t triangles) {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < triangles; ++i)
        for (std::uint32_t k = 0; k < 3; ++k)
            indices.push_back(random() % 4 == 0 ? static_cast<std::uint32_t>(random() % 60000) : i / 2 + k);
    return indices;
}

glm::vec4 random_unit(std::mt19937& random, int components) {
    std::normal_distribution<float> normal;
    glm::vec4 v(0.0f);
    do {
        for (int k = 0; k < components; ++k) v[k] = normal(random);
    } while (glm::length(v) < 0.1f);
    return glm::normalize(v);
}

/// One small stream of each mode and filter.
std::vector<Packed> one_of_each() {
    std::mt19937 random(3);
    std::vector<glm::vec4> units;
    for (int i = 0; i < 20; ++i) units.push_back(random_unit(random, 4));
    Bytes oct(20 * 4), quat(20 * 8), exp(20 * 16);
    meshopt_encodeFilterOct(oct.data(), 20, 4, 8, &units[0].x);
    meshopt_encodeFilterQuat(quat.data(), 20, 8, 12, &units[0].x);
    meshopt_encodeFilterExp(exp.data(), 20, 16, 15, &units[0].x);
    return {pack_attributes(random_bytes(random, 20 * 12), 12),
            pack_attributes(oct, 4, "OCTAHEDRAL"),
            pack_attributes(quat, 8, "QUATERNION"),
            pack_attributes(exp, 16, "EXPONENTIAL"),
            pack_indices(random_triangles(random, 20), 2, "TRIANGLES"),
            pack_indices(random_triangles(random, 20), 4, "INDICES")};
}

}  // namespace

TEST_CASE("compressed attributes come back byte by byte", "[meshopt]") {
    std::mt19937 random(1);
    for (const std::size_t stride : {4u, 8u, 12u, 16u, 64u, 256u})
        for (const std::size_t count : {1u, 2u, 15u, 16u, 17u, 255u, 256u, 257u, 1000u}) {
            INFO(count << " of " << stride);
            const auto bytes = random_bytes(random, count * stride);
            const auto unpacked = unpack(pack_attributes(bytes, stride));
            CHECK(unpacked.refusal.empty());
            CHECK(unpacked.bytes == bytes);
        }
}

TEST_CASE("attributes that never change are not taken for a false claim", "[meshopt]") {
    for (const std::size_t count : {64u, 1000u, 100'000u}) {
        const Bytes bytes(count * 4, std::byte{7});
        CHECK(unpack(pack_attributes(bytes, 4)).bytes == bytes);
    }
}

TEST_CASE("compressed indices come back in order, triangles up to turning", "[meshopt]") {
    std::mt19937 random(2);
    const auto first_lowest = [](const std::vector<std::uint32_t>& indices) {
        auto turned = indices;
        for (std::size_t i = 0; i < turned.size(); i += 3) {
            const auto triangle = turned.begin() + static_cast<std::ptrdiff_t>(i);
            std::rotate(triangle, std::min_element(triangle, triangle + 3), triangle + 3);
        }
        return turned;
    };
    const auto widen = [](const std::vector<std::uint16_t>& narrow) {
        return std::vector<std::uint32_t>(narrow.begin(), narrow.end());
    };
    for (const std::size_t triangles : {1u, 2u, 100u, 1000u}) {
        const auto indices = random_triangles(random, triangles);
        CHECK(unpack_as<std::uint32_t>(pack_indices(indices, 4, "INDICES")) == indices);
        CHECK(widen(unpack_as<std::uint16_t>(pack_indices(indices, 2, "INDICES"))) == indices);
        CHECK(first_lowest(unpack_as<std::uint32_t>(pack_indices(indices, 4, "TRIANGLES"))) ==
              first_lowest(indices));
        CHECK(first_lowest(widen(unpack_as<std::uint16_t>(pack_indices(indices, 2, "TRIANGLES")))) ==
              first_lowest(indices));
    }
}

TEST_CASE("filtered attributes are the original's within a step", "[meshopt]") {
    std::mt19937 random(4);
    for (const std::size_t count : {1u, 3u, 4u, 9u, 500u}) {
        std::vector<glm::vec4> normals, rotations, values;
        for (std::size_t i = 0; i < count; ++i) {
            normals.push_back(random_unit(random, 3));
            rotations.push_back(random_unit(random, 4));
            values.push_back(random_unit(random, 4) * std::exp2(static_cast<float>(random() % 40) - 20.0f));
        }

        Bytes filtered(count * 4);
        meshopt_encodeFilterOct(filtered.data(), count, 4, 8, &normals[0].x);
        const auto bytes = unpack_as<std::int8_t>(pack_attributes(filtered, 4, "OCTAHEDRAL"));
        filtered.assign(count * 8, {});
        meshopt_encodeFilterOct(filtered.data(), count, 8, 14, &normals[0].x);
        const auto shorts = unpack_as<std::int16_t>(pack_attributes(filtered, 8, "OCTAHEDRAL"));
        filtered.assign(count * 8, {});
        meshopt_encodeFilterQuat(filtered.data(), count, 8, 12, &rotations[0].x);
        const auto turns = unpack_as<std::int16_t>(pack_attributes(filtered, 8, "QUATERNION"));
        filtered.assign(count * 16, {});
        meshopt_encodeFilterExp(filtered.data(), count, 16, 15, &values[0].x);
        const auto floats = unpack_as<float>(pack_attributes(filtered, 16, "EXPONENTIAL"));

        for (std::size_t i = 0; i < count; ++i) {
            glm::vec4 coarse(0.0f), fine(0.0f), turn, value;
            for (int k = 0; k < 4; ++k) {
                const std::size_t at = 4 * i + static_cast<std::size_t>(k);
                if (k < 3) coarse[k] = static_cast<float>(bytes[at]) / 127.0f;
                if (k < 3) fine[k] = static_cast<float>(shorts[at]) / 32767.0f;
                turn[k] = static_cast<float>(turns[at]) / 32767.0f;
                value[k] = floats[at];
            }
            CHECK(glm::distance(coarse, normals[i]) < 0.03f);
            CHECK(glm::distance(fine, normals[i]) < 0.0006f);
            const float sign = glm::dot(turn, rotations[i]) < 0.0f ? -1.0f : 1.0f;
            CHECK(glm::distance(turn * sign, rotations[i]) < 0.002f);
            CHECK(glm::distance(value, values[i]) < glm::length(values[i]) * std::exp2(-12.0f));
        }
    }
}

TEST_CASE("compressed data that is cut short is refused, whatever its mode", "[meshopt]") {
    for (const Packed& whole : one_of_each())
        for (std::size_t size = 1; size < whole.encoded.size(); ++size) {
            INFO(whole.mode << ' ' << whole.filter << " to " << size << " bytes");
            auto cut = whole;
            cut.encoded.resize(size);
            CHECK_FALSE(unpack(cut).refusal.empty());
        }
}

TEST_CASE("damaged compressed data gives as many bytes as it says, or none", "[meshopt]") {
    for (const Packed& whole : one_of_each())
        for (std::size_t bit = 0; bit < 8 * whole.encoded.size(); ++bit) {
            auto damaged = whole;
            damaged.encoded[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
            const auto unpacked = unpack(damaged);
            const std::size_t expected = unpacked.refusal.empty() ? whole.count * whole.stride : 0;
            REQUIRE(unpacked.bytes.size() == expected);
        }
}

TEST_CASE("a false count is refused before memory is allocated for it", "[meshopt]") {
    for (Packed packed : one_of_each()) {
        packed.count = 3'000'000'000'000;
        CHECK_THAT(unpack(packed).refusal, Contains("cannot hold 3000000000000 elements"));
    }
}

TEST_CASE("what is decompressed counts as memory that the file asks for", "[meshopt]") {
    const Packed packed = one_of_each().front();
    const std::string file;
    const Json json;
    Budget spent;
    spent.spend(spent.left() - packed.count * packed.stride, Place(json, file));
    CHECK(unpack(packed, spent).refusal.empty());
    spent.spend(1, Place(json, file));
    CHECK_THROWS_WITH(unpack(packed, spent), Contains("more memory"));
}

TEST_CASE("what only younger readers understand is named", "[meshopt]") {
    Packed packed = one_of_each().front();
    packed.encoded[0] = std::byte{0xa1};
    CHECK_THAT(unpack(packed).refusal, Contains("version 1"));

    Packed color = one_of_each()[1];
    color.filter = "COLOR";
    CHECK_THAT(unpack(color).refusal, Contains("COLOR"));
}
