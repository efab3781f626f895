#pragma once
// Light that arrives at a point.

#include "anim/scene.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <vector>

namespace gridreel::engine {

/// How a light weakens with distance.
enum class Falloff {
    inverse_square,  ///< as KHR_lights_punctual asks
    none,            ///< the same everywhere: the default key light
};

/// A punctual light of one frame, in world space.
struct PosedLight {
    anim::Light::Kind kind = anim::Light::Kind::point;
    Falloff falloff = Falloff::inverse_square;
    glm::vec3 intensity{1.0f};  ///< linear RGB; candela, lux (directional), or lux everywhere (no falloff)
    glm::vec3 position{0.0f};   ///< point and spot
    glm::vec3 direction{0.0f, 0.0f, -1.0f};  ///< unit, the way it shines; spot and directional
    std::optional<float> range_m{};
    float cone_scale = 0.0f,
          cone_offset = 1.0f;  ///< spot: the angle's factor is saturate(cos * scale + offset)^2
};

/// Light's arrival at a point, before shadows.
struct Arrival {
    glm::vec3 to_light{0.0f};    ///< unit
    float distance = 0.0f;       ///< metres; infinity for a directional light
    glm::vec3 irradiance{0.0f};  ///< on a surface that faces the light, lux
};

/// A light of the file at its node (KHR_lights_punctual). The node's scale does not count.
/// @return nothing when the matrix leaves a spot or directional light without a direction
[[nodiscard]] std::optional<PosedLight> posed_light(const anim::Light& light, const glm::dmat4& world);

/// With the extension's recommended falloff: max(min(1 - (d / range)^4, 1), 0) / d^2, and for spots the
/// squared linear ramp of the angle's cosine between outer and inner cone.
[[nodiscard]] Arrival arrival_at(const PosedLight& light, const glm::vec3& point);

/// Light from all around without shadows: its radiance rises linearly from straight below to straight above.
struct Dome {
    glm::vec3 sky{0.0f}, ground{0.0f};  ///< radiance from straight above and below, linear RGB

    [[nodiscard]] glm::vec3 radiance(const glm::vec3& direction) const;

    /// What a white Lambert surface facing `normal` reflects: irradiance over pi.
    [[nodiscard]] glm::vec3 diffuse(const glm::vec3& normal) const;
};

/// All light of one frame.
struct Lighting {
    std::vector<PosedLight> lights;
    Dome dome;
};

}  // namespace gridreel::engine
