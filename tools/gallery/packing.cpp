#include "tools/gallery/packing.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace gridreel::gallery {

namespace {

template <typename T>
std::vector<std::byte> bytes_of(std::span<const T> elements) {
    const auto bytes = std::as_bytes(elements);
    return {bytes.begin(), bytes.end()};
}

Id add_vectors(Document& document, std::span<const glm::vec3> vectors, Use use) {
    return append(document.accessors,
                  Accessor{.type = "VEC3", .use = use, .count = vectors.size(), .bytes = bytes_of(vectors)});
}

std::int16_t snorm16(double x) {
    return static_cast<std::int16_t>(std::floor(x * 32767.0 + 0.5));
}

}  // namespace

Id add_positions(Document& document, std::span<const glm::vec3> positions) {
    const Id id = add_vectors(document, positions, Use::vertices);
    glm::vec3 low = positions.front(), high = positions.front();
    for (const glm::vec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    document.accessors[id].min = {low.x, low.y, low.z};
    document.accessors[id].max = {high.x, high.y, high.z};
    return id;
}

Id add_normals(Document& document, std::span<const glm::vec3> normals) {
    return add_vectors(document, normals, Use::vertices);
}

Id add_colors(Document& document, std::span<const glm::u8vec4> colors) {
    return append(document.accessors, Accessor{.component = Component::u8,
                                               .type = "VEC4",
                                               .normalized = true,
                                               .use = Use::vertices,
                                               .count = colors.size(),
                                               .bytes = bytes_of(colors)});
}

Id add_joints(Document& document, std::span<const glm::u8vec4> joints) {
    return append(document.accessors, Accessor{.component = Component::u8,
                                               .type = "VEC4",
                                               .use = Use::vertices,
                                               .count = joints.size(),
                                               .bytes = bytes_of(joints)});
}

Id add_weights(Document& document, std::span<const glm::u16vec4> weights) {
    return append(document.accessors, Accessor{.component = Component::u16,
                                               .type = "VEC4",
                                               .normalized = true,
                                               .use = Use::vertices,
                                               .count = weights.size(),
                                               .bytes = bytes_of(weights)});
}

Id add_indices(Document& document, std::span<const glm::uvec3> triangles, std::size_t vertex_count) {
    Accessor accessor{.component = Component::u32, .use = Use::indices, .count = 3 * triangles.size()};
    if (vertex_count <= 65535) {  // index 65535 itself would mean "restart"
        std::vector<glm::u16vec3> narrow(triangles.size());
        std::ranges::transform(triangles, narrow.begin(),
                               [](const glm::uvec3& t) { return glm::u16vec3(t); });
        accessor.component = Component::u16;
        accessor.bytes = bytes_of(std::span<const glm::u16vec3>(narrow));
    } else {
        accessor.bytes = bytes_of(triangles);
    }
    return append(document.accessors, std::move(accessor));
}

Id add_translation_matrices(Document& document, std::span<const glm::dvec3> translations) {
    std::vector<float> values;
    for (const glm::dvec3& t : translations) {
        const glm::vec3 v(t);
        values.insert(values.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, v.x, v.y, v.z, 1});
    }
    return append(document.accessors, Accessor{.type = "MAT4",
                                               .count = translations.size(),
                                               .bytes = bytes_of(std::span<const float>(values))});
}

Id add_times(Document& document, std::span<const float> times_s) {
    const Id id = add_scalars(document, times_s);
    document.accessors[id].min = {times_s.front()};
    document.accessors[id].max = {times_s.back()};
    return id;
}

Id add_translation_keys(Document& document, std::span<const glm::dvec3> keys) {
    const std::vector<glm::vec3> narrow(keys.begin(), keys.end());
    return add_vectors(document, narrow, Use::data);
}

Id add_rotation_keys(Document& document, std::span<const glm::dquat> keys) {
    std::vector<glm::i16vec4> packed;
    glm::dquat previous = keys.front();
    for (glm::dquat q : keys) {
        if (glm::dot(q, previous) < 0.0) q = -q;
        previous = q;
        packed.emplace_back(snorm16(q.x), snorm16(q.y), snorm16(q.z), snorm16(q.w));
    }
    return append(document.accessors, Accessor{.component = Component::i16,
                                               .type = "VEC4",
                                               .normalized = true,
                                               .count = keys.size(),
                                               .bytes = bytes_of(std::span<const glm::i16vec4>(packed))});
}

void animate_translation(Document& document, Id node, Id times, std::span<const glm::dvec3> places) {
    const Id values = add_translation_keys(document, places);
    document.channels.push_back({.node = node, .path = Path::translation, .times = times, .values = values});
}

void animate_rotation(Document& document, Id node, Id times, std::span<const glm::dquat> rotations) {
    const Id values = add_rotation_keys(document, rotations);
    document.channels.push_back({.node = node, .path = Path::rotation, .times = times, .values = values});
}

Id add_scalars(Document& document, std::span<const float> values) {
    return append(document.accessors, Accessor{.count = values.size(), .bytes = bytes_of(values)});
}

}  // namespace gridreel::gallery
