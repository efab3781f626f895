#include "anim/gltf/read_textures.h"

#include "anim/drawn_textures.h"
#include "anim/gltf/extensions.h"

#include <fmt/format.h>

#include <cstddef>
#include <optional>

namespace gridreel::anim::gltf {
namespace {

// --- Samplers ----------------------------------------------------------------------------------

// Codes of section 5.26, which are OpenGL's.
constexpr std::size_t nearest_code = 9728;
constexpr std::size_t linear_code = 9729;
constexpr std::size_t nearest_mip_nearest = 9984;
constexpr std::size_t linear_mip_nearest = 9985;
constexpr std::size_t nearest_mip_linear = 9986;
constexpr std::size_t clamp_code = 33071;
constexpr std::size_t mirrored_code = 33648;

Wrap read_wrap(const Place& sampler, std::string_view name) {
    const auto code = sampler.find(name);
    if (!code) return Wrap::repeat;
    if (code->integer() == clamp_code) return Wrap::clamp_to_edge;
    return code->integer() == mirrored_code ? Wrap::mirrored_repeat : Wrap::repeat;
}

void read_sampler(const Place& sampler, Texture& texture) {
    texture.wrap_s = read_wrap(sampler, "wrapS");
    texture.wrap_t = read_wrap(sampler, "wrapT");
    if (sampler.integer_or("magFilter", linear_code) == nearest_code) texture.mag_filter = Filter::nearest;
    const auto min = sampler.find("minFilter");
    if (!min) return;
    const std::size_t code = min->integer();
    if (code == nearest_code || code == nearest_mip_nearest || code == nearest_mip_linear)
        texture.min_filter = Filter::nearest;
    if (code == nearest_code || code == linear_code) texture.mip_filter = MipFilter::none;
    if (code == nearest_mip_nearest || code == linear_mip_nearest) texture.mip_filter = MipFilter::nearest;
}

// --- Images ------------------------------------------------------------------------------------

std::optional<Index> webp_source(const Place& texture) {
    const auto webp = texture.find_extension("EXT_texture_webp");
    return webp ? webp->find_index("source") : std::nullopt;
}

bool has_ktx2(const Place& texture) {
    return texture.find_extension("KHR_texture_basisu").has_value();
}

Texture read_texture(Document& document, const Place& place) {
    Texture texture;
    texture.image = webp_source(place);
    if (!texture.image) texture.image = place.find_index("source");
    if (const auto sampler = place.find_index("sampler"))
        read_sampler(document.root().at("samplers", *sampler), texture);
    return texture;
}

std::vector<bool> find_drawn(std::size_t texture_count, std::span<const Material> materials) {
    std::vector<bool> drawn(texture_count, false);
    for (const Material& material : materials)
        for (const DrawnTexture& texture : drawn_textures(material)) drawn[texture.ref.texture] = true;
    return drawn;
}

/// Refuses, or warns of, textures that do not show what the file means.
void check_images(Document& document, std::span<const Texture> textures, const std::vector<bool>& drawn) {
    const bool ktx2_required = requires_extension(document.root(), "KHR_texture_basisu");
    std::optional<Place> first_replaced;
    std::size_t replaced = 0;
    const auto places = document.all("textures");
    for (std::size_t i = 0; i < textures.size(); ++i) {
        if (has_ktx2(places[i])) {
            if (!textures[i].image && (ktx2_required || drawn[i]))
                places[i].refuse(
                    "the texture has no other image than KTX2, which is not read",
                    "convert the textures: npx @gltf-transform/cli ktxdecompress IN.glb OUT.glb");
            if (!textures[i].image) continue;
            if (!first_replaced) first_replaced = places[i];
            ++replaced;
        } else if (!textures[i].image && drawn[i]) {
            document.warn(places[i], "the texture has no image that can be read; it is drawn white");
        }
    }
    if (!first_replaced) return;
    document.warn(*first_replaced,
                  fmt::format("KTX2 is not read: {} drawn from {} other image{}",
                              replaced == 1 ? "1 texture is" : fmt::format("{} textures are", replaced),
                              replaced == 1 ? "its" : "their", replaced == 1 ? "" : "s"));
}

}  // namespace

std::vector<Texture> read_textures(Document& document, std::span<const Material> materials) {
    std::vector<Texture> textures;
    for (const Place& place : document.all("textures")) textures.push_back(read_texture(document, place));
    check_images(document, textures, find_drawn(textures.size(), materials));
    return textures;
}

}  // namespace gridreel::anim::gltf
