#include "scenes.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <numbers>
#include <utility>

namespace gridreel::test {
namespace {

template <class T>
anim::Index append(std::vector<T>& list, const T& value) {
    list.push_back(value);
    return static_cast<anim::Index>(list.size() - 1);
}

glm::dmat4 looking(const glm::dvec3& eye, const glm::dvec3& target) {
    const glm::dvec3 way = glm::normalize(target - eye);
    const glm::dvec3 up = std::abs(way.y) > 0.99 ? glm::dvec3(0.0, 0.0, -1.0) : glm::dvec3(0.0, 1.0, 0.0);
    return glm::inverse(glm::lookAt(eye, target, up));
}

}  // namespace

anim::Index SceneBuilder::add_node(const anim::Node& node) {
    const anim::Index index = append(scene.nodes, node);
    scene.scenes[0].push_back(index);
    return index;
}

anim::Index SceneBuilder::add_material(const anim::Material& material) {
    return append(scene.materials, material);
}

anim::Index SceneBuilder::add_mesh(anim::Primitive primitive, const glm::dmat4& world) {
    anim::Mesh mesh;
    mesh.primitives.push_back(std::move(primitive));
    anim::Node node;
    node.matrix = world;
    node.mesh = append(scene.meshes, mesh);
    return add_node(node);
}

anim::Index SceneBuilder::add_light(const anim::Light& light, const glm::dvec3& position) {
    anim::Node node;
    node.matrix = glm::translate(glm::dmat4(1.0), position);
    node.light = append(scene.lights, light);
    return add_node(node);
}

anim::Index SceneBuilder::add_camera(const glm::dvec3& eye, const glm::dvec3& target, double fov_y_rad) {
    anim::Camera camera;
    camera.fov_y_rad = fov_y_rad;
    anim::Node node;
    node.matrix = looking(eye, target);
    node.camera = append(scene.cameras, camera);
    return add_node(node);
}

anim::Index SceneBuilder::add_orthographic(const glm::dvec3& eye, const glm::dvec3& target,
                                           double half_height) {
    anim::Camera camera;
    camera.kind = anim::Camera::Kind::orthographic;
    camera.x_mag = camera.y_mag = half_height;
    anim::Node node;
    node.matrix = looking(eye, target);
    node.camera = append(scene.cameras, camera);
    return add_node(node);
}

anim::Primitive quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
    anim::Primitive primitive;
    primitive.positions = {a, b, c, d};
    primitive.texcoords[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    primitive.triangles = {{0, 1, 2}, {0, 2, 3}};
    return primitive;
}

anim::Primitive floor(float y, float half) {
    return quad({-half, y, half}, {half, y, half}, {half, y, -half}, {-half, y, -half});
}

anim::Primitive sphere(const glm::vec3& center, float radius, int rings, bool smooth) {
    anim::Primitive primitive;
    const int columns = 2 * rings;
    for (int i = 0; i <= rings; ++i) {
        for (int j = 0; j <= columns; ++j) {
            const double polar = std::numbers::pi * i / rings;
            const double azimuth = 2 * std::numbers::pi * j / columns;
            const glm::vec3 normal(glm::dvec3(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                              std::sin(polar) * std::cos(azimuth)));
            primitive.positions.push_back(center + radius * normal);
            if (smooth) primitive.normals.push_back(normal);
        }
    }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * (columns + 1) + j); };
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < columns; ++j) {
            if (i > 0) primitive.triangles.emplace_back(at(i, j), at(i + 1, j), at(i, j + 1));
            if (i < rings - 1) primitive.triangles.emplace_back(at(i, j + 1), at(i + 1, j), at(i + 1, j + 1));
        }
    }
    return primitive;
}

anim::Primitive box(const glm::vec3& low, const glm::vec3& high) {
    anim::Primitive primitive;
    for (int corner = 0; corner < 8; ++corner) {
        primitive.positions.emplace_back((corner & 1) ? high.x : low.x, (corner & 2) ? high.y : low.y,
                                         (corner & 4) ? high.z : low.z);
    }
    primitive.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                           {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return primitive;
}

anim::Material matte(const glm::vec3& color) {
    anim::Material material;
    material.base_color = glm::vec4(color, 1.0f);
    material.metallic = 0.0f;
    return material;
}

engine::RenderSettings small_picture() {
    engine::RenderSettings settings;
    settings.width = 32;
    settings.height = 32;
    settings.samples = 1;
    settings.lights = engine::LightChoice::file;
    settings.background = glm::vec4(0.0f);
    settings.tracer.kind = traversal::TracerKind::naive;
    return settings;
}

engine::Film render(const anim::Scene& scene, const engine::RenderSettings& settings) {
    engine::FrameRenderer renderer(scene, {}, settings);
    engine::Film film;
    renderer.render(0.0, film);
    return film;
}

}  // namespace gridreel::test
