#include "sequences/memory_estimate.h"

#include "anim/drawn_textures.h"
#include "engine/film.h"
#include "engine/pixel_order.h"
#include "engine/surface.h"
#include "rebuild/level_sort.h"
#include "rebuild/resolution.h"
#include "rebuild/triangle_view.h"
#include "sequences/frame_writer.h"
#include "traversal/ray_sort.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <glm/gtc/type_precision.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace gridreel::sequences {
namespace {

/// Measured on Debian 12, x86-64: nearly all of it are the libraries that OpenImageIO brings along.
constexpr std::size_t program_bytes = 130u << 20;

template <class T>
std::size_t bytes(const std::vector<T>& values) {
    return values.size() * sizeof(T);
}

std::size_t bytes(const anim::Primitive& primitive) {
    std::size_t sum = bytes(primitive.positions) + bytes(primitive.normals) + bytes(primitive.tangents) +
                      bytes(primitive.texcoords[0]) + bytes(primitive.texcoords[1]) +
                      bytes(primitive.colors) + bytes(primitive.triangles) +
                      bytes(primitive.influences.joints) + bytes(primitive.influences.weights);
    for (const anim::MorphTarget& target : primitive.targets)
        sum += bytes(target.positions) + bytes(target.normals) + bytes(target.tangents);
    return sum;
}

std::size_t scene_bytes(const anim::Scene& scene) {
    std::size_t sum = 0;
    for (const anim::Mesh& mesh : scene.meshes)
        for (const anim::Primitive& primitive : mesh.primitives) sum += bytes(primitive);
    for (const anim::Animation& animation : scene.animations)
        for (const anim::Sampler& sampler : animation.samplers)
            sum += bytes(sampler.times_s) + bytes(sampler.values);
    for (const anim::Image& image : scene.images) sum += bytes(image.encoded);
    return sum;
}

std::size_t geometry_bytes(const anim::FrameGeometry& geometry) {
    return bytes(geometry.positions) + bytes(geometry.normals) + bytes(geometry.tangents) +
           bytes(geometry.texcoords[0]) + bytes(geometry.texcoords[1]) + bytes(geometry.colors) +
           bytes(geometry.triangles) + bytes(geometry.triangle_part);
}

// --- Textures ----------------------------------------------------------------------------------

/// As the image's header says; 0 when there is none that could be read.
std::size_t texel_count(const anim::Image& image) {
    for (const char* const format : {"png", "jpeg", "webp"}) {
        OIIO::Filesystem::IOMemReader reader(image.encoded.data(), image.encoded.size());
        const auto input = OIIO::ImageInput::create(format);
        OIIO::ImageSpec spec;
        if (input && input->set_ioproxy(&reader) && input->open(image.name, spec))
            return static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
        if (input) (void)input->geterror();  // or OpenImageIO would print it
    }
    return 0;
}

std::size_t texture_bytes(const anim::Scene& scene) {
    // An image is decoded once for each meaning it is used with.
    std::set<std::pair<anim::Index, anim::TextureMeaning>> uses;
    for (const anim::Material& material : scene.materials) {
        for (const anim::DrawnTexture& texture : anim::drawn_textures(material)) {
            const auto image = scene.textures[texture.ref.texture].image;
            if (image) uses.emplace(*image, texture.meaning);
        }
    }

    // All smaller sizes together are a third of the largest.
    std::size_t sum = 0;
    for (const auto& [image, meaning] : uses)
        sum += texel_count(scene.images[image]) * sizeof(glm::u16vec4) * 4 / 3;
    return sum;
}

// --- Grid --------------------------------------------------------------------------------------

/// References of one triangle that `rebuild::LevelSort` keeps room for while it finds and counts them.
double room_per_triangle(double references_per_triangle) {
    using rebuild::LevelSort;
    return references_per_triangle <= LevelSort::first_room ? LevelSort::first_room
                                                            : LevelSort::spare_room * references_per_triangle;
}

std::size_t grid_bytes(std::size_t triangle_count, double references_per_triangle, const anim::Box& bounds,
                       const rebuild::ResolutionPolicy& policy, int threads) {
    if (triangle_count == 0) return 0;
    // What lies farther out is in no cell.
    const glm::vec3 reach(rebuild::largest_coordinate);
    const rebuild::Bounds3 box{.min = glm::max(bounds.min, -reach), .max = glm::min(bounds.max, reach)};
    const glm::ivec3 resolution = rebuild::choose_resolution(box, triangle_count, policy);
    const std::size_t cells = static_cast<std::size_t>(resolution.x) *
                              static_cast<std::size_t>(resolution.y) * static_cast<std::size_t>(resolution.z);
    using rebuild::LevelSort;
    // One for each thread, if there is enough to count.
    const auto histograms =
        std::clamp<std::size_t>(triangle_count / LevelSort::triangles_per_chunk, 1,
                                std::min(static_cast<std::size_t>(threads), LevelSort::chunk_limit));
    const auto references = static_cast<std::size_t>(double(triangle_count) * references_per_triangle);
    const auto room =
        static_cast<std::size_t>(double(triangle_count) * room_per_triangle(references_per_triangle));
    return ((1 + histograms) * cells + references + room + triangle_count) * sizeof(std::uint32_t);
}

// --- Pixels ------------------------------------------------------------------------------------

std::size_t pixel_count(const engine::RenderSettings& settings) {
    const std::int32_t height = settings.height.value_or(settings.width * 9 / 16);
    return static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(height);
}

/// Films, and the one that is written as its file will hold it, half floats, and encoded.
std::size_t film_bytes(std::size_t pixels) {
    constexpr std::size_t stored = 4 * sizeof(std::uint16_t);
    return pixels * (films_in_flight * engine::Film::channel_count * sizeof(float) + 2 * stored);
}

/// What `engine::Band` and the tracer keep for each ray.
std::size_t ray_bytes(std::size_t pixels, const engine::RenderSettings& settings) {
    constexpr std::size_t ray = 5 * sizeof(float);  // a direction and its range; the origin is common
    constexpr std::size_t hit = sizeof(float) + sizeof(std::uint32_t);
    constexpr std::size_t shaded = sizeof(engine::Surface) + sizeof(glm::vec3);
    constexpr std::size_t lit = 1 + sizeof(std::uint32_t);
    constexpr std::size_t sorted =
        sizeof(traversal::FramedRay) + sizeof(std::uint32_t) + 2 * sizeof(std::uint64_t);  // SortedRays, keys
    constexpr std::size_t blocked = 1;
    const std::size_t rays =
        std::min(pixels * static_cast<std::size_t>(settings.samples), settings.rays_per_band);
    return pixels * sizeof(engine::Pixel) + rays * (ray + hit + shaded + lit + ray + sorted + blocked);
}

}  // namespace

double assumed_references_per_triangle(std::size_t triangle_count, double lambda) {
    if (triangle_count == 0) return 0.0;
    constexpr double most = 64.0;  // of `rebuild::GridBuilder`
    const double edge = std::sqrt(2.0 / double(triangle_count));
    const double cell = 1.0 / std::cbrt(lambda * double(triangle_count));
    return std::min(std::pow(1.0 + edge / cell, 3.0), most);
}

MemoryEstimate estimate_memory(const anim::Scene& scene, const anim::FrameGeometry& geometry,
                               const anim::Box& bounds, const engine::RenderSettings& settings, int threads) {
    const std::size_t triangles = geometry.triangles.size();
    const std::size_t pixels = pixel_count(settings);
    const rebuild::ResolutionPolicy& policy = settings.tracer.resolution;
    const double references = assumed_references_per_triangle(triangles, double(policy.lambda));
    return {.program = program_bytes,
            .scene = scene_bytes(scene),
            .geometry = geometry_bytes(geometry),
            .textures = texture_bytes(scene),
            .grid = grid_bytes(triangles, references, bounds, policy, threads),
            .films = film_bytes(pixels),
            .rays = ray_bytes(pixels, settings),
            .references_per_triangle = references};
}

}  // namespace gridreel::sequences
