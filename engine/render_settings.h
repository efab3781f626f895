#pragma once
// How pictures of a clip are to be made.

#include "traversal/tracer.h"

#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace gridreel::engine {

enum class LightChoice {
    automatic,  ///< the file's lights, or the default ones when it has none
    file,       ///< the file's lights only, even if there are none
    standard,   ///< the default dome and key light only
};

struct RenderSettings {
    std::int32_t width = 1280;                 ///< pixels, >= 1
    std::optional<std::int32_t> height = 720;  ///< pixels, >= 1; absent: from `width` and the camera's aspect
    std::int32_t samples = 4;                  ///< per pixel, >= 1
    std::uint32_t seed = 0;                    ///< of the sample pattern
    std::string camera = "auto";               ///< "auto", "fit", a camera node's name, or its number from 0
    LightChoice lights = LightChoice::automatic;
    glm::vec4 background{0.18f, 0.18f, 0.18f, 1.0f};  ///< linear RGB, not premultiplied, and alpha
    float exposure_stops = 0.0f;                      ///< pictures are multiplied by 2^exposure_stops
    traversal::TracerOptions tracer;
    std::size_t rays_per_band = 2'000'000;  ///< memory bound: a frame with more goes in horizontal bands
};

}  // namespace gridreel::engine
