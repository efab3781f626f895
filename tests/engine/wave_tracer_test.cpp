#include "engine/wave_tracer.h"
#include "engine/bounce_rays.h"
#include "engine/frame_renderer.h"
#include "tests/engine/scenes.h"

#include <catch2/catch.hpp>

#include <glm/geometric.hpp>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace gridreel::engine {
namespace {

using test::SceneBuilder;

/// A ball above a floor that fills the picture, under a point light and a directional one.
anim::Scene lit_scene() {
    SceneBuilder builder;
    anim::Primitive ground = test::floor(0.0f, 50.0f);
    ground.material = builder.add_material(test::matte(glm::vec3(0.5f)));
    builder.add_mesh(ground);
    anim::Primitive ball = test::sphere({0, 1.5f, 0}, 1.0f, 16, true);
    ball.material = ground.material;
    builder.add_mesh(ball);
    anim::Light light;
    builder.add_light(light, {1, 6, 2});
    light.kind = anim::Light::Kind::directional;
    builder.add_light(light);
    builder.add_camera({0, 4, 6}, {0, 0.5, 0}, 0.6);
    return builder.scene;
}

/// Remembers what it was asked, and answers as the oracle.
class Recorder final : public traversal::Tracer {
public:
    rebuild::BuildReport rebuild(const rebuild::TriangleView& triangles) override {
        return oracle_->rebuild(triangles);
    }
    traversal::TraceReport closest_hits(const traversal::RayBatch& rays, traversal::HitBatch& hits) override {
        closest_ways.push_back(way_);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (!rays.common_origin) bounces.push_back(rays.direction_of(i));
        }
        const auto report = oracle_->closest_hits(rays, hits);
        if (rays.common_origin) seen += rays.size();
        for (const float t : hits.t) {
            if (!rays.common_origin) bounces_that_hit_nothing += t == std::numeric_limits<float>::infinity();
        }
        return report;
    }
    traversal::TraceReport any_hits(const traversal::RayBatch& rays,
                                    traversal::OcclusionBatch& occluded) override {
        any_ways.push_back(way_);
        const auto report = oracle_->any_hits(rays, occluded);
        if (way_ == 0) {
            for (const std::uint8_t hit : occluded) blocked += hit;
        }
        return report;
    }
    [[nodiscard]] std::span<const std::string_view> ways() const override {
        static constexpr std::array<std::string_view, 2> two{"first", "second"};
        return two;
    }
    void take_way(std::size_t way) override { way_ = way; }

    std::vector<std::size_t> closest_ways, any_ways;
    std::vector<glm::vec3> bounces;
    std::size_t seen = 0, blocked = 0, bounces_that_hit_nothing = 0;

private:
    std::unique_ptr<traversal::Tracer> oracle_ =
        traversal::make_tracer({.kind = traversal::TracerKind::naive, .resolution = {}});
    std::size_t way_ = 0;
};

}  // namespace

TEST_CASE("waves have the rays of a picture", "[engine][waves]") {
    const anim::Scene scene = lit_scene();
    RenderSettings settings = test::small_picture();
    settings.samples = 2;
    FrameRenderer renderer(scene, {}, settings);
    Film film;
    const FrameReport picture = renderer.render(0.0, film);
    REQUIRE(picture.shadow.rays > 0);

    WaveTracer waves(scene, {}, settings);
    (void)waves.animate(0.0);
    const auto tracer = traversal::make_tracer(settings.tracer);
    (void)waves.rebuild(*tracer);
    const WaveReport report = waves.trace(*tracer, Bounce::left_out);
    CHECK(report.primary.report.rays == picture.primary.rays);
    REQUIRE(report.shadow.size() == 1);
    CHECK(report.shadow[0].report.rays == picture.shadow.rays);
    CHECK(report.bounce.empty());
    CHECK(report.primary.ms > 0.0);
    CHECK(report.making_ms > 0.0);
    CHECK(waves.still_triangles() == picture.still_triangles);
    CHECK(waves.moving_triangles() == 0);
}

TEST_CASE("the same waves in many bands, and in every way of a tracer", "[engine][waves]") {
    const anim::Scene scene = lit_scene();
    RenderSettings settings = test::small_picture();
    const auto trace = [&](std::size_t rays_per_band, Recorder& recorder) {
        settings.rays_per_band = rays_per_band;
        WaveTracer waves(scene, {}, settings);
        (void)waves.animate(0.0);
        (void)waves.rebuild(recorder);
        return waves.trace(recorder, Bounce::traced);
    };
    Recorder whole, banded;
    const WaveReport one = trace(1'000'000, whole);
    const WaveReport many = trace(256, banded);

    // Camera rays in the first way; two lights and the bounce in both.
    CHECK(whole.closest_ways == std::vector<std::size_t>{0, 0, 1});
    CHECK(whole.any_ways == std::vector<std::size_t>{0, 1, 0, 1});
    CHECK(banded.closest_ways.size() == 12);
    REQUIRE(one.shadow.size() == 2);
    CHECK(one.shadow[0].report.rays == one.shadow[1].report.rays);

    CHECK(whole.seen == 32 * 32);
    CHECK(whole.blocked > 0);
    CHECK(banded.seen == whole.seen);
    CHECK(banded.blocked == whole.blocked);
    CHECK(many.shadow[0].report.rays == one.shadow[0].report.rays);
    CHECK(many.bounce[0].report.rays == one.bounce[0].report.rays);
    CHECK(banded.bounces_that_hit_nothing == whole.bounces_that_hit_nothing);
    // Every camera ray meets the floor or the ball and bounces: upwards for the most part.
    CHECK(one.bounce[0].report.rays == 32 * 32);
    CHECK(whole.bounces_that_hit_nothing > 32 * 32);  // of twice as many, counting both ways
    CHECK(whole.bounces_that_hit_nothing < 2 * 32 * 32);
}

TEST_CASE("waves do not depend on the number of threads", "[engine][waves]") {
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
    const anim::Scene scene = lit_scene();
    const auto trace = [&](int threads) {
        Recorder recorder;
        tbb::task_arena(threads).execute([&] {
            WaveTracer waves(scene, {}, test::small_picture());
            (void)waves.animate(0.0);
            (void)waves.rebuild(recorder);
            (void)waves.trace(recorder, Bounce::traced);
        });
        return recorder.bounces;
    };
    CHECK(trace(1) == trace(4));
}

TEST_CASE("bounces leave a surface with the cosine's density", "[engine][waves]") {
    const SurfaceShape surface{.position = {3, 4, 5},
                               .smooth_position = {3, 4, 5},
                               .geometric_normal = {0, 0, -1},
                               .normal = {0, 0, -1},
                               .coordinate = 5.0f};
    constexpr std::size_t count = 20'000;
    traversal::RayBatch rays;
    rays.resize(count, std::nullopt, traversal::RayOrder::arbitrary);
    double mean_cosine = 0.0, mean_square = 0.0;
    glm::dvec3 mean(0.0);
    for (std::size_t i = 0; i < count; ++i) {
        set_bounce_ray(surface, static_cast<std::uint32_t>(i), i, rays);
        const glm::vec3 direction = rays.direction_of(i);
        CHECK(glm::length(direction) == Approx(1.0f));
        CHECK(direction.z <= 0.0f);
        CHECK(rays.origin_of(i).z < 5.0f);
        mean_cosine -= double(direction.z) / count;
        mean_square += double(direction.z) * double(direction.z) / count;
        mean += glm::dvec3(direction) / double(count);
    }
    // Of the density cos / pi over the hemisphere: the cosine's mean is 2/3, that of its square 1/2.
    CHECK(mean_cosine == Approx(2.0 / 3.0).margin(0.01));
    CHECK(mean_square == Approx(0.5).margin(0.01));
    CHECK(mean.x == Approx(0.0).margin(0.015));
    CHECK(mean.y == Approx(0.0).margin(0.015));
}

}  // namespace gridreel::engine
