#include "anim/gltf/missing_texcoords.h"

#include "anim/drawn_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace gridreel::anim::gltf {
namespace {

bool lacks_texcoords(const Primitive& primitive, const Material& material) {
    const std::vector<DrawnTexture> drawn = drawn_textures(material);
    return std::any_of(drawn.begin(), drawn.end(), [&](const DrawnTexture& texture) {
        return primitive.texcoords[texture.ref.texcoord].empty();
    });
}

bool lacks_texcoords(const Primitive& primitive, const std::vector<Material>& materials) {
    if (primitive.material && lacks_texcoords(primitive, materials[*primitive.material])) return true;
    return std::any_of(
        primitive.variant_materials.begin(), primitive.variant_materials.end(),
        [&](const VariantMaterial& look) { return lacks_texcoords(primitive, materials[look.material]); });
}

}  // namespace

void warn_of_missing_texcoords(Document& document, const Scene& scene) {
    std::optional<std::size_t> first_mesh;
    std::size_t count = 0;
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        for (const Primitive& primitive : scene.meshes[mesh].primitives) {
            if (!lacks_texcoords(primitive, scene.materials)) continue;
            if (!first_mesh) first_mesh = mesh;
            ++count;
        }
    }
    if (!first_mesh) return;
    document.warn(document.root().at("meshes", *first_mesh),
                  fmt::format("{} without the texture coordinates that {} material asks for; the texture "
                              "shows one colour everywhere",
                              count == 1 ? "1 primitive is" : fmt::format("{} primitives are", count),
                              count == 1 ? "its" : "their"));
}

}  // namespace gridreel::anim::gltf
