#include "anim/gltf/read_images.h"

#include "anim/gltf/uri.h"

#include <fmt/format.h>

namespace gridreel::anim::gltf {
namespace {

Image read_image(Document& document, const Place& place, std::size_t number) {
    Image image{.name = place.text_or("name", ""), .mime_type = place.text_or("mimeType", ""), .encoded = {}};
    std::string problem = "there are no bytes", remedy = "export the file again";
    if (const auto uri = place.find("uri")) {
        if (auto embedded = decode_data_uri(uri->text(), *uri)) {
            image.encoded = std::move(embedded->bytes);
            if (image.mime_type.empty()) image.mime_type = embedded->mime_type;
        } else {
            if (image.name.empty()) image.name = uri->text();
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

    if (image.name.empty()) image.name = fmt::format("image {}", number);
    if (image.encoded.empty())
        document.warn(place,
                      fmt::format("the image \"{}\" is left out: {}; {}", image.name, problem, remedy));
    return image;
}

}  // namespace

std::vector<Image> read_images(Document& document) {
    std::vector<Image> images;
    for (const Place& place : document.all("images"))
        images.push_back(read_image(document, place, images.size()));
    return images;
}

}  // namespace gridreel::anim::gltf
