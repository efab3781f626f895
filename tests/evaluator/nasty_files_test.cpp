// The program against the evaluator on files made to be hard to read right.

#include "agreement.h"
#include "random_file.h"
#include "tests/anim/gltf_builder.h"

#include <catch2/catch.hpp>

#include <string>

using namespace gridreel;

TEST_CASE("random files agree with the evaluator vertex by vertex", "[evaluator]") {
    const test::TemporaryFolder folder;
    std::size_t compared = 0;
    for (std::uint32_t seed = 1; seed <= 400; ++seed) {
        CAPTURE(seed);
        const auto file = test::random_file(seed);
        compared += test::check_agreement(seed % 2 == 0 ? folder.write("random.glb", file.glb())
                                                        : folder.write("random.gltf", file.gltf()));
    }
    CHECK(compared > 400 * 12);
}
