#include "anim/direction_map.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gridreel::anim {
namespace {

template <class T>
DirectionMap map_of(const glm::mat<3, 3, T>& rows) {
    const glm::mat<3, 3, T> cofactors{glm::cross(rows[1], rows[2]), glm::cross(rows[2], rows[0]),
                                      glm::cross(rows[0], rows[1])};
    const T sign = glm::dot(rows[0], cofactors[0]) < T(0) ? T(-1) : T(1);
    return {.tangent_rows = glm::mat3{rows},
            .normal_rows = glm::mat3{cofactors * sign},
            .handedness = static_cast<float>(sign)};
}

float largest_component(const glm::vec3& v) {
    const glm::vec3 size = glm::abs(v);
    return std::max({size.x, size.y, size.z});
}

bool has_direction(const glm::vec3& v) {
    const glm::vec3 most{std::numeric_limits<float>::max()};
    // Not-a-numbers fail every comparison.
    return glm::all(glm::lessThanEqual(glm::abs(v), most)) && v != glm::vec3{0.0f};
}

/// Scaled before squaring, so that tiny and huge vectors keep their direction.
glm::vec3 unit(const glm::vec3& v) {
    const glm::vec3 scaled = v / largest_component(v);
    return scaled * (1.0f / std::sqrt(glm::dot(scaled, scaled)));
}

/// What every normal that has a direction at all is mapped to when space is flattened onto a plane.
glm::vec3 plane_normal(const glm::mat3& normal_rows) {
    const glm::mat3 columns = glm::transpose(normal_rows);
    const std::array choices{columns[0], columns[1], columns[2]};
    const glm::vec3 longest = *std::max_element(
        choices.begin(), choices.end(),
        [](const glm::vec3& a, const glm::vec3& b) { return largest_component(a) < largest_component(b); });
    return has_direction(longest) ? unit(longest) : glm::vec3{0.0f, 0.0f, 1.0f};
}

}  // namespace

DirectionMap direction_map(const glm::dmat3& rows) {
    return map_of(rows);
}

DirectionMap direction_map(const glm::mat3& rows) {
    return map_of(rows);
}

glm::vec3 map_normal(const DirectionMap& map, const glm::vec3& normal) {
    const glm::vec3 mapped = normal * map.normal_rows;
    return has_direction(mapped) ? unit(mapped) : plane_normal(map.normal_rows);
}

glm::vec3 map_tangent(const DirectionMap& map, const glm::vec3& tangent) {
    const glm::vec3 mapped = tangent * map.tangent_rows;
    return has_direction(mapped) ? unit(mapped) : glm::vec3{1.0f, 0.0f, 0.0f};
}

}  // namespace gridreel::anim
