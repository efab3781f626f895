#pragma once
// The options of how a picture is made, for every command that makes some.

#include "engine/frame_renderer.h"

#include <cstdint>
#include <string>

namespace CLI {
class App;
}

namespace gridreel::tools {

/// Options as written.
struct PictureText {
    std::string camera = "auto";
    std::string size = "1280x720";
    std::int32_t samples = 4;
    std::uint32_t seed = 0;
    std::string lights = "auto";
    std::string background = "0.18,0.18,0.18";
    float exposure = 0.0f;
    std::string lambda = "auto";
    std::int64_t max_cells = rebuild::ResolutionPolicy{}.max_cells;
};

/// --camera --size --spp --seed --lights --background --exposure.
void add_picture_options(CLI::App& app, PictureText& text);

/// --max-cells.
void add_max_cells_option(CLI::App& app, PictureText& text);

/// --lambda --max-cells.
void add_grid_options(CLI::App& app, PictureText& text);

/// The rule or the number that --lambda gives.
/// @throws sequences::UsageError
void set_lambda(const std::string& text, traversal::TracerOptions& options);

/// @throws sequences::UsageError
[[nodiscard]] engine::RenderSettings read_picture(const PictureText& text);

}  // namespace gridreel::tools
