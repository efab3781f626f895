#pragma once
// Values of cameras, lights and materials that KHR_animation_pointer can drive.

#include "anim/scene.h"

#include <cstdint>
#include <span>
#include <string>

namespace gridreel::anim {

/// One value as glTF's object model names it (glTF 2.0 Asset Object Model).
template <class Object>
struct AnimatedProperty {
    std::string pointer;      ///< below the object: "spot/outerConeAngle"
    std::uint32_t width = 1;  ///< numbers, 1 to 4
    /// Sets it from `width` finite numbers. Splines swing past their keys: what leaves the range that the
    /// specification gives is brought back into it.
    void (*set)(Object& object, const float* value) = nullptr;
};

/// In a fixed order, which `Channel::property` counts in.
[[nodiscard]] std::span<const AnimatedProperty<Camera>> camera_properties();
[[nodiscard]] std::span<const AnimatedProperty<Light>> light_properties();
[[nodiscard]] std::span<const AnimatedProperty<Material>> material_properties();

}  // namespace gridreel::anim
