#pragma once
// Axis-aligned boxes.

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <limits>

namespace gridreel::rebuild {

/// An axis-aligned box; the default is empty and grows by `extend`.
struct Bounds3 {
    glm::vec3 min{std::numeric_limits<float>::infinity()};
    glm::vec3 max{-std::numeric_limits<float>::infinity()};

    [[nodiscard]] bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
    [[nodiscard]] glm::vec3 extent() const { return empty() ? glm::vec3{0.0f} : max - min; }
    void extend(const glm::vec3& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
    void extend(const Bounds3& other) {
        min = glm::min(min, other.min);
        max = glm::max(max, other.max);
    }

    friend bool operator==(const Bounds3&, const Bounds3&) = default;
};

}  // namespace gridreel::rebuild
