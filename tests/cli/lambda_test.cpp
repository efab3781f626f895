#include "tests/cli/run_command.h"
#include "tests/cli/tiny_scene.h"
#include "tests/sequences/scratch_folder.h"
#include "traversal/lambda_chooser.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

using namespace gridreel;
using namespace gridreel::test;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

const std::filesystem::path stadium = std::filesystem::path(GRIDREEL_GALLERY) / "stadium" / "stadium.glb";

Outcome render(const ScratchFolder& folder, const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"render", stadium.string(),  "-s", "64x36", "--spp", "1",
                                       "-o",     name + ".####.exr"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_gridreel(arguments, {.folder = folder.path()});
}

traversal::MeasuredFrame measured(const json& frame) {
    const auto sum = [](const json& object, std::initializer_list<const char*> names) {
        double total = 0.0;
        for (const char* name : names) total += object.at(name).get<double>();
        return total;
    };
    return {.work = {.triangles = sum(frame["triangles"], {"moving", "still"}),
                     .cells = frame["grid"]["cells_with_nested"],
                     .references = frame["grid"]["references"],
                     .rays = sum(frame["rays"], {"primary", "shadow"}),
                     .visits = frame["steps"]["cells"],
                     .tests = frame["steps"]["tests"]},
            .cost = {.rebuild_ms = frame["ms"]["rebuild"]["total"], .trace_ms = frame["ms"]["trace"]}};
}

}  // namespace

TEST_CASE("the measurements of a log give its choices again", "[cli][lambda]") {
    const ScratchFolder folder;
    REQUIRE(render(folder, "a", {"-f", "0-29"}).exit_code == 0);
    const auto log = read_log(folder / "a.jsonl");
    CHECK(log.front()["options"]["lambda"] == "auto");

    const auto frames = frames_of(folder / "a.jsonl");
    REQUIRE(frames.size() == 30);
    traversal::LambdaChooser chooser(64 * 36);
    std::set<float> lambdas;
    for (const json& frame : frames) {
        INFO(frame["frame"]);
        const traversal::MeasuredFrame was = measured(frame);
        const auto choice = chooser.choose(static_cast<std::size_t>(was.work.triangles));
        CHECK(frame["grid"]["lambda"] == choice.lambda);
        CHECK(frame["predicted_ms"]["rebuild"] == choice.predicted.rebuild_ms);
        CHECK(frame["predicted_ms"]["trace"] == choice.predicted.trace_ms);
        chooser.measured(choice.lambda, was);
        lambdas.insert(choice.lambda);
    }
    CHECK(lambdas.size() > 1);  // it has looked about
}

TEST_CASE("pictures do not depend on lambda", "[cli][lambda]") {
    const ScratchFolder folder;
    const Outcome chosen = render(folder, "auto", {"-f", "0-9", "--lambda", "auto"});
    REQUIRE(chosen.exit_code == 0);
    CHECK_THAT(chosen.out, Contains("\nlambda  "));
    const Outcome fixed = render(folder, "fixed", {"-f", "0-9", "--lambda", "3"});
    REQUIRE(fixed.exit_code == 0);
    CHECK_THAT(fixed.out, !Contains("\nlambda  "));
    REQUIRE(render(folder, "alone", {"-f", "7"}).exit_code == 0);

    for (int f = 0; f < 10; ++f) {
        const std::string number = ".000" + std::to_string(f) + ".exr";
        CHECK(bytes_of(folder / ("auto" + number)) == bytes_of(folder / ("fixed" + number)));
    }
    CHECK(bytes_of(folder / "alone.0007.exr") == bytes_of(folder / "fixed.0007.exr"));
    for (const json& frame : frames_of(folder / "fixed.jsonl")) {
        CHECK(frame["grid"]["lambda"] == 3.0);
        CHECK_FALSE(frame.contains("predicted_ms"));
    }
}

TEST_CASE("a structure without cells has no lambda to choose", "[cli][lambda]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const Outcome outcome = run_gridreel({"render", "tiny.gltf", "-f", "0-1", "-s", "16x8", "--accel",
                                          "naive", "--lambda", "auto", "-o", "a.####.exr"},
                                         {.folder = folder.path()});
    REQUIRE(outcome.exit_code == 0);
    for (const json& frame : frames_of(folder / "a.jsonl")) {
        CHECK(frame["grid"]["lambda"] == 0.0);
        CHECK_FALSE(frame.contains("predicted_ms"));
    }
}

TEST_CASE("what is no lambda is refused by name", "[cli][lambda]") {
    const ScratchFolder folder;
    for (const std::string text : {"0", "-1", "nan", "inf", "many", "1,2"}) {
        INFO(text);
        const Outcome outcome = render(folder, "a", {"-f", "0", "--lambda=" + text});
        CHECK(outcome.exit_code == 2);
        CHECK_THAT(outcome.err, Contains("'" + text + "'") && Contains("--lambda") &&
                                    Contains("a number above 0, paper, or auto"));
    }
    CHECK(folder.names().empty());
}
