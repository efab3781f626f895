#include "sequences/ply.h"
#include "sequences/errors.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>

#include <cstring>
#include <vector>

using namespace gridreel::sequences;
using gridreel::test::ScratchFolder;

namespace {

template <class T>
std::string bytes(std::initializer_list<T> values) {
    std::string text(values.size() * sizeof(T), '\0');
    std::memcpy(text.data(), values.begin(), text.size());
    return text;
}

}  // namespace

TEST_CASE("a PLY file is, byte for byte, what its header says", "[ply]") {
    const ScratchFolder folder;
    const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 2.5f, -1}};
    const std::vector<glm::vec3> normals{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
    const std::vector<glm::uvec3> triangles{{0, 1, 2}, {2, 1, 70000}};
    const std::string faces = bytes<std::uint8_t>({3}) + bytes<std::uint32_t>({0, 1, 2}) +
                              bytes<std::uint8_t>({3}) + bytes<std::uint32_t>({2, 1, 70000});

    write_ply(positions, {}, triangles, folder / "a.ply");
    CHECK(gridreel::test::bytes_of(folder / "a.ply") ==
          "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
          "property float z\nelement face 2\nproperty list uchar uint vertex_indices\nend_header\n" +
              bytes<float>({0, 0, 0, 1, 0, 0, 0, 2.5f, -1}) + faces);

    write_ply(positions, normals, triangles, folder / "a.ply");
    CHECK(gridreel::test::bytes_of(folder / "a.ply") ==
          "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
          "property float z\nproperty float nx\nproperty float ny\nproperty float nz\nelement face 2\n"
          "property list uchar uint vertex_indices\nend_header\n" +
              bytes<float>({0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 2.5f, -1, 1, 0, 0}) + faces);
    CHECK(folder.names() == std::vector<std::string>{"a.ply"});
}

TEST_CASE("a PLY file that cannot be written is an OutputError", "[ply]") {
    const ScratchFolder folder;
    CHECK_THROWS_AS(write_ply({}, {}, {}, folder / "missing/a.ply"), OutputError);
    CHECK(folder.names().empty());
}
