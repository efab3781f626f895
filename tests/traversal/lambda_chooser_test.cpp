#include "traversal/lambda_chooser.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace gridreel::traversal {
namespace {

constexpr std::size_t triangle_count = 80'000;
constexpr std::uint64_t camera_ray_count = 1'000'000;

/// A scene as the chooser sees it: its work and the time it takes, for any λ.
struct Scene {
    std::string name;
    std::function<MeasuredFrame(double lambda)> at;

    [[nodiscard]] double best_ms() const {
        double best = std::numeric_limits<double>::infinity();
        for (const float lambda : LambdaChooser::ladder)
            best = std::min(best, at(double(lambda)).cost.frame_ms());
        return best;
    }
};

/// What work costs on some machine, which is not the one that the built-in constants come from: in
/// nanoseconds.
struct Machine {
    double triangle = 20.0, cell = 2.0, reference = 15.0;
    double ray = 30.0, visit = 20.0, meeting = 5.0, test = 4.0;

    [[nodiscard]] MeasuredFrame run(const GridWork& work) const {
        return {.work = work,
                .cost = {.rebuild_ms = 1e-6 * (triangle * work.triangles + cell * work.cells +
                                               reference * work.references),
                         .trace_ms = 1e-6 * (ray * work.rays + visit * work.visits +
                                             meeting * work.meetings() + test * work.tests)}};
    }
};

/// Triangles of a cell's size at λ = 1, in `visits` cells a ray there.
GridWork soup(double lambda, double rays, double visits) {
    const double size = std::cbrt(lambda);
    return {.triangles = double(triangle_count),
            .cells = lambda * double(triangle_count),
            .references = double(triangle_count) * std::pow(1.0 + size, 2.2),
            .rays = rays,
            .visits = rays * visits * std::pow(lambda, 0.4),
            .tests = 6.0 * rays};
}

std::vector<Scene> scenes() {
    return {
        {.name = "a picture", .at = [](double l) { return Machine{}.run(soup(l, 1.8e6, 0.3)); }},
        {.name = "few rays: rebuilding is all",
         .at = [](double l) { return Machine{}.run(soup(l, 1e4, 0.3)); }},
        {.name = "many rays, deep", .at = [](double l) { return Machine{}.run(soup(l, 2e7, 2.0)); }},
        {.name = "costly references: many cells",
         .at = [](double l) { return Machine{.visit = 2.0, .meeting = 60.0}.run(soup(l, 2e7, 2.0)); }},
        {.name = "costly cells: few of them",
         .at = [](double l) { return Machine{.visit = 100.0, .meeting = 0.5}.run(soup(l, 2e6, 2.0)); }},
        {.name = "nested grids up to λ = 1",
         .at =
             [](double l) {
                 GridWork work = soup(l, 1.8e6, 0.3);
                 if (l <= 1.0) work.references *= 2.5;
                 if (l <= 1.0) work.visits *= 1.5;
                 return Machine{}.run(work);
             }},
        {.name = "times the model cannot explain",
         .at =
             [](double l) {
                 MeasuredFrame frame = Machine{}.run(soup(l, 1.8e6, 0.3));
                 if (l < 1.0) frame.cost.trace_ms *= 1.2;
                 return frame;
             }},
    };
}

struct Run {
    std::vector<float> lambdas;
    double late_ms = 0.0;  ///< mean of the second half, without noise
    int late_changes = 0;
};

/// @param noise  share by which times are longer, now and then, never shorter
Run run(const Scene& scene, double noise, int frames = 120) {
    std::mt19937 random(1);
    std::exponential_distribution<double> delay(1.0);
    LambdaChooser chooser(camera_ray_count);
    Run result;
    for (int i = 0; i < frames; ++i) {
        const float lambda = chooser.choose(triangle_count).lambda;
        MeasuredFrame frame = scene.at(double(lambda));
        if (i >= frames / 2) {
            result.late_ms += frame.cost.frame_ms() / (frames - frames / 2);
            result.late_changes += lambda != result.lambdas.back();
        }
        result.lambdas.push_back(lambda);
        frame.cost.rebuild_ms *= 1.0 + noise * delay(random);
        frame.cost.trace_ms *= 1.0 + noise * delay(random);
        chooser.measured(lambda, frame);
    }
    return result;
}

}  // namespace

TEST_CASE("the chosen lambda is within a tenth of the best and stays", "[lambda]") {
    for (const Scene& scene : scenes()) {
        INFO(scene.name);
        const Run quiet = run(scene, 0.0);
        CHECK(quiet.late_ms <= 1.1 * scene.best_ms());
        CHECK(quiet.late_changes == 0);
    }
}

TEST_CASE("noise does not drive lambda about", "[lambda]") {
    for (const Scene& scene : scenes()) {
        for (const double noise : {0.05, 0.2}) {
            INFO(scene.name << ", noise " << noise);
            const Run noisy = run(scene, noise);
            CHECK(noisy.late_ms <= 1.1 * scene.best_ms());
            CHECK(noisy.late_changes <= 12);
        }
    }
}

TEST_CASE("looking for the best lambda costs little", "[lambda]") {
    for (const Scene& scene : scenes()) {
        INFO(scene.name);
        double ms = 0.0;
        for (const float lambda : run(scene, 0.0).lambdas) ms += scene.at(double(lambda)).cost.frame_ms();
        CHECK(ms <= 1.05 * 120 * std::max(scene.best_ms(), run(scene, 0.0).late_ms));
    }
}

TEST_CASE("a scene that changes is followed", "[lambda]") {
    const Scene few = scenes()[1], many = scenes()[3];
    LambdaChooser chooser(camera_ray_count);
    for (int i = 0; i < 100; ++i) {
        const float lambda = chooser.choose(triangle_count).lambda;
        chooser.measured(lambda, few.at(double(lambda)));
    }
    CHECK(few.at(double(chooser.choose(triangle_count).lambda)).cost.frame_ms() <= 1.1 * few.best_ms());
    for (int i = 0; i < 200; ++i) {
        const float lambda = chooser.choose(triangle_count).lambda;
        chooser.measured(lambda, many.at(double(lambda)));
    }
    CHECK(many.at(double(chooser.choose(triangle_count).lambda)).cost.frame_ms() <= 1.1 * many.best_ms());
}

TEST_CASE("the first guess has more cells where there are more rays a triangle", "[lambda]") {
    const float busy = LambdaChooser(100'000'000).choose(10'000).lambda;
    const float idle = LambdaChooser(10'000).choose(1'000'000).lambda;
    CHECK(busy > idle);
    CHECK(idle == LambdaChooser::ladder.front());
}

TEST_CASE("what was measured decides, nothing else", "[lambda]") {
    const Scene scene = scenes().front();
    CHECK(run(scene, 0.2).lambdas == run(scene, 0.2).lambdas);

    const LambdaChooser chooser(camera_ray_count);
    const LambdaChoice first = chooser.choose(triangle_count), second = chooser.choose(triangle_count);
    CHECK(first.lambda == second.lambda);
    CHECK(first.predicted.frame_ms() == second.predicted.frame_ms());
}

TEST_CASE("predictions come true where the model holds", "[lambda]") {
    const Scene scene = scenes().front();
    LambdaChooser chooser(camera_ray_count);
    LambdaChoice choice;
    for (int i = 0; i < 50; ++i) {
        choice = chooser.choose(triangle_count);
        chooser.measured(choice.lambda, scene.at(double(choice.lambda)));
    }
    const GridCost cost = scene.at(double(choice.lambda)).cost;
    CHECK(choice.predicted.rebuild_ms == Approx(cost.rebuild_ms).epsilon(0.03));
    CHECK(choice.predicted.trace_ms == Approx(cost.trace_ms).epsilon(0.03));
}

TEST_CASE("frames that make no sense do no harm", "[lambda]") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const auto is_sound = [](const LambdaChooser& chooser) {
        for (const std::size_t triangles : {std::size_t{0}, std::size_t{1}, triangle_count}) {
            const LambdaChoice choice = chooser.choose(triangles);
            const auto& ladder = LambdaChooser::ladder;
            if (std::find(ladder.begin(), ladder.end(), choice.lambda) == ladder.end()) return false;
            const double ms = choice.predicted.frame_ms();
            if (!std::isfinite(ms) || ms < 0.0) return false;
        }
        return true;
    };
    const GridWork usual = soup(1.0, 1e6, 0.3);
    std::vector<GridWork> works(6, usual);
    works[1].triangles = works[1].cells = works[1].references = 0.0;
    works[2].rays = works[2].visits = works[2].tests = 0.0;
    works[3].cells = nan;
    works[4].visits = infinity;
    works[5].references = -1.0;

    CHECK(is_sound(LambdaChooser(0)));
    CHECK(is_sound(LambdaChooser(std::numeric_limits<std::uint64_t>::max())));
    LambdaChooser all(camera_ray_count);
    for (const float lambda : {1.0f, 8.0f, 3.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
        for (const GridWork& work : works) {
            for (const double ms : {nan, infinity, -1.0, 0.0, 1e-300, 1e300, 10.0}) {
                LambdaChooser one(camera_ray_count);
                for (LambdaChooser* chooser : {&one, &all}) {
                    chooser->measured(lambda, {.work = work, .cost = {.rebuild_ms = ms, .trace_ms = ms}});
                    CHECK(is_sound(*chooser));
                }
            }
        }
    }

    // It still works after all that, once it has been forgotten.
    const Scene scene = scenes().front();
    for (int i = 0; i < 300; ++i) {
        const float lambda = all.choose(triangle_count).lambda;
        all.measured(lambda, scene.at(double(lambda)));
    }
    CHECK(scene.at(double(all.choose(triangle_count).lambda)).cost.frame_ms() <= 1.1 * scene.best_ms());
}

TEST_CASE("only grids whose lambda is to be chosen have a chooser", "[lambda]") {
    const auto has_one = [](TracerKind kind, LambdaRule rule) {
        return make_lambda_chooser({.kind = kind, .resolution = {}, .lambda = rule}, 1).has_value();
    };
    CHECK(has_one(TracerKind::grid, LambdaRule::by_cost));
    CHECK(has_one(TracerKind::grid_single, LambdaRule::by_cost));
    CHECK_FALSE(has_one(TracerKind::grid, LambdaRule::fixed));
    CHECK_FALSE(has_one(TracerKind::naive, LambdaRule::by_cost));
    CHECK_FALSE(has_one(TracerKind::embree, LambdaRule::by_cost));
}

TEST_CASE("a grid tracer takes another lambda at the next rebuild", "[lambda]") {
    for (const TracerKind kind : {TracerKind::grid, TracerKind::grid_single}) {
        const auto tracer = make_tracer({.kind = kind, .resolution = {.lambda = 2.0f}});
        CHECK(tracer->rebuild({}).lambda == 2.0f);
        tracer->set_lambda(0.25f);
        CHECK(tracer->rebuild({}).lambda == 0.25f);
        CHECK_THROWS_AS(tracer->set_lambda(0.0f), std::invalid_argument);
        CHECK(tracer->rebuild({}).lambda == 0.25f);
    }
    const auto naive = make_tracer({.kind = TracerKind::naive, .resolution = {}});
    naive->set_lambda(0.25f);
    CHECK(naive->rebuild({}).lambda == 0.0f);
}

}  // namespace gridreel::traversal
