#include "anim/rotation.h"

#include <algorithm>
#include <cmath>

namespace gridreel::anim {

glm::dquat unit_or_identity(const glm::dquat& rotation) {
    const double length = std::sqrt(glm::dot(rotation, rotation));
    return length > 0.0 ? rotation / length : glm::dquat{1.0, 0.0, 0.0, 0.0};
}

glm::dquat slerp_shortest(const glm::dquat& from, const glm::dquat& to, double u) {
    if (from == to) return unit_or_identity(from);

    // q and -q are the same rotation: take the one on the near side of the sphere.
    const double cosine = glm::dot(from, to);
    const glm::dquat near_to = cosine < 0.0 ? -to : to;
    const double angle = std::acos(std::min(std::abs(cosine), 1.0));
    const double sine = std::sin(angle);

    // Nearly parallel: the arc is its chord, and the formula would divide by nothing.
    constexpr double parallel = 1e-9;
    if (sine < parallel) return unit_or_identity(from * (1.0 - u) + near_to * u);
    return unit_or_identity(from * (std::sin((1.0 - u) * angle) / sine) +
                            near_to * (std::sin(u * angle) / sine));
}

}  // namespace gridreel::anim
