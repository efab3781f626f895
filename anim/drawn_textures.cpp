#include "anim/drawn_textures.h"

namespace gridreel::anim {

std::vector<DrawnTexture> drawn_textures(const Material& material) {
    std::vector<DrawnTexture> drawn;
    const auto add = [&](const std::optional<TextureRef>& ref, TextureMeaning meaning) {
        if (ref) drawn.push_back({.ref = *ref, .meaning = meaning});
    };
    add(material.base_color_texture, TextureMeaning::color);
    if (material.unlit) return drawn;
    add(material.emissive_texture, TextureMeaning::color);
    add(material.metallic_roughness_texture, TextureMeaning::numbers);
    return drawn;
}

}  // namespace gridreel::anim
