#include "anim/gltf/read_images.h"

#include "anim/gltf/uri.h"

#include <fmt/format.h>

namespace gridreel::anim::gltf {
namespace {

std::string name_of(const Place& place, std::size_t number) {
    if (auto name = place.text_or("name", ""); !name.empty()) return name;
    const auto uri = place.find("uri");
    return uri && !uri->text().starts_with("data:") ? uri->text() : fmt::format("image {}", number);
}

Image read_image(Document& document, const Place& place, std::size_t number) {
    Image image{.name = name_of(place, number), .mime_type = place.text_or("mimeType", ""), .encoded = {}};
    std::string problem = "there are no bytes", remedy = "export the file again";
    if (const auto uri = place.find("uri")) {
        if (auto embedded = decode_data_uri(uri->text(), *uri)) {
            image.encoded = std::move(embedded->bytes);
            if (image.mime_type.empty()) image.mime_type = embedded->mime_type;
        } else {
            auto file = document.read_file(uri->text(), *uri);
            image.encoded = std::move(file.bytes);
            if (!file.refusal.empty()) {
                problem = file.refusal;
                remedy = file.remedy;
            }
        }
    } else if (const auto view = place.find("bufferView")) {
        const auto bytes = document.view(view->index());
        document.budget().spend(bytes.size(), *view);
        image.encoded.assign(bytes.begin(), bytes.end());
    }

    if (image.encoded.empty())
        document.warn(place,
                      fmt::format("the image \"{}\" is left out: {}; {}", image.name, problem, remedy));
    return image;
}

/// The images that KHR_texture_basisu names and no texture is drawn from.
std::vector<bool> only_ktx2(const Document& document, std::span<const Texture> textures, std::size_t count) {
    std::vector<bool> only(count, false);
    for (const Place& texture : document.all("textures"))
        if (const auto ktx2 = texture.find_extension("KHR_texture_basisu"))
            if (const auto source = ktx2->find_index("source")) only[*source] = true;
    for (const Texture& texture : textures)
        if (texture.image) only[*texture.image] = false;
    return only;
}

}  // namespace

std::vector<Image> read_images(Document& document, std::span<const Texture> textures) {
    const auto places = document.all("images");
    const std::vector<bool> unread = only_ktx2(document, textures, places.size());
    std::vector<Image> images;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (unread[i])
            images.push_back({.name = name_of(places[i], i), .mime_type = {}, .encoded = {}});
        else
            images.push_back(read_image(document, places[i], i));
    }
    return images;
}

}  // namespace gridreel::anim::gltf
