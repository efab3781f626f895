#include "anim/placement.h"

#include "anim/box.h"

#include <glm/matrix.hpp>

#include <cassert>
#include <cstddef>

namespace gridreel::anim {

glm::vec3 centre_of(std::span<const glm::vec3> positions) {
    Box box;
    for (const glm::vec3& position : positions) box.extend(position);
    return box.empty() ? glm::vec3{0.0f} : glm::vec3{(glm::dvec3{box.min} + glm::dvec3{box.max}) * 0.5};
}

void round_maps(std::span<const glm::dmat4> maps, Placement& placement, std::span<AffineRows> rows) {
    assert(!maps.empty() && maps.size() == rows.size());
    const glm::dvec4 centre{glm::dvec3{placement.centre}, 1.0};

    glm::dvec3 sum{0.0};
    std::size_t mirroring = 0;
    for (const glm::dmat4& map : maps) {
        sum += glm::dvec3{map * centre};
        if (glm::determinant(glm::dmat3{map}) < 0.0) ++mirroring;
    }
    placement.origin = glm::vec3{sum / double(maps.size())};
    placement.mirrored = 2 * mirroring > maps.size();

    for (std::size_t i = 0; i < maps.size(); ++i) {
        const glm::dmat3 linear = glm::transpose(glm::dmat3{maps[i]});
        const glm::dvec3 offset = glm::dvec3{maps[i] * centre} - glm::dvec3{placement.origin};
        for (glm::length_t axis = 0; axis < 3; ++axis)
            rows[i].row[std::size_t(axis)] = glm::vec4{glm::dvec4{linear[axis], offset[axis]}};
    }
    placement.directions = direction_map(glm::transpose(glm::dmat3{maps[0]}));
}

}  // namespace gridreel::anim
