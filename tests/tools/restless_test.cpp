#include "tools/gallery/restless.h"
#include "tests/tools/played.h"
#include "tools/gallery/mesh_shapes.h"
#include "tools/gallery/packing.h"
#include "tools/gallery/scenes.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

using namespace gridreel::gallery;

TEST_CASE("what stands still in a bundled scene moves once it is kept moving", "[gallery]") {
    for (const auto make : {make_sheet, make_stadium, make_walker}) {
        Document document = make(5'000);
        INFO(document.name);
        CHECK(Played(document).standing_still(0.5, 0.5 + 1.0 / 24.0) > 100);

        keep_moving(document);
        Played played(document);
        CHECK(played.triangles().size() == triangle_count(make(5'000)));
        const int frames = static_cast<int>(std::floor(played.duration_s() * 24.0 + 1e-6));
        for (int frame = 0; frame < frames; ++frame) {
            INFO(frame);
            REQUIRE(played.standing_still(frame / 24.0, (frame + 1) / 24.0) == 0);
        }
    }
}

TEST_CASE("a still mesh goes round a circle of a centimetre, once in the clip", "[gallery]") {
    // Two single triangles: a still one, and one whose node goes 1 m along x in 2 s.
    Document document{.name = "two"};
    const Shape shape{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                      .normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
                      .triangles = {{0, 1, 2}}};
    const Id grey = append(document.materials, {.name = "grey"});
    const Id mesh = add_mesh(document, "triangle", shape, grey);
    add_mesh_node(document, "still", mesh);
    const Id going = add_mesh_node(document, "going", mesh, {5, 0, 0});
    const std::array<float, 2> times{0.0f, 2.0f};
    const std::array<glm::dvec3, 2> places{glm::dvec3(5, 0, 0), glm::dvec3(6, 0, 0)};
    document.channels.push_back({.node = going,
                                 .path = Path::translation,
                                 .times = add_times(document, times),
                                 .values = add_translation_keys(document, places)});
    keep_moving(document);

    // The going one is a root as before, and comes first: 5.25 m on after half a second; a quarter of the
    // circle is behind the other.
    const auto quarter = Played(document).positions(0.5);
    REQUIRE(quarter.size() == 6);
    CHECK(quarter[0].x == Approx(5.25));
    CHECK(quarter[0].z == 0.0f);
    CHECK(quarter[3].x == Approx(0.0).margin(1e-6));
    CHECK(quarter[3].z == Approx(0.01));
}

TEST_CASE("a scene in which everything moves is left as it is", "[gallery]") {
    Document document = make_soup(100);
    const std::size_t nodes = document.nodes.size(), channels = document.channels.size();
    keep_moving(document);
    CHECK(document.nodes.size() == nodes);
    CHECK(document.channels.size() == channels);
}
