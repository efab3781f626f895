#pragma once
// The decoded images behind a scene's materials.

#include "anim/scene.h"
#include "engine/texture.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gridreel::engine {

/// Every image that a material of the scene refers to, decoded once for each meaning it is used with.
class Textures {
public:
    /// Decodes in parallel.
    /// @param scene  outlives the textures
    /// @throws Error naming the first image that cannot be decoded
    explicit Textures(const anim::Scene& scene);

    /// As `engine::sample`; white where the reference, its image or the image's bytes are missing.
    [[nodiscard]] glm::vec4 sample(const std::optional<anim::TextureRef>& ref, Encoding encoding,
                                   const glm::vec2& uv, float footprint) const;

    /// Images without bytes that materials refer to, by name.
    [[nodiscard]] const std::vector<std::string>& missing() const { return missing_; }

private:
    const anim::Scene& scene_;
    std::array<std::vector<std::unique_ptr<Pyramid>>, 2> images_;  ///< by encoding, then image
    std::vector<std::string> missing_;
};

}  // namespace gridreel::engine
