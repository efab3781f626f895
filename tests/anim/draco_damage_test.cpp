// Draco data that is cut short, damaged, or claims what it does not hold.

#include "anim/gltf/draco_mesh.h"
#include "draco_builder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>

using namespace gridreel;
using namespace gridreel::anim::gltf;
using Catch::Matchers::Contains;

namespace {

DracoRequest request_for(const test::PlainMesh& mesh) {
    return {.points = mesh.positions.size(),
            .triangles = mesh.triangles.size(),
            .attributes =
                {{.name = "POSITION", .unique_id = 0, .components = 3},
                 {.name = "NORMAL", .unique_id = 1, .components = 3},
                 {.name = "COLOR_0", .unique_id = 3, .component = ComponentType::uint8, .components = 4}},
            .most_bytes = std::size_t{1} << 30};
}

/// Either the mesh is whole, every index in range, or there is a reason why not.
void check_whole(const DracoMesh& decoded, const DracoRequest& request) {
    if (!decoded.refusal.empty()) return;
    REQUIRE(decoded.indices.size() == 3 * *request.triangles);
    REQUIRE(std::all_of(decoded.indices.begin(), decoded.indices.end(),
                        [&](std::uint32_t i) { return i < request.points; }));
    REQUIRE(decoded.attributes.size() == request.attributes.size());
    for (std::size_t i = 0; i < request.attributes.size(); ++i)
        REQUIRE(decoded.attributes[i].size() == request.points * request.attributes[i].components *
                                                    byte_count(request.attributes[i].component));
}

const test::DracoSettings settings[] = {{.sequential = true, .speed = 0},
                                        {.sequential = true, .speed = 10},
                                        {.sequential = false, .speed = 0},
                                        {.sequential = false, .speed = 5},
                                        {.sequential = false, .speed = 10}};

/// A stream whose head claims these counts, and nothing else; varints of five bytes.
std::vector<std::byte> claim(bool sequential, std::uint32_t vertices, std::uint32_t triangles) {
    auto bytes = test::bytes_of("DRACO");
    const auto add = [&](unsigned byte) { bytes.push_back(static_cast<std::byte>(byte)); };
    const auto add_varint = [&](std::uint32_t value) {
        for (int k = 0; k < 4; ++k, value >>= 7) add((value & 127) | 128);
        add(value);
    };
    for (const unsigned byte : {2u, 2u, 1u, sequential ? 0u : 1u, 0u, 0u}) add(byte);
    if (!sequential) add(0);  // the standard traversal
    add_varint(sequential ? triangles : vertices);
    add_varint(sequential ? vertices : triangles);
    for (int k = 0; k < 40; ++k) add(0);
    return bytes;
}

}  // namespace

TEST_CASE("Draco data that is cut short is refused", "[draco]") {
    const auto mesh = test::bumpy_sheet(7, 3);
    const auto request = request_for(mesh);
    for (const auto& how : settings) {
        const auto whole = test::encode_draco(mesh, how);
        REQUIRE(decode_draco(whole, request).refusal.empty());
        for (std::size_t size = 0; size < whole.size(); ++size) {
            const auto decoded = decode_draco(std::span(whole).first(size), request);
            // The last bytes may be padding that nothing reads.
            if (size + 8 < whole.size()) REQUIRE_FALSE(decoded.refusal.empty());
            check_whole(decoded, request);
        }
    }
}

TEST_CASE("damaged Draco data gives a whole mesh or none", "[draco]") {
    const auto mesh = test::bumpy_sheet(7, 2);
    const auto request = request_for(mesh);
    for (const auto& how : settings) {
        const auto whole = test::encode_draco(mesh, how);
        for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
            auto damaged = whole;
            damaged[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
            check_whole(decode_draco(damaged, request), request);
            damaged[bit / 8] = static_cast<std::byte>(0xff << bit % 8);
            check_whole(decode_draco(damaged, request), request);
        }
    }
}

TEST_CASE("counts that Draco data claims are checked before memory is allocated", "[draco]") {
    constexpr std::uint32_t billions = std::numeric_limits<std::uint32_t>::max();
    for (const bool sequential : {false, true}) {
        DracoRequest request{.points = 100, .triangles = 100, .most_bytes = std::size_t{512} << 20};
        request.attributes.push_back({.name = "POSITION", .unique_id = 0, .components = 3});
        CHECK_THAT(decode_draco(claim(sequential, 100, billions), request).refusal,
                   Contains("has 4294967295 triangles; the indices state 100"));
        CHECK_THAT(decode_draco(claim(sequential, billions, 100), request).refusal,
                   Contains("has 4294967295 points; the attributes state 100"));

        // Where the file agrees with the claim, memory decides.
        request.points = request.triangles.emplace(billions / 3);
        CHECK_THAT(decode_draco(claim(sequential, billions / 3, billions / 3), request).refusal,
                   Contains("more memory"));
        request.triangles.reset();
        CHECK_THAT(decode_draco(claim(sequential, billions / 3, billions), request).refusal,
                   Contains("more memory"));
    }
}

TEST_CASE("a small file cannot make Draco ask for endless memory", "[draco]") {
    const auto mesh = test::bumpy_sheet(1, 2);
    auto file = test::draco_file(mesh, claim(false, 1'000'000'000, 1'000'000'000));
    for (auto& accessor : file.json["accessors"]) accessor["count"] = 1'000'000'000;
    file.json["accessors"].back()["count"] = 3'000'000'000;
    const auto refusal = test::refusal_of(file);
    CHECK(refusal.pointer == "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression");
    CHECK_THAT(refusal.message, Contains("more memory"));
}

TEST_CASE("attributes count as memory before they are decoded", "[draco]") {
    const auto mesh = test::bumpy_sheet(7, 20);
    auto request = request_for(mesh);
    const auto stream = test::encode_draco(mesh, {});
    // Connectivity alone fits in 64 bytes a triangle and a third of that for each of the tables.
    request.most_bytes = mesh.triangles.size() * 64 + mesh.triangles.size() * 64 + mesh.positions.size() * 96;
    CHECK_THAT(decode_draco(stream, request).refusal, Contains("more memory"));
    request.most_bytes *= 4;
    CHECK(decode_draco(stream, request).refusal.empty());
}

TEST_CASE("more orientations of texture coordinates than corners are refused at once", "[draco]") {
    // Draco alone takes any number of them, billions too, and seconds for it. Their number stands in four
    // bytes somewhere in the stream: where as many as there are corners pass, and one more does not.
    auto mesh = test::bumpy_sheet(7, 3);
    mesh.normals.clear();
    mesh.colors.clear();
    mesh.joints.clear();
    mesh.weights.clear();
    for (const bool seams : {false, true}) {
        if (!seams)
            for (std::size_t i = 0; i < mesh.positions.size(); ++i)
                mesh.texcoords[i] = {mesh.positions[i].x, mesh.positions[i].z};
        else
            mesh.texcoords = test::bumpy_sheet(7, 3).texcoords;
        const auto whole = test::encode_draco(mesh, {.speed = 0});
        DracoRequest request{.triangles = mesh.triangles.size(), .most_bytes = std::size_t{1} << 30};
        // Without a seam, vertices along it are one.
        request.points = seams ? mesh.positions.size() : 16;
        request.attributes.push_back({.name = "TEXCOORD_0", .unique_id = 1, .components = 2});
        REQUIRE(decode_draco(whole, request).refusal.empty());

        const auto refusal_with = [&](std::size_t at, std::size_t count) {
            auto changed = whole;
            for (std::size_t k = 0; k < 4; ++k) changed[at + k] = static_cast<std::byte>(count >> 8 * k);
            return decode_draco(changed, request).refusal;
        };
        const std::size_t corners = 3 * mesh.triangles.size();
        // A few of either kind, as one might be refused by chance.
        const auto is_bounded = [&](std::size_t at) {
            for (std::size_t k = 0; k < 8; ++k)
                if (!refusal_with(at, corners - k).empty() || refusal_with(at, corners + 1 + k).empty())
                    return false;
            return true;
        };
        std::size_t places = 0;
        for (std::size_t at = 11; at + 4 <= whole.size(); ++at) places += is_bounded(at) ? 1 : 0;
        CHECK(places == 1);
    }
}
