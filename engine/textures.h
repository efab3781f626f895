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
    explicit Textures(const anim::Scene& scene);

    /// As `engine::sample`; white where the reference, its image or the image's pixels are missing.
    [[nodiscard]] glm::vec4 sample(const std::optional<anim::TextureRef>& ref, Encoding encoding,
                                   const glm::vec2& uv, float footprint) const;

    /// Why images that materials refer to have no pixels: a sentence for each, in the file's order. Those
    /// without bytes are not listed: `anim::load` has warned of them.
    [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }

private:
    const anim::Scene& scene_;
    std::array<std::vector<std::unique_ptr<Pyramid>>, 2> images_;  ///< by encoding, then image
    std::vector<std::string> problems_;
};

}  // namespace gridreel::engine
