#include "traversal/exact_meeting.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace gridreel::traversal {
namespace {

glm::dvec3 in_double(const FramedPoint& p) {
    return {p.k, p.u, p.v};
}

}  // namespace

std::optional<float> meet_in_double(const FramedPoint& a, const FramedPoint& b, const FramedPoint& c,
                                    float sign, float slope_u, float slope_v) {
    const glm::dvec3 direction{sign, slope_u, slope_v};
    const glm::dvec3 corner[3] = {in_double(a), in_double(b), in_double(c)};
    const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double volume = glm::dot(corner[0], normal);
    const double facing = glm::dot(direction, normal);
    if (volume == 0.0 || facing == 0.0) return std::nullopt;

    for (int i = 0; i < 3; ++i) {
        const double edge = glm::dot(direction, glm::cross(corner[(i + 1) % 3], corner[(i + 2) % 3]));
        if (volume > 0.0 ? !(edge >= 0.0) : !(edge <= 0.0)) return std::nullopt;
    }
    return static_cast<float>(volume / facing);
}

}  // namespace gridreel::traversal
