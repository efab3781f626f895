#include "engine/brdf.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <numbers>

namespace gridreel::engine {
namespace {

constexpr float smallest_alpha = 0.005f;
constexpr glm::vec3 dielectric_specular{0.04f};

/// Trowbridge-Reitz distribution of microfacet normals.
float ggx_density(float cos_half, float alpha) {
    const float a2 = alpha * alpha;
    const float f = cos_half * cos_half * (a2 - 1.0f) + 1.0f;
    return a2 / (std::numbers::pi_v<float> * f * f);
}

/// Smith's masking and shadowing over 4 (n.l)(n.v).
float smith_visibility(float cos_light, float cos_view, float alpha) {
    const float a2 = alpha * alpha;
    const float light = cos_light * std::sqrt(cos_view * cos_view * (1.0f - a2) + a2);
    const float view = cos_view * std::sqrt(cos_light * cos_light * (1.0f - a2) + a2);
    return 0.5f / (light + view);
}

glm::vec3 schlick_fresnel(const glm::vec3& specular, float cos_half) {
    const float m = glm::clamp(1.0f - cos_half, 0.0f, 1.0f);
    const float m2 = m * m;
    return specular + (glm::vec3(1.0f) - specular) * (m2 * m2 * m);
}

}  // namespace

Reflectance reflectance(const glm::vec3& base_color, float metallic, float roughness) {
    return {.diffuse = base_color * (1.0f - metallic),
            .specular = glm::mix(dielectric_specular, base_color, metallic),
            .alpha = glm::max(roughness * roughness, smallest_alpha)};
}

glm::vec3 brdf(const Reflectance& surface, const glm::vec3& normal, const glm::vec3& view,
               const glm::vec3& light) {
    const float cos_light = glm::dot(normal, light);
    const float cos_view = glm::dot(normal, view);
    if (!(cos_light > 0.0f) || !(cos_view > 0.0f)) return glm::vec3(0.0f);

    const glm::vec3 half = glm::normalize(view + light);
    const glm::vec3 fresnel = schlick_fresnel(surface.specular, glm::dot(view, half));
    const float cos_half = glm::clamp(glm::dot(normal, half), 0.0f, 1.0f);
    const float highlight =
        ggx_density(cos_half, surface.alpha) * smith_visibility(cos_light, cos_view, surface.alpha);
    // What enters below the surface, and gets out again, is what the steeper way's Fresnel term leaves.
    const glm::vec3 turned_back = schlick_fresnel(surface.specular, glm::min(cos_light, cos_view));
    return (glm::vec3(1.0f) - turned_back) * surface.diffuse * std::numbers::inv_pi_v<float> +
           fresnel * highlight;
}

glm::vec3 ambient_specular(const Reflectance& surface, float cos_view) {
    const float roughness = std::sqrt(surface.alpha);
    const glm::vec4 r =
        roughness * glm::vec4{-1.0f, -0.0275f, -0.572f, 0.022f} + glm::vec4{1.0f, 0.0425f, 1.04f, -0.04f};
    const float grazing = glm::min(r.x * r.x, std::exp2(-9.28f * cos_view)) * r.x + r.y;
    const float scale = -1.04f * grazing + r.z;
    const float bias = 1.04f * grazing + r.w;
    return glm::clamp(surface.specular * scale + bias, glm::vec3(0.0f), glm::vec3(1.0f));
}

}  // namespace gridreel::engine
