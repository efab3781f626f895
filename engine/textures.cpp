#include "engine/textures.h"

#include "anim/drawn_textures.h"
#include "anim/error.h"
#include "engine/image_decode.h"

#include <oneapi/tbb/parallel_for.h>

#include <cstddef>
#include <set>
#include <utility>

namespace gridreel::engine {
namespace {

using Use = std::pair<anim::Index, Encoding>;  // an image and what it means

std::set<Use> uses(const anim::Scene& scene) {
    std::set<Use> found;
    for (const anim::Material& material : scene.materials) {
        for (const anim::DrawnTexture& texture : anim::drawn_textures(material)) {
            const bool is_color = texture.meaning == anim::TextureMeaning::color;
            const auto image = scene.textures[texture.ref.texture].image;
            if (image) found.emplace(*image, is_color ? Encoding::srgb : Encoding::linear);
        }
    }
    return found;
}

}  // namespace

Textures::Textures(const anim::Scene& scene) : scene_(scene) {
    const std::set<Use> found = uses(scene);
    const std::vector<Use> wanted(found.begin(), found.end());
    for (auto& images : images_) images.resize(scene.images.size());

    // One bad image does not take the others, or the picture, with it.
    std::vector<std::string> problems(wanted.size());
    tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t i) {
        const auto& [image, encoding] = wanted[i];
        if (scene.images[image].encoded.empty()) return;
        try {
            images_[static_cast<std::size_t>(encoding)][image] =
                std::make_unique<Pyramid>(decode(scene.images[image]), encoding);
        } catch (const Error& error) {
            problems[i] = error.what();
        }
    });

    // Image by image as in the file, and once where an image has two meanings.
    std::optional<anim::Index> last;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (problems[i].empty() || wanted[i].first == last) continue;
        problems_.push_back(std::move(problems[i]));
        last = wanted[i].first;
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
