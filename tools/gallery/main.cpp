// make_gallery: writes the bundled scenes, one scene at any size, or a crowd of somebody else's character.

#include "anim/error.h"
#include "tools/gallery/crowd.h"
#include "tools/gallery/glb_writer.h"
#include "tools/gallery/restless.h"
#include "tools/gallery/scenes.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace {

namespace gallery = gridreel::gallery;

/// Writes beside the file first, so that a failure leaves neither half a scene nor harms an older one.
template <typename Write>
void write_file(const std::filesystem::path& file, std::size_t triangles, Write&& write) {
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
    std::filesystem::path unfinished = file;
    unfinished += ".part";
    try {
        std::ofstream out(unfinished, std::ios::binary);
        write(out);
        out.close();
        if (!out)
            throw gridreel::Error("cannot write the file", file.string(),
                                  "check the folder and the space left");
        std::filesystem::rename(unfinished, file);
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove(unfinished, ignored);
        throw;
    }
    std::cout << fmt::format("{}: {} triangles, {} bytes\n", file.string(), triangles,
                             std::filesystem::file_size(file));
}

void write_scene(const gallery::Document& document, const std::filesystem::path& file) {
    write_file(file, gallery::triangle_count(document),
               [&](std::ostream& out) { gallery::write_glb(document, out); });
}

void write_bundled(const std::filesystem::path& folder) {
    for (const auto& scene : gallery::scene_makers) {
        if (scene.place != gallery::Place::bundled) continue;
        const std::string stem(scene.name);
        write_scene(scene.make(scene.usual_triangles), folder / stem / (stem + ".glb"));
    }
}

const gallery::SceneMaker& scene_named(std::string_view name) {
    for (const auto& scene : gallery::scene_makers)
        if (scene.name == name) return scene;
    throw gridreel::Error("no such scene", std::string(name), "see make_gallery --help");
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Writes the scenes of sequences/gallery, the same bytes on every run."};
    std::string name, output, folder = "sequences/gallery";
    std::size_t triangles = 0;

    std::string footer = "Scenes:";
    std::vector<std::string> names;
    for (const auto& scene : gallery::scene_makers) {
        footer += fmt::format("\n  {}: {}, {} triangles{}", scene.name, scene.summary, scene.usual_triangles,
                              scene.place == gallery::Place::bundled ? ", bundled" : "");
        names.emplace_back(scene.name);
    }
    app.footer(footer);
    auto* const scene_option =
        app.add_option("scene", name, "One scene; without it, all bundled ones as they are")
            ->check(CLI::IsMember(names));
    app.add_option("--triangles", triangles,
                   "About how many triangles (default: as below). What would stand still then sways, so that "
                   "every triangle moves in every frame")
        ->check(CLI::Range(std::size_t{1}, std::size_t{60'000'000}))
        ->needs(scene_option);
    app.add_option("-o,--output", output, "File to write (default: SCENE.glb)")->needs(scene_option);
    CLI::App* const crowd =
        app.add_subcommand("crowd", "Copies of a skinned character, each at its own phase of its clip");
    std::string character, crowd_output = "crowd.glb";
    std::size_t count = 100;
    crowd->add_option("FILE", character, "The character: a .glb with a skin and an animation")
        ->required()
        ->type_name("");
    crowd->add_option("--count", count, "How many copies")
        ->check(CLI::Range(1, 10'000))
        ->capture_default_str();
    crowd->add_option("-o,--output", crowd_output, "File to write")->capture_default_str();
    app.add_option("--folder", folder, "Where all scenes go, each as SCENE/SCENE.glb")->capture_default_str();
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;  // wrong usage
    }

    gallery::Crowd copies;
    try {
        if (*crowd) copies = gallery::make_crowd(character, count);
    } catch (const std::exception& error) {
        std::cerr << "make_gallery: " << error.what() << '\n';
        return 3;  // unreadable or invalid
    }

    try {
        if (*crowd) {
            write_file(crowd_output, copies.triangles, [&](std::ostream& out) { out << copies.glb; });
        } else if (name.empty()) {
            write_bundled(folder);
        } else {
            const gallery::SceneMaker& scene = scene_named(name);
            gallery::Document document = scene.make(triangles > 0 ? triangles : scene.usual_triangles);
            if (triangles > 0) gallery::keep_moving(document);
            write_scene(document, output.empty() ? name + ".glb" : output);
        }
    } catch (const std::exception& error) {
        std::cerr << "make_gallery: " << error.what() << '\n';
        return 4;  // cannot write output
    }
    return 0;
}
