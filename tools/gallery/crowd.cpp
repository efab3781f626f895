#include "tools/gallery/crowd.h"

#include "anim/clip.h"
#include "anim/clip_bounds.h"
#include "anim/error.h"
#include "anim/frame_geometry.h"
#include "anim/load.h"
#include "anim/sample_channel.h"
#include "tools/gallery/glb_writer.h"
#include "tools/gallery/phase_shift.h"
#include "tools/gallery/staging.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <span>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gridreel::gallery {

namespace {

using Json = nlohmann::ordered_json;

// --- Reading -------------------------------------------------------------------------------------

/// The character as the renderer sees it.
struct Character {
    anim::Scene scene{};
    anim::Clip clip{};
    anim::Box box{};  ///< over the whole clip
    std::size_t triangles = 0;
};

Character load_character(const std::string& bytes, const std::filesystem::path& file) {
    Character character{.scene = anim::load_bytes(std::as_bytes(std::span(bytes)), file)};
    if (character.scene.skins.empty())
        throw Error("the file has no skin", file.string(), "name a character that has a skeleton");
    character.clip = anim::choose_clip(character.scene);
    if (character.clip.duration_s <= 0.0)
        throw Error("the file has no animation", file.string(), "name a character that moves");
    character.box = anim::clip_bounds(character.scene, character.clip);
    character.triangles = anim::lay_out(character.scene, character.clip).triangles.size();
    return character;
}

std::uint32_t word(const std::string& bytes, std::size_t offset) {
    std::uint32_t value = 0;
    if (offset + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

/// A .glb's two chunks. `load_character` has found the file sound.
struct Chunks {
    Json json{};
    std::string binary{};
};

Chunks take_apart(const std::string& bytes, const std::filesystem::path& file) {
    if (!bytes.starts_with("glTF"))
        throw Error("the file is not a .glb", file.string(),
                    "pack the character and its files into one .glb");
    const std::size_t binary = 20 + std::size_t{word(bytes, 12)};
    Chunks chunks{.json = Json::parse(bytes.substr(20, word(bytes, 12)))};
    if (binary + 8 <= bytes.size()) chunks.binary = bytes.substr(binary + 8, word(bytes, binary));
    for (const char* const list : {"buffers", "images"})
        for (const Json& entry : chunks.json.value(list, Json::array()))
            if (entry.contains("uri") && !entry["uri"].get<std::string>().starts_with("data:"))
                throw Error(fmt::format("the file refers to '{}'", entry["uri"].get<std::string>()),
                            file.string(), "pack the character and its files into one .glb");
    return chunks;
}

// --- Copies --------------------------------------------------------------------------------------

/// Rows and columns around the origin, the first row in front, feet at height 0.
std::vector<glm::dvec3> places(const anim::Box& box, std::size_t count) {
    const glm::dvec3 low(box.min), high(box.max);
    const glm::dvec3 size = high - low, foot(0.5 * (low.x + high.x), low.y, 0.5 * (low.z + high.z));
    const double spacing_x = 1.1 * size.x, spacing_z = 1.1 * std::max(size.z, 0.5 * size.x);
    // As long as wide.
    const double ideal_columns = std::max(1.0, std::sqrt(double(count) * spacing_z / spacing_x));
    const std::size_t columns = std::min(count, static_cast<std::size_t>(std::round(ideal_columns)));
    const std::size_t rows = (count + columns - 1) / columns;

    std::vector<glm::dvec3> places;
    for (std::size_t copy = 0; copy < count; ++copy) {
        const std::size_t column = copy % columns, row = copy / columns;
        const double right = spacing_x * (double(column) - 0.5 * double(columns - 1));
        const double back = spacing_z * (double(row) - 0.5 * double(rows - 1));
        places.push_back(glm::dvec3(right, 0.0, -back) - foot);
    }
    return places;
}

/// Spread over the clip, the next copy's far from the last one's: multiples of the golden section.
double phase_of(std::size_t copy, double duration_s) {
    const double turn = double(copy) * 0.618033988749895;
    return (turn - std::floor(turn)) * duration_s;
}

/// One of the source's nodes for one copy: its children and skin are that copy's, its camera and light gone.
Json copied_node(Json node, std::size_t first_node, std::size_t first_skin) {
    if (node.contains("children"))
        for (Json& child : node["children"]) child = child.get<std::size_t>() + first_node;
    if (node.contains("skin")) node["skin"] = node["skin"].get<std::size_t>() + first_skin;
    node.erase("camera");
    if (node.contains("extensions")) node["extensions"].erase("KHR_lights_punctual");
    return node;
}

class CrowdWriter {
public:
    CrowdWriter(Chunks chunks, const Character& character)
        : json_(std::move(chunks.json)),
          binary_(std::move(chunks.binary)),
          character_(character),
          nodes_(std::exchange(json_["nodes"], Json::array())),
          skins_(std::exchange(json_["skins"], Json::array())),
          roots_(json_["scenes"][character.clip.scene]["nodes"]) {}

    std::string write(std::size_t count) {
        Json scene{{"name", "crowd"}, {"nodes", Json::array()}};
        const std::vector<glm::dvec3> spots = places(character_.box, count);
        for (std::size_t copy = 0; copy < count; ++copy)
            scene["nodes"].push_back(add_copy(copy, spots[copy]));
        for (const std::size_t node : add_stage(spots)) scene["nodes"].push_back(node);
        json_["scene"] = 0;
        json_["scenes"] = Json::array({std::move(scene)});
        json_["animations"] =
            Json::array({{{"name", "crowd"}, {"samplers", samplers_}, {"channels", channels_}}});
        json_["asset"]["generator"] = "gridreel make_gallery";
        binary_.resize((binary_.size() + 3) / 4 * 4);
        json_["buffers"][0]["byteLength"] = binary_.size();

        std::ostringstream out;
        write_glb_head(json_.dump(), binary_.size(), "crowd", out);
        out << binary_;
        return std::move(out).str();
    }

private:
    /// @return the new root node of the copy
    std::size_t add_copy(std::size_t copy, const glm::dvec3& place) {
        const std::size_t first_node = json_["nodes"].size(), first_skin = json_["skins"].size();
        for (const Json& node : nodes_) json_["nodes"].push_back(copied_node(node, first_node, first_skin));
        for (Json skin : skins_) {
            for (Json& joint : skin["joints"]) joint = joint.get<std::size_t>() + first_node;
            if (skin.contains("skeleton"))
                skin["skeleton"] = skin["skeleton"].get<std::size_t>() + first_node;
            json_["skins"].push_back(std::move(skin));
        }
        add_channels(first_node, phase_of(copy, character_.clip.duration_s));

        Json children = roots_;
        for (Json& child : children) child = child.get<std::size_t>() + first_node;
        json_["nodes"].push_back({{"name", fmt::format("copy {}", copy + 1)},
                                  {"translation", {place.x, place.y, place.z}},
                                  {"children", std::move(children)}});
        return json_["nodes"].size() - 1;
    }

    void add_channels(std::size_t first_node, double phase_s) {
        std::map<std::vector<float>, std::size_t> inputs;  // this copy's accessors by their times
        for (const anim::Index id : character_.clip.animations) {
            const anim::Animation& animation = character_.scene.animations[id];
            for (const anim::Channel& channel : animation.channels) {
                // Copies share their looks, and what a pointer drives of a node does not move it.
                if (channel.path > anim::ChannelPath::weights) continue;
                channels_.push_back(
                    {{"sampler", sampler(id, channel, phase_s, inputs)},
                     {"target", {{"node", first_node + channel.object}, {"path", name_of(channel.path)}}}});
            }
        }
    }

    std::size_t sampler(anim::Index animation, const anim::Channel& channel, double phase_s,
                        std::map<std::vector<float>, std::size_t>& inputs) {
        const anim::Sampler& keys = character_.scene.animations[animation].samplers[channel.sampler];
        // What never changes is the same for all copies.
        const bool still = !anim::varies(keys);
        const std::pair key(animation, channel.sampler);
        if (still && still_samplers_.contains(key)) return still_samplers_[key];

        const anim::Sampler shifted = begun_at(keys, channel.path, phase_s, character_.clip.duration_s);
        const auto [input, is_new] = inputs.try_emplace(shifted.times_s, 0);
        if (is_new) {
            input->second = add_accessor(shifted.times_s, "SCALAR", 1);
            json_["accessors"].back()["min"] = {shifted.times_s.front()};
            json_["accessors"].back()["max"] = {shifted.times_s.back()};
        }
        const std::size_t output =
            channel.path == anim::ChannelPath::weights
                ? add_accessor(shifted.values, "SCALAR", 1)
                : add_accessor(shifted.values, keys.width == 4 ? "VEC4" : "VEC3", keys.width);
        Json json{{"input", input->second}, {"output", output}};
        if (shifted.interpolation == anim::Interpolation::step) json["interpolation"] = "STEP";
        samplers_.push_back(std::move(json));
        if (still) still_samplers_[key] = samplers_.size() - 1;
        return samplers_.size() - 1;
    }

    std::size_t add_accessor(const std::vector<float>& values, const char* type, std::size_t width) {
        binary_.resize((binary_.size() + 3) / 4 * 4);
        json_["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", values.size() * sizeof(float)}});
        binary_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
        json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                      {"componentType", 5126},
                                      {"count", values.size() / width},
                                      {"type", type}});
        return json_["accessors"].size() - 1;
    }

    static const char* name_of(anim::ChannelPath path) {
        switch (path) {
            case anim::ChannelPath::translation:
                return "translation";
            case anim::ChannelPath::rotation:
                return "rotation";
            case anim::ChannelPath::scale:
                return "scale";
            case anim::ChannelPath::weights:
                return "weights";
        }
        throw std::logic_error("no such path");
    }

    /// A camera that sees about the whole crowd, and two lights.
    /// @return their nodes
    std::vector<std::size_t> add_stage(const std::vector<glm::dvec3>& spots) {
        glm::dvec3 low(spots.front()), high(low);
        for (const glm::dvec3& spot : spots) {
            low = glm::min(low, spot);
            high = glm::max(high, spot);
        }
        low += glm::dvec3(character_.box.min);
        high += glm::dvec3(character_.box.max);
        const glm::dvec3 middle = 0.5 * (low + high);
        const double radius = 0.5 * glm::length(high - low);

        Document stage;
        const glm::dvec3 eye = middle + 2.0 * radius * glm::normalize(glm::dvec3(0.15, 0.6, 1.0));
        add_camera(stage, eye, middle, 40.0, 20.0 * radius);
        add_light(stage, "key", middle + radius * glm::dvec3(-1.5, 3.0, 2.0), middle, 1.1, {1.0, 0.95, 0.88});
        add_light(stage, "fill", eye + radius * glm::dvec3(1.0, 0.5, 0.0), middle, 0.25, {0.75, 0.86, 1.0});
        stage.cameras.front().near_m = 1e-3 * radius;
        std::ostringstream glb;
        write_glb(stage, glb);
        const Json json = take_apart(glb.str(), "the stage").json;
        json_["cameras"] = json["cameras"];
        json_["extensions"]["KHR_lights_punctual"] = json["extensions"]["KHR_lights_punctual"];
        Json& used = json_["extensionsUsed"];
        if (std::ranges::find(used, "KHR_lights_punctual") == used.end())
            used.push_back("KHR_lights_punctual");

        std::vector<std::size_t> nodes;
        for (const Json& node : json["nodes"]) {
            json_["nodes"].push_back(node);
            nodes.push_back(json_["nodes"].size() - 1);
        }
        return nodes;
    }

    Json json_;
    std::string binary_;
    const Character& character_;
    const Json nodes_, skins_, roots_;  ///< of the source
    Json samplers_ = Json::array(), channels_ = Json::array();
    std::map<std::pair<anim::Index, anim::Index>, std::size_t> still_samplers_;
};

}  // namespace

Crowd make_crowd(const std::filesystem::path& character_file, std::size_t count) {
    std::ifstream in(character_file, std::ios::binary);
    if (!in) throw Error("cannot read the file", character_file.string(), "check the name");
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const Character character = load_character(bytes, character_file);
    return {.glb = CrowdWriter(take_apart(bytes, character_file), character).write(count),
            .triangles = count * character.triangles};
}

}  // namespace gridreel::gallery
