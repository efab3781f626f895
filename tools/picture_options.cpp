#include "tools/picture_options.h"

#include "sequences/render_text.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <optional>

namespace gridreel::tools {

void add_picture_options(CLI::App& app, PictureText& text) {
    const char* const group = "Picture";
    app.add_option("--camera", text.camera,
                   "NAME or number of a camera node, fit, or auto: the first, else fit")
        ->type_name("CHOICE")
        ->capture_default_str()
        ->group(group);
    app.add_option("-s,--size", text.size, "Pixels; 1280x takes the camera's aspect")
        ->type_name("WxH")
        ->capture_default_str()
        ->group(group);
    app.add_option("--spp", text.samples, "Samples per pixel")
        ->check(CLI::Range(1, 65'536).description(""))
        ->type_name("N")
        ->capture_default_str()
        ->group(group);
    app.add_option("--seed", text.seed, "Of the sample pattern")
        ->type_name("N")
        ->capture_default_str()
        ->group(group);
    app.add_option("--lights", text.lights,
                   "The file's, or a default dome and key light; auto: the file's if any")
        ->check(CLI::IsMember({"auto", "file", "default"}).description(""))
        ->type_name("auto|file|default")
        ->capture_default_str()
        ->group(group);
    app.add_option("--background", text.background,
                   "#rrggbb or #rrggbbaa (sRGB), three or four linear numbers R,G,B,A, or transparent")
        ->type_name("COLOR")
        ->capture_default_str()
        ->group(group);
    app.add_option("--exposure", text.exposure, "Stops: pictures are multiplied by 2^exposure")
        ->check(CLI::Range(-64.0f, 64.0f).description(""))
        ->type_name("STOPS")
        ->capture_default_str()
        ->group(group);
}

void add_max_cells_option(CLI::App& app, PictureText& text) {
    app.add_option("--max-cells", text.max_cells, "Most grid cells")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 30).description(""))
        ->type_name("N")
        ->capture_default_str()
        ->group("Machine");
}

void add_grid_options(CLI::App& app, PictureText& text) {
    app.add_option("--lambda", text.lambda,
                   "Grid cells per triangle: a number, paper (5), or auto: chosen for each frame by cost")
        ->type_name("R|paper|auto")
        ->capture_default_str()
        ->group("Machine");
    add_max_cells_option(app, text);
}

void set_lambda(const std::string& text, traversal::TracerOptions& options) {
    const std::optional<float> lambda = sequences::parse_lambda(text);
    options.lambda = lambda ? traversal::LambdaRule::fixed : traversal::LambdaRule::by_cost;
    if (lambda) options.resolution.lambda = *lambda;
}

engine::RenderSettings read_picture(const PictureText& text) {
    const sequences::PictureSize size = sequences::parse_size(text.size);
    engine::RenderSettings settings;
    settings.width = size.width;
    settings.height = size.height;
    settings.samples = text.samples;
    settings.seed = text.seed;
    settings.camera = text.camera;
    settings.background = sequences::parse_background(text.background);
    settings.exposure_stops = text.exposure;
    if (text.lights == "file") settings.lights = engine::LightChoice::file;
    if (text.lights == "default") settings.lights = engine::LightChoice::standard;
    set_lambda(text.lambda, settings.tracer);
    settings.tracer.resolution.max_cells = text.max_cells;
    return settings;
}

}  // namespace gridreel::tools
