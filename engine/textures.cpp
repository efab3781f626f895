#include "engine/textures.h"

#include "engine/image_decode.h"

#include <oneapi/tbb/parallel_for.h>

#include <cstddef>
#include <exception>
#include <set>
#include <utility>

namespace gridreel::engine {
namespace {

using Use = std::pair<anim::Index, Encoding>;  // an image and what it means

std::set<Use> uses(const anim::Scene& scene) {
    std::set<Use> found;
    const auto add = [&](const std::optional<anim::TextureRef>& ref, Encoding encoding) {
        if (!ref) return;
        if (const auto image = scene.textures[ref->texture].image) found.emplace(*image, encoding);
    };
    for (const anim::Material& material : scene.materials) {
        add(material.base_color_texture, Encoding::srgb);
        add(material.emissive_texture, Encoding::srgb);
        add(material.metallic_roughness_texture, Encoding::linear);
    }
    return found;
}

}  // namespace

Textures::Textures(const anim::Scene& scene) : scene_(scene) {
    std::vector<Use> readable;
    std::set<anim::Index> missing;
    for (const Use& use : uses(scene)) {
        if (scene.images[use.first].encoded.empty()) {
            missing.insert(use.first);
        } else {
            readable.push_back(use);
        }
    }
    for (const anim::Index image : missing) missing_.push_back(scene.images[image].name);

    // Decode; of several damaged images the first in the file is reported, whichever thread met it.
    for (auto& images : images_) images.resize(scene.images.size());
    std::vector<std::exception_ptr> errors(readable.size());
    tbb::parallel_for(std::size_t{0}, readable.size(), [&](std::size_t i) {
        const auto [image, encoding] = readable[i];
        try {
            images_[static_cast<std::size_t>(encoding)][image] =
                std::make_unique<Pyramid>(decode(scene.images[image]), encoding);
        } catch (...) {
            errors[i] = std::current_exception();
        }
    });
    for (const std::exception_ptr& error : errors) {
        if (error) std::rethrow_exception(error);
    }
}

glm::vec4 Textures::sample(const std::optional<anim::TextureRef>& ref, Encoding encoding, const glm::vec2& uv,
                           float footprint) const {
    constexpr glm::vec4 white{1.0f};
    if (!ref) return white;
    const anim::Texture& texture = scene_.textures[ref->texture];
    if (!texture.image) return white;
    const auto& image = images_[static_cast<std::size_t>(encoding)][*texture.image];
    return image ? engine::sample(*image, texture, uv, footprint) : white;
}

}  // namespace gridreel::engine
