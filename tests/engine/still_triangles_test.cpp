#include "engine/still_triangles.h"

#include "anim/clip.h"
#include "engine/wave_tracer.h"
#include "rebuild/grid_builder.h"
#include "tests/engine/scenes.h"
#include "tests/rebuild/grid_contents.h"
#include "traversal/tracer.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace gridreel::engine {
namespace {

/// Parts of so many triangles, that move or do not.
anim::FrameGeometry geometry_of(const std::vector<std::pair<std::size_t, bool>>& parts) {
    anim::FrameGeometry geometry;
    for (const auto& [triangles, moves] : parts) {
        anim::Part part;
        part.first_triangle = geometry.triangles.size();
        part.triangle_count = triangles;
        part.moves = moves;
        geometry.parts.push_back(part);
        geometry.triangles.resize(geometry.triangles.size() + triangles);
    }
    geometry.is_shown.assign(parts.size(), true);
    geometry.posed = true;
    return geometry;
}

/// Plays keys at 0, 1, 2 and 3 s.
void animate(anim::Scene& scene, anim::Index node, anim::ChannelPath path, std::uint32_t width,
             std::vector<float> values) {
    anim::Animation& animation = scene.animations.at(0);
    animation.channels.push_back(
        {.object = node, .path = path, .sampler = static_cast<anim::Index>(animation.samplers.size())});
    animation.samplers.push_back({.times_s = {0, 1, 2, 3},
                                  .values = std::move(values),
                                  .width = width,
                                  .interpolation = path == anim::ChannelPath::visibility
                                                       ? anim::Interpolation::step
                                                       : anim::Interpolation::linear});
}

/// In a room a ball that flies and four that stand still. Two of those, with as many triangles each, take
/// turns, and one of another size comes and goes.
anim::Scene blinking_scene() {
    test::SceneBuilder builder;
    builder.add_mesh(test::box(glm::vec3(-2.0f), glm::vec3(3.0f)));
    const anim::Index turn = builder.add_mesh(test::sphere({-1, 0, 0}, 0.1f, 10, false));
    builder.add_mesh(test::sphere({0, -1, 1}, 0.2f, 8, false));
    const anim::Index other_turn = builder.add_mesh(test::sphere({2, 1, 1}, 0.1f, 10, false));
    const anim::Index guest = builder.add_mesh(test::sphere({1, 2, 0}, 0.3f, 6, false));
    const anim::Index flying = builder.add_mesh(test::sphere({0, 0, 0}, 0.1f, 9, false));
    builder.scene.nodes[flying].matrix.reset();
    builder.add_camera({0, 0, 2}, {0, 0, 0}, 0.6);

    builder.scene.animations.resize(1);
    animate(builder.scene, flying, anim::ChannelPath::translation, 3, {0, 0, 0, 1, 0, 0, 1, 2, 0, -1, 0, 1});
    animate(builder.scene, turn, anim::ChannelPath::visibility, 1, {1, 0, 1, 1});
    animate(builder.scene, other_turn, anim::ChannelPath::visibility, 1, {0, 1, 0, 0});
    animate(builder.scene, guest, anim::ChannelPath::visibility, 1, {0, 0, 0, 1});
    return builder.scene;
}

/// A grid that goes by what it is told of still triangles, and the same grid from scratch.
class ComparingTracer final : public traversal::Tracer {
public:
    rebuild::BuildReport rebuild(const rebuild::TriangleView& triangles) override {
        rebuild::TriangleView silent = triangles;
        silent.still = nullptr;
        rebuild::GridBuilder fresh(policy_);
        (void)fresh.rebuild(silent);
        const rebuild::BuildReport report = builder_.rebuild(triangles);
        same = test::grid_contents(builder_.grid()) == test::grid_contents(fresh.grid());
        still = triangles.still;
        return report;
    }
    traversal::TraceReport closest_hits(const traversal::RayBatch&, traversal::HitBatch&) override {
        return {};
    }
    traversal::TraceReport any_hits(const traversal::RayBatch&, traversal::OcclusionBatch&) override {
        return {};
    }

    bool same = false;
    std::shared_ptr<const rebuild::StillTriangles> still;  ///< as told last

private:
    rebuild::ResolutionPolicy policy_{.nest_above = 20};
    rebuild::GridBuilder builder_{policy_};
};

}  // namespace

TEST_CASE("triangles of parts that do not move stand still", "[engine]") {
    const auto still = StillInFrames().find(
        geometry_of({{3, false}, {2, true}, {4, false}, {0, true}, {1, false}, {0, false}, {5, true}}));
    REQUIRE(still);
    CHECK(still->count() == 15);
    CHECK(std::vector(still->runs().begin(), still->runs().end()) ==
          std::vector<rebuild::TriangleRun>{{0, 3}, {5, 10}});
}

TEST_CASE("nothing is said of clips in which everything moves", "[engine]") {
    CHECK_FALSE(StillInFrames().find(geometry_of({{3, true}, {2, true}})));
    CHECK_FALSE(StillInFrames().find(geometry_of({})));
    CHECK_FALSE(StillInFrames().find(geometry_of({{3, true}, {0, false}})));
}

TEST_CASE("what stands still is the same object until other parts are shown", "[engine]") {
    anim::FrameGeometry geometry = geometry_of({{3, false}, {3, false}, {2, true}});
    StillInFrames frames;
    const auto first = frames.find(geometry);
    CHECK(frames.find(geometry) == first);
    geometry.is_shown = {true, false, true};
    const auto second = frames.find(geometry);
    CHECK(second != first);
    geometry.is_shown = {true, true, true};
    CHECK(frames.find(geometry) != first);
}

TEST_CASE("grids of parts that come and go do not depend on what is known to stand still", "[engine]") {
    const anim::Scene scene = blinking_scene();
    WaveTracer waves(scene, anim::choose_clip(scene), test::small_picture());
    ComparingTracer tracer;
    (void)waves.rebuild(tracer);  // not posed yet
    std::set<std::shared_ptr<const rebuild::StillTriangles>> known;
    std::set<std::size_t> sizes;
    std::uint64_t nested = 0;
    for (const double time_s : {0.0, 0.3, 0.6, 1.0, 1.1, 1.2, 2.0, 2.5, 3.0, 3.0, 1.5, 0.5, 0.5, 3.0, 2.9}) {
        CAPTURE(time_s);
        (void)waves.animate(time_s);
        nested += waves.rebuild(tracer).nested_grids;
        REQUIRE(tracer.same);
        REQUIRE(tracer.still);
        known.insert(tracer.still);
        sizes.insert(tracer.still->count());
    }
    CHECK(nested > 0);
    CHECK(sizes.size() == 2);
    CHECK(known.size() == 8);
}

}  // namespace gridreel::engine
