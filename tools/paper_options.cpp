#include "tools/paper_options.h"

#include "sequences/errors.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <utility>

namespace gridreel::tools {
namespace {

using sequences::UsageError;
using traversal::PacketOptions;
using Texts = std::vector<std::string>;

constexpr const char* group = "What to compare";

/// Those whose packets are squares of the picture.
constexpr std::array<std::pair<const char*, int>, 5> sides{
    {{"1", 1}, {"2", 2}, {"4", 4}, {"8", 8}, {"16", 16}}};

std::optional<int> parse_side(const std::string& text) {
    if (text == "auto") return std::nullopt;
    const auto* const found =
        std::find_if(sides.begin(), sides.end(), [&](const auto& side) { return side.first == text; });
    if (found == sides.end()) {
        throw UsageError(fmt::format("'{}' is no side of a packet", text), "--packet",
                         "choose from 1, 2, 4, 8, 16, and auto");
    }
    return found->second;
}

/// `true` is what job files say.
bool parse_switch(const std::string& text, const char* option) {
    if (text == "on" || text == "true") return true;
    if (text == "off" || text == "false") return false;
    throw UsageError(fmt::format("'{}' is neither on nor off", text), option,
                     fmt::format("write {0} on, {0} off, or {0} on,off to compare them", option));
}

Texts split(const std::string& list) {
    Texts parts;
    std::istringstream stream(list);
    for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
    return parts;
}

/// Each of what there is so far with each of the values.
template <class Set>
void vary(std::vector<LabelledPackets>& all, const Texts& values, const char* name, const Set& set) {
    if (values.empty()) return;
    std::vector<LabelledPackets> varied;
    for (const LabelledPackets& one : all) {
        for (const std::string& value : values) {
            LabelledPackets& packets = varied.emplace_back(one);
            const std::string shown = set(packets.options, value);
            if (values.size() == 1) continue;
            packets.label += fmt::format("{}{}={}", packets.label.empty() ? "" : ",", name, shown);
        }
    }
    all = std::move(varied);
}

/// Sets a switch from its text.
auto switched(bool PacketOptions::*member, const char* option) {
    return [member, option](PacketOptions& options, const std::string& text) {
        options.*member = parse_switch(text, option);
        return std::string(options.*member ? "on" : "off");
    };
}

void add_list(CLI::App& app, const char* name, Texts& values, const char* help, const char* standard) {
    app.add_option(name, values, help)
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("LIST")
        ->default_str(standard)
        ->group(group);
}

}  // namespace

void add_paper_options(CLI::App& app, PaperText& text) {
    add_list(app, "--packet", text.sides,
             "Rays along the side of the grid's packets: 1, 2, 4, 8, 16, or auto, the fastest; several, here "
             "and below: a grid for each",
             "auto");
    add_list(app, "--culling", text.culling, "Cull triangles against packets: on, off", "on");
    add_list(app, "--mailbox", text.mailbox, "Leave out triangles met lately: on, off", "on");
    // CLI11 takes the default for what an option without a value says, too.
    app.add_option("--macrocells", text.macrocells, "Skip cubes of empty cells: on, off; not given: off")
        ->expected(0, 1)
        ->type_name("[LIST]")
        ->default_str("on")
        ->group(group);
}

std::vector<LabelledPackets> read_packets(const PaperText& text) {
    std::vector<LabelledPackets> all(1);
    vary(all, text.sides, "packet", [](PacketOptions& options, const std::string& side) {
        options.side = parse_side(side);
        return side;
    });
    vary(all, text.culling, "culling", switched(&PacketOptions::culling, "--culling"));
    vary(all, text.mailbox, "mailbox", switched(&PacketOptions::mailbox, "--mailbox"));
    vary(all, split(text.macrocells), "macrocells", switched(&PacketOptions::macrocells, "--macrocells"));
    return all;
}

std::string first_written(const PaperText& text) {
    if (!text.sides.empty()) return "--packet";
    if (!text.culling.empty()) return "--culling";
    if (!text.mailbox.empty()) return "--mailbox";
    return text.macrocells.empty() ? "" : "--macrocells";
}

}  // namespace gridreel::tools
