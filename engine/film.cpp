#include "engine/film.h"

namespace gridreel::engine {
namespace {

std::size_t index_of(std::int32_t x, std::int32_t y, std::int32_t width) {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
           Film::channel_count;
}

}  // namespace

void Film::resize(std::int32_t new_width, std::int32_t new_height) {
    width = new_width;
    height = new_height;
    pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channel_count);
}

float* Film::pixel(std::int32_t x, std::int32_t y) {
    return pixels.data() + index_of(x, y, width);
}

const float* Film::pixel(std::int32_t x, std::int32_t y) const {
    return pixels.data() + index_of(x, y, width);
}

}  // namespace gridreel::engine
