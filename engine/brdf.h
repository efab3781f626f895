#pragma once
// How a surface turns light from one direction into light towards another.

#include <glm/vec3.hpp>

namespace gridreel::engine {

/// The metallic-roughness model's parameters at a point (glTF 2.0, appendix B.2).
struct Reflectance {
    glm::vec3 diffuse{0.0f};   ///< albedo of the part below the surface, in [0, 1]
    glm::vec3 specular{0.0f};  ///< reflectance at normal incidence, in [0, 1]
    float alpha = 1.0f;        ///< GGX width: roughness squared, in [0.005, 1]
};

/// A roughness of zero has no highlight that samples could find: the width is kept above 0.005.
/// @param base_color  linear, in [0, 1]
/// @param metallic, roughness  in [0, 1]
[[nodiscard]] Reflectance reflectance(const glm::vec3& base_color, float metallic, float roughness);

/// Radiance towards `view` per irradiance from `light` (1/sr): Lambert below GGX with Schlick's Fresnel and
/// height-correlated Smith masking (glTF 2.0, appendix B.3). Zero below the surface; reciprocal. The share
/// that Fresnel takes from the diffuse part is that of the lower of the two directions rather than of their
/// half vector, which would make white plastic return up to a quarter more light than it receives.
/// All vectors are unit and point away from the surface.
[[nodiscard]] glm::vec3 brdf(const Reflectance& surface, const glm::vec3& normal, const glm::vec3& view,
                             const glm::vec3& light);

/// Share of uniform light from all directions that the highlight reflects towards a viewer
/// (Karis, "Physically Based Shading on Mobile", 2014: a fit to the integral of `brdf`'s highlight).
/// @param cos_view  cosine between normal and viewer, in [0, 1]
[[nodiscard]] glm::vec3 ambient_specular(const Reflectance& surface, float cos_view);

}  // namespace gridreel::engine
