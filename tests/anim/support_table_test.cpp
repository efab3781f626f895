// The tables of anim/README.md against the code: they say what is supported, and must not drift.

#include "anim/animated_properties.h"
#include "anim/gltf/extensions.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace gridreel;
using anim::gltf::Treatment;

namespace {

const std::filesystem::path project = GRIDREEL_PROJECT_FOLDER;

std::vector<std::string> readme() {
    std::ifstream file(project / "anim/README.md");
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

/// Rows of the table under a heading, without its own two lines.
std::vector<std::string> rows_under(const std::string& heading) {
    std::vector<std::string> rows;
    bool is_there = false;
    for (const std::string& line : readme()) {
        if (line.starts_with("#")) is_there = line == heading;
        if (is_there && line.starts_with("|")) rows.push_back(line);
    }
    REQUIRE(rows.size() > 2);
    rows.erase(rows.begin(), rows.begin() + 2);
    return rows;
}

const char* word_for(Treatment treatment) {
    switch (treatment) {
        case Treatment::honoured:
            return "supported";
        case Treatment::approximated:
            return "approximated";
        case Treatment::ignored:
            return "ignored";
        case Treatment::refused:
            return "refused";
    }
    return "";
}

template <class Object>
void add_rows(std::string_view prefix, std::span<const anim::AnimatedProperty<Object>> properties,
              std::vector<std::string>& rows) {
    for (const auto& property : properties)
        rows.push_back(fmt::format("| `{}{}` | {} |", prefix, property.pointer, property.width));
}

}  // namespace

TEST_CASE("the README lists every known extension and what becomes of it", "[support]") {
    std::vector<std::string> expected;
    for (const auto& extension : anim::gltf::known_extensions())
        expected.push_back(
            fmt::format("| `{}` | {} | {} |", extension.name, word_for(extension.treatment), extension.note));
    CHECK(rows_under("### Extensions") == expected);
}

TEST_CASE("the README lists every value that a pointer can animate", "[support]") {
    std::vector<std::string> expected{"| `/nodes/N/translation` | 3 |",
                                      "| `/nodes/N/rotation` | 4 |",
                                      "| `/nodes/N/scale` | 3 |",
                                      "| `/nodes/N/weights`, `/meshes/N/weights` | one per target |",
                                      "| `/nodes/N/weights/I`, `/meshes/N/weights/I` | 1 |",
                                      "| `/nodes/N/extensions/KHR_node_visibility/visible` | 1 |"};
    add_rows("/cameras/N/", anim::camera_properties(), expected);
    add_rows("/extensions/KHR_lights_punctual/lights/N/", anim::light_properties(), expected);
    add_rows("/materials/N/", anim::material_properties(), expected);
    CHECK(rows_under("### Animation pointers") == expected);
}

TEST_CASE("every row about the core names tests that there are", "[support]") {
    const auto rows = rows_under("### Core");
    CHECK(rows.size() > 20);
    for (const std::string& row : rows) {
        CAPTURE(row);
        // | feature | what becomes of it | `tests/…` `tests/…` |
        const auto last = row.rfind(" | ");
        REQUIRE(last != row.npos);
        std::size_t named = 0;
        for (auto begin = row.find('`', last); begin != row.npos; ++named) {
            const auto end = row.find('`', begin + 1);
            REQUIRE(end != row.npos);
            CHECK(std::filesystem::exists(project / "tests" / row.substr(begin + 1, end - begin - 1)));
            begin = row.find('`', end + 1);
        }
        CHECK(named > 0);
    }
}
