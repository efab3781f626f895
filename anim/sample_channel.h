#pragma once
// The value of an animated property between its keys (glTF 2.0, section 3.11 and appendix C).
//
// Before the first key and after the last, everything here holds the nearest key's value.

#include "anim/scene.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <span>

namespace gridreel::anim {

/// A translation or scale at `time_s`.
[[nodiscard]] glm::dvec3 sample_vec3(const Sampler& sampler, double time_s);

/// A rotation at `time_s`, unit length: spherical between linear keys, normalised in every case.
[[nodiscard]] glm::dquat sample_rotation(const Sampler& sampler, double time_s);

/// Any other numbers (morph weights, factors, colours) at `time_s`, into `values` (`sampler.width` of them).
void sample_numbers(const Sampler& sampler, double time_s, std::span<float> values);

/// Whether a flag is set at `time_s`: it keeps each key's value until the next.
[[nodiscard]] bool sample_flag(const Sampler& sampler, double time_s);

/// Whether two times can give different values. When not, every time gives the same bits.
[[nodiscard]] bool varies(const Sampler& sampler);

}  // namespace gridreel::anim
