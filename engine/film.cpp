#include "engine/film.h"

namespace gridreel::engine {

void Film::resize(std::int32_t new_width, std::int32_t new_height) {
    width = new_width;
    height = new_height;
    pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channel_count);
}

float* Film::pixel(std::int32_t x, std::int32_t y) {
    return pixels.data() + static_cast<std::size_t>(y * width + x) * channel_count;
}

const float* Film::pixel(std::int32_t x, std::int32_t y) const {
    return pixels.data() + static_cast<std::size_t>(y * width + x) * channel_count;
}

}  // namespace gridreel::engine
