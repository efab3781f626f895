#include "scenes.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <catch2/catch.hpp>

#include <cstddef>

using namespace gridreel;
using engine::Film;
using test::SceneBuilder;

namespace {

/// A ball on a floor, two lights, cut-outs and several samples: every step of a frame has something to do.
anim::Scene busy_scene() {
    SceneBuilder builder;
    anim::Material holed = test::matte({0.2f, 0.5f, 0.9f});
    holed.alpha_mode = anim::AlphaMode::mask;
    holed.metallic = 0.5f;
    holed.roughness = 0.4f;
    anim::Primitive ball = test::sphere({0, 1, 0}, 1.0f, 10, true);
    ball.material = builder.add_material(holed);
    for (std::size_t i = 0; i < ball.positions.size(); ++i) {
        ball.colors.emplace_back(1.0f, 1.0f, 1.0f, i % 3 == 0 ? 0.0f : 1.0f);
    }
    builder.add_mesh(ball);
    anim::Primitive ground = test::floor(0.0f, 4.0f);
    ground.material = builder.add_material(test::matte(glm::vec3(0.8f)));
    builder.add_mesh(ground);
    anim::Light light;
    light.intensity = 30.0f;
    builder.add_light(light, {2, 4, 2});
    builder.add_light(light, {-3, 3, 1});
    builder.add_camera({2, 3, 5}, {0, 0.7, 0}, 0.7);
    return builder.scene;
}

engine::RenderSettings busy_settings() {
    engine::RenderSettings settings = test::small_picture();
    settings.width = 50;
    settings.height = 37;
    settings.samples = 3;
    return settings;
}

}  // namespace

TEST_CASE("the size of bands does not change a bit of the picture", "[engine]") {
    const anim::Scene scene = busy_scene();
    engine::RenderSettings settings = busy_settings();
    const Film whole = test::render(scene, settings);
    settings.rays_per_band =
        GENERATE(std::size_t{0}, std::size_t{50}, std::size_t{1000}, std::size_t{3 * 300});
    CHECK(test::render(scene, settings).pixels == whole.pixels);
}

TEST_CASE("one thread and four give the same bits", "[engine]") {
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
    const anim::Scene scene = busy_scene();
    const auto with_threads = [&](int threads) {
        Film film;
        tbb::task_arena arena(threads);
        arena.execute([&] { film = test::render(scene, busy_settings()); });
        return film.pixels;
    };
    CHECK(with_threads(1) == with_threads(4));
}

TEST_CASE("every tracer gives the same bits", "[engine]") {
    const anim::Scene scene = busy_scene();
    engine::RenderSettings settings = busy_settings();
    const Film naive = test::render(scene, settings);
    for (const traversal::TracerKind kind : traversal::tracer_kinds()) {
        if (kind == traversal::TracerKind::embree) continue;  // rounds in its own way
        settings.tracer.kind = kind;
        CHECK(test::render(scene, settings).pixels == naive.pixels);
    }
}

TEST_CASE("a renderer's second frame equals a fresh renderer's first", "[engine]") {
    const anim::Scene scene = busy_scene();
    engine::FrameRenderer renderer(scene, {}, busy_settings());
    Film first, second;
    renderer.render(0.0, first);
    renderer.render(0.0, second);
    CHECK(first.pixels == second.pixels);
}

TEST_CASE("the report counts rays: one per sample, and shadow rays where light may arrive", "[engine]") {
    SceneBuilder builder;
    anim::Primitive ground = test::floor(0.0f, 10.0f);
    ground.material = builder.add_material(test::matte(glm::vec3(1.0f)));
    builder.add_mesh(ground);
    anim::Light light;
    builder.add_light(light, {0, 4, 0});   // above: lights every point
    builder.add_light(light, {0, -4, 0});  // below: none
    builder.add_orthographic({0, 9, 0}, {0, 0, 0}, 5.0);
    engine::RenderSettings settings = test::small_picture();
    settings.samples = 2;
    engine::FrameRenderer renderer(builder.scene, {}, settings);
    Film film;
    const engine::FrameReport report = renderer.render(0.0, film);
    CHECK(report.primary.rays == 32 * 32 * 2);
    CHECK(report.shadow.rays == 32 * 32 * 2);
    CHECK(report.still_triangles == 2);
    CHECK(report.moving_triangles == 0);
    CHECK(report.trace_ms >= 0.0);
    CHECK(report.shade_ms >= 0.0);
}
