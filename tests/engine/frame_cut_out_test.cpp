#include "encoded_images.h"
#include "scenes.h"

#include <glm/gtc/matrix_transform.hpp>

#include <catch2/catch.hpp>

using namespace gridreel;
using engine::Film;
using test::SceneBuilder;

namespace {

/// A curtain in the plane z = 0, 2 m wide and high, before a red wall at z = -2; seen from z = 5 along -z,
/// 4 m high. The light stands at z = 2 on the view axis: the curtain's shadow on the wall is 4 m wide.
struct CurtainScene {
    SceneBuilder builder;
    anim::Index curtain = 0;  ///< material

    explicit CurtainScene(bool facing_viewer = true) {
        anim::Primitive cloth = facing_viewer ? test::quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0})
                                              : test::quad({1, -1, 0}, {-1, -1, 0}, {-1, 1, 0}, {1, 1, 0});
        cloth.texcoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
        curtain = builder.add_material(test::matte({0, 1, 0}));
        cloth.material = curtain;
        builder.add_mesh(cloth);
        anim::Primitive wall = test::quad({-9, -9, -2}, {9, -9, -2}, {9, 9, -2}, {-9, 9, -2});
        wall.material = builder.add_material(test::matte({1, 0, 0}));
        builder.add_mesh(wall);
        anim::Light light;
        light.intensity = 50.0f;
        builder.add_light(light, {0, 0, 2});
        builder.add_orthographic({0, 0, 5}, {0, 0, 0}, 4.0);
    }

    anim::Material& material() { return builder.scene.materials[curtain]; }

    /// Gives the curtain a texture of one row: its left half opaque, its right half not.
    void cut_right_half() {
        builder.scene.images = {test::png(2, 1, 4, {255, 255, 255, 255, 255, 255, 255, 0})};
        builder.scene.textures = {{.image = 0,
                                   .wrap_s = anim::Wrap::clamp_to_edge,
                                   .wrap_t = anim::Wrap::clamp_to_edge,
                                   .mag_filter = anim::Filter::nearest}};
        material().base_color_texture = anim::TextureRef{.texture = 0};
        material().alpha_mode = anim::AlphaMode::mask;
    }
};

enum class Seen { curtain, wall, shadow };

/// What the pixel at (x, y) metres of the picture shows.
Seen seen(const Film& film, double x, double y) {
    const auto column = static_cast<int>((x + 4.0) / 8.0 * film.width);
    const auto row = static_cast<int>((4.0 - y) / 8.0 * film.height);
    const float* pixel = film.pixel(column, row);
    if (pixel[Film::Z] < 6.0f) return Seen::curtain;
    return pixel[Film::R] > 0.0f ? Seen::wall : Seen::shadow;
}

Film picture(const CurtainScene& scene) {
    engine::RenderSettings settings = test::small_picture();
    settings.width = settings.height.emplace(64);
    return test::render(scene.builder.scene, settings);
}

}  // namespace

TEST_CASE("an opaque curtain hides and shadows, whatever its texture's alpha", "[engine]") {
    CurtainScene scene;
    scene.cut_right_half();
    scene.material().alpha_mode = anim::AlphaMode::opaque;
    const Film film = picture(scene);
    CHECK(seen(film, -0.5, 0.0) == Seen::curtain);
    CHECK(seen(film, 0.5, 0.0) == Seen::curtain);
    CHECK(seen(film, -1.5, 0.5) == Seen::shadow);
    CHECK(seen(film, 1.5, 0.5) == Seen::shadow);
    CHECK(seen(film, 3.0, 0.0) == Seen::wall);
}

TEST_CASE("camera and shadow rays pass through what a mask cuts out", "[engine]") {
    CurtainScene scene;
    scene.cut_right_half();
    const Film film = picture(scene);
    CHECK(seen(film, -0.5, 0.0) == Seen::curtain);
    CHECK(seen(film, 0.5, 0.0) == Seen::wall);
    CHECK(seen(film, -1.5, 0.5) == Seen::shadow);
    CHECK(seen(film, 1.5, 0.5) == Seen::wall);
    CHECK(seen(film, -0.5, 1.5) == Seen::shadow);
    CHECK(seen(film, 0.5, 1.5) == Seen::wall);
}

TEST_CASE("alpha at the cutoff is kept, below it is cut", "[engine]") {
    CurtainScene scene;
    scene.material().alpha_mode = anim::AlphaMode::mask;
    scene.material().base_color.w = 0.5f;
    scene.material().alpha_cutoff = 0.5f;
    CHECK(seen(picture(scene), 0.5, 0.0) == Seen::curtain);
    scene.material().alpha_cutoff = 0.500001f;
    CHECK(seen(picture(scene), 0.5, 0.0) == Seen::wall);
    CHECK(seen(picture(scene), 1.5, 0.5) == Seen::wall);
}

TEST_CASE("vertex colours take part in the cut-out", "[engine]") {
    CurtainScene scene;
    scene.material().alpha_mode = anim::AlphaMode::mask;
    scene.builder.scene.meshes[0].primitives[0].colors.assign(4, glm::vec4(1, 1, 1, 0.2f));
    CHECK(seen(picture(scene), 0.5, 0.0) == Seen::wall);
}

TEST_CASE("the back of a single-sided surface is not seen but casts a shadow", "[engine]") {
    CurtainScene scene(false);
    const Film film = picture(scene);
    CHECK(seen(film, 0.5, 0.0) == Seen::shadow);
    CHECK(seen(film, 1.5, 0.5) == Seen::shadow);
}

TEST_CASE("the back of a double-sided surface is seen, lit and its normal faces the viewer", "[engine]") {
    const bool smooth = GENERATE(false, true);
    CurtainScene scene(false);
    scene.material().double_sided = true;
    if (smooth) scene.builder.scene.meshes[0].primitives[0].normals.assign(4, glm::vec3(0, 0, -1));
    const Film film = picture(scene);
    CHECK(seen(film, 0.5, 0.0) == Seen::curtain);
    CHECK(film.pixel(34, 30)[Film::G] > 1.0f);
    CHECK(film.pixel(34, 30)[Film::NZ] == Approx(1.0f));
}

TEST_CASE("a mirrored node turns winding and front together", "[engine]") {
    CurtainScene scene;
    scene.builder.scene.nodes[0].matrix = glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));
    CHECK(seen(picture(scene), 0.5, 0.0) == Seen::curtain);
}

TEST_CASE("rays pass many cut-outs one behind the other", "[engine]") {
    CurtainScene scene;
    scene.cut_right_half();
    for (int i = 1; i < 40; ++i) {
        anim::Primitive copy = scene.builder.scene.meshes[0].primitives[0];
        for (glm::vec3& position : copy.positions) position.z -= 0.02f * static_cast<float>(i);
        scene.builder.add_mesh(copy);
    }
    const Film film = picture(scene);
    CHECK(seen(film, -0.5, 0.0) == Seen::curtain);
    CHECK(seen(film, 0.5, 0.0) == Seen::wall);
    CHECK(seen(film, 1.2, 0.5) == Seen::wall);
}

TEST_CASE("a sheet modelled as two coinciding sides shows the side that faces the viewer", "[engine]") {
    // The side that faces away comes first in the file, so at equal distance it is the tracer's answer.
    CurtainScene scene(false);
    anim::Primitive front = scene.builder.scene.meshes[0].primitives[0];
    for (glm::uvec3& triangle : front.triangles) std::swap(triangle.y, triangle.z);
    scene.builder.scene.meshes[0].primitives.push_back(front);
    const Film film = picture(scene);
    CHECK(seen(film, 0.5, 0.0) == Seen::curtain);
    CHECK(seen(film, -0.7, 0.6) == Seen::curtain);
}

TEST_CASE("a picture cut out of a wall's own triangles shows the wall behind it", "[engine]") {
    // Decal and wall have the very same corners; whichever comes first in the file, the ray meets both.
    const bool decal_first = GENERATE(true, false);
    CurtainScene scene;
    scene.cut_right_half();
    anim::Primitive wall = scene.builder.scene.meshes[0].primitives[0];
    wall.material = scene.builder.scene.meshes[1].primitives[0].material;
    if (GENERATE(false, true)) {  // the same quad, cut along its other diagonal
        wall.triangles = {{1, 2, 3}, {3, 0, 1}};
    }
    auto& primitives = scene.builder.scene.meshes[0].primitives;
    primitives.insert(decal_first ? primitives.end() : primitives.begin(), wall);
    const Film film = picture(scene);
    for (int row = 28; row < 36; ++row) {
        const float* pixel = film.pixel(36, row);  // the cut-out half
        CHECK(pixel[Film::Z] == Approx(5.0f));
        CHECK(pixel[Film::R] > 0.5f);
        CHECK(pixel[Film::G] < 0.1f * pixel[Film::R]);  // its highlight is white
    }
    if (decal_first) CHECK(film.pixel(28, 31)[Film::G] > 0.5f);
}

TEST_CASE("many coinciding sheets are passed one by one", "[engine]") {
    CurtainScene scene(false);  // seen from behind: culled, a hundred times over
    auto& primitives = scene.builder.scene.meshes[0].primitives;
    primitives.resize(100, primitives[0]);
    primitives.push_back(primitives[0]);
    for (glm::uvec3& triangle : primitives.back().triangles) std::swap(triangle.y, triangle.z);
    CHECK(seen(picture(scene), 0.5, 0.0) == Seen::curtain);
}

TEST_CASE("a blended material is drawn opaque, and a note says so", "[engine]") {
    CurtainScene scene;
    scene.material().alpha_mode = anim::AlphaMode::blend;
    scene.material().name = "veil";
    scene.material().base_color.w = 0.1f;
    CHECK(seen(picture(scene), 0.5, 0.0) == Seen::curtain);
    const engine::FrameRenderer renderer(scene.builder.scene, {}, test::small_picture());
    REQUIRE(renderer.notes().size() == 1);
    CHECK_THAT(renderer.notes()[0], Catch::Contains("veil") && Catch::Contains("opaque"));
}
