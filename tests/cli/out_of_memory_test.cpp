// Where memory ends, so does the command: with a message. Not for the sanitizers, which reserve terabytes.

#include "tests/cli/run_command.h"
#include "tests/cli/tiny_scene.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace gridreel::test;

TEST_CASE("no memory left is exit 70 and one line that says what to do", "[cli][exit_code]") {
    const ScratchFolder folder;
    // Three million triangles, in as few bytes: some 3 GB once laid out.
    write_file(folder / "many.gltf",
               R"({"asset":{"version":"2.0"},"extensionsUsed":["EXT_mesh_gpu_instancing"],
        "accessors":[{"componentType":5126,"type":"VEC3","count":3},{"componentType":5126,"type":"VEC3","count":3000000}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "nodes":[{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1}}}}],
        "scenes":[{"nodes":[0]}]})");
    constexpr std::size_t gigabyte = 1'000'000'000;
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"info", "many.gltf"},
          {"render", "many.gltf", "-s", "16x8", "-f", "0", "-j", "2", "-o", "a.exr"},
          {"bake", "many.gltf", "-f", "0", "-o", "a.####.ply"}}) {
        INFO(arguments.front());
        const Outcome outcome = run_gridreel(arguments, {.folder = folder.path(), .most_memory = gigabyte});
        INFO(outcome.err);
        CHECK(outcome.exit_code == 70);
        CHECK(outcome.err.starts_with("gridreel: error: out of memory; "));
        CHECK(outcome.err.find('\n') == outcome.err.size() - 1);
    }
    CHECK(folder.names() == std::vector<std::string>{"many.gltf"});
}
