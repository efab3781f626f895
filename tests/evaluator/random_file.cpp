#include "random_file.h"

#include "random_values.h"

#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace gridreel::test {
namespace {

using nlohmann::json;

/// What the file holds, chosen beforehand so that its parts fit.
struct Plan {
    std::size_t nodes = 0;
    std::size_t meshes = 0;
    std::vector<std::size_t> targets;  ///< per mesh
    std::size_t joints = 0;            ///< of the only skin
};

std::vector<double> reals(Chance& chance, std::size_t count, double low, double high) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(chance.real(low, high));
    return values;
}

/// Vectors of unit length, one after another.
std::vector<double> directions(Chance& chance, std::size_t count, std::size_t width) {
    std::vector<double> values;
    while (values.size() < count * width) {
        const auto vector = reals(chance, width, -1, 1);
        double square = 0;
        for (const double x : vector) square += x * x;
        if (square < 0.1 || square > 1) continue;
        for (const double x : vector) values.push_back(x / std::sqrt(square));
    }
    return values;
}

Encoding fraction(Chance& chance, bool with_sign) {
    if (chance.one_in(3)) return {};
    if (with_sign) return {chance.one_in(2) ? int8 : int16, true};
    return {chance.one_in(2) ? uint8 : uint16, true};
}

std::vector<double> scales(Chance& chance, std::size_t count) {
    auto values = reals(chance, 3 * count, 0.4, 1.8);
    for (double& value : values)
        if (chance.one_in(4)) value = -value;
    return values;
}

// --- Meshes ------------------------------------------------------------------------------------

void add_indices(GltfBuilder& file, Chance& chance, json& primitive, std::size_t vertices, int mode) {
    std::size_t count = std::size_t(chance.whole(3, 9));
    if (mode == 4) count -= count % 3;
    std::vector<double> indices;
    for (std::size_t i = 0; i < count; ++i) indices.push_back(chance.whole(0, int(vertices) - 1));
    const Encoding encoding{chance.any_of(std::vector{uint8, uint16, uint32}), false};
    primitive["indices"] = add_values(file, chance, indices, "SCALAR", encoding, Reader::others);
}

void add_influences(GltfBuilder& file, Chance& chance, json& attributes, std::size_t vertices,
                    std::size_t joint_count) {
    const int sets = chance.whole(1, 2);
    for (int set = 0; set < sets; ++set) {
        std::vector<double> joints;
        for (std::size_t i = 0; i < 4 * vertices; ++i)
            joints.push_back(chance.whole(0, int(joint_count) - 1));
        const Encoding encoding{chance.one_in(2) ? uint8 : uint16, false};
        attributes["JOINTS_" + std::to_string(set)] =
            add_values(file, chance, joints, "VEC4", encoding, Reader::vertices);
        attributes["WEIGHTS_" + std::to_string(set)] =
            add_values(file, chance, reals(chance, 4 * vertices, 0.05, 0.9), "VEC4", fraction(chance, false),
                       Reader::vertices);
    }
}

json random_primitive(GltfBuilder& file, Chance& chance, std::size_t target_count, std::size_t joint_count) {
    const std::size_t vertices = 3 * std::size_t(chance.whole(1, 3));
    const int mode = chance.one_in(8) ? chance.whole(0, 3) : chance.whole(4, 6);
    const std::vector<Encoding> whole{{int8, false}, {int16, false}, {uint8, false}, {uint16, false}};
    json primitive{{"mode", mode}};
    json& attributes = primitive["attributes"];

    const Encoding places = chance.one_in(3) ? chance.any_of(whole) : fraction(chance, true);
    const double reach = places.component == float32 || places.normalized ? 1 : 100;
    attributes["POSITION"] = add_values(file, chance, reals(chance, 3 * vertices, -reach, reach), "VEC3",
                                        places, Reader::vertices);
    const bool has_normals = !chance.one_in(3);
    if (has_normals)
        attributes["NORMAL"] = add_values(file, chance, directions(chance, vertices, 3), "VEC3",
                                          fraction(chance, true), Reader::vertices);
    if (joint_count > 0) add_influences(file, chance, attributes, vertices, joint_count);
    for (std::size_t target = 0; target < target_count; ++target) {
        json displacements = json::object();
        if (!chance.one_in(4))
            displacements["POSITION"] = add_values(file, chance, reals(chance, 3 * vertices, -0.9, 0.9),
                                                   "VEC3", fraction(chance, true), Reader::vertices);
        if (has_normals && chance.one_in(2))
            displacements["NORMAL"] = add_values(file, chance, reals(chance, 3 * vertices, -0.2, 0.2), "VEC3",
                                                 fraction(chance, true), Reader::vertices);
        primitive["targets"].push_back(displacements);
    }
    if (mode > 3 && chance.one_in(2)) add_indices(file, chance, primitive, vertices, mode);
    return primitive;
}

/// Mesh 0 is the skinned one.
void add_meshes(GltfBuilder& file, Chance& chance, const Plan& plan) {
    for (std::size_t index = 0; index < plan.meshes; ++index) {
        json mesh;
        const int count = chance.whole(1, 2);
        for (int i = 0; i < count; ++i)
            mesh["primitives"].push_back(
                random_primitive(file, chance, plan.targets[index], index == 0 ? plan.joints : 0));
        if (plan.targets[index] > 0 && chance.one_in(2))
            mesh["weights"] = reals(chance, plan.targets[index], 0, 1);
        file.json["meshes"].push_back(mesh);
    }
}

// --- Nodes -------------------------------------------------------------------------------------

void add_instances(GltfBuilder& file, Chance& chance, json& node) {
    const std::size_t count = std::size_t(chance.whole(1, 3));
    json& attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    attributes["TRANSLATION"] =
        add_values(file, chance, reals(chance, 3 * count, -2, 2), "VEC3", {}, Reader::others);
    if (chance.one_in(2))
        attributes["ROTATION"] = add_values(file, chance, directions(chance, count, 4), "VEC4",
                                            fraction(chance, true), Reader::others);
    if (chance.one_in(2))
        attributes["SCALE"] = add_values(file, chance, scales(chance, count), "VEC3", {}, Reader::others);
}

void place(Chance& chance, json& node) {
    if (chance.one_in(5)) {
        // A quarter turn about z, mirrored, moved; column by column.
        node["matrix"] = {0, 1.5, 0, 0, 0.5, 0, 0, 0, 0, 0, chance.real(0.5, 2), 0, chance.real(-1, 1),
                          2, 0,   1};
        return;
    }
    if (chance.one_in(2)) node["translation"] = reals(chance, 3, -2, 2);
    if (chance.one_in(2)) node["rotation"] = directions(chance, 1, 4);
    if (chance.one_in(2)) node["scale"] = scales(chance, 1);
}

void add_nodes(GltfBuilder& file, Chance& chance, const Plan& plan) {
    json& nodes = file.json["nodes"];
    for (std::size_t index = 0; index < plan.nodes; ++index) {
        json node = json::object();
        place(chance, node);
        if (chance.one_in(5)) node["extensions"]["KHR_node_visibility"]["visible"] = chance.one_in(2);
        if (index < plan.meshes || chance.one_in(3)) {
            const std::size_t mesh =
                index < plan.meshes ? index : std::size_t(chance.whole(0, int(plan.meshes) - 1));
            node["mesh"] = mesh;
            // Without a skin the joints of a mesh are let be.
            if (mesh == 0 && !chance.one_in(4))
                node["skin"] = 0;
            else if (chance.one_in(3))
                add_instances(file, chance, node);
            if (plan.targets[mesh] > 0 && chance.one_in(2))
                node["weights"] = reals(chance, plan.targets[mesh], 0, 1);
        }
        nodes.push_back(node);
        // Children before or after their elder siblings: file order is that of the list.
        if (index == 0) continue;
        json& children = nodes[std::size_t(chance.whole(0, int(index) - 1))]["children"];
        if (children.is_null()) children = json::array();
        if (chance.one_in(2))
            children.push_back(index);
        else
            children.insert(children.begin(), index);
    }
    file.json["scenes"] = {{{"nodes", json::array({0})}}};

    json skin;
    std::set<int> joints;
    while (joints.size() < plan.joints) joints.insert(chance.whole(0, int(plan.nodes) - 1));
    for (const int joint : joints) skin["joints"].push_back(joint);
    if (chance.one_in(2)) {
        std::vector<double> matrices;
        for (std::size_t joint = 0; joint < plan.joints; ++joint) {
            const double s = chance.real(0.01, 1), x = chance.real(-1, 1);
            for (const double element : {s, 0., 0., 0., 0., 0., s, 0., 0., -s, 0., 0., x, 0.5, -x, 1.})
                matrices.push_back(element);
        }
        skin["inverseBindMatrices"] = add_values(file, chance, matrices, "MAT4", {}, Reader::others);
    }
    file.json["skins"].push_back(skin);
}

// --- Animations --------------------------------------------------------------------------------

std::vector<double> key_times(Chance& chance, bool cubic) {
    std::vector<double> times{chance.one_in(2) ? 0.0 : chance.real(0, 2)};
    const std::size_t count = std::size_t(chance.whole(cubic ? 2 : 1, 5));
    while (times.size() < count) times.push_back(times.back() + chance.real(0.05, 1));
    return times;
}

/// Keys of a property with values from `one_key`; tangents are small, so that no rotation comes out as zero.
json random_sampler(GltfBuilder& file, Chance& chance, const std::string& type, std::size_t width,
                    Encoding encoding, bool only_steps, const std::function<std::vector<double>()>& one_key) {
    const std::string mode =
        only_steps ? "STEP" : chance.any_of(std::vector<std::string>{"STEP", "LINEAR", "CUBICSPLINE"});
    const bool cubic = mode == "CUBICSPLINE";
    const auto times = key_times(chance, cubic);
    std::vector<double> values;
    for (std::size_t key = 0; key < times.size(); ++key) {
        const auto append = [&](const std::vector<double>& more) {
            values.insert(values.end(), more.begin(), more.end());
        };
        if (cubic) append(reals(chance, width, -0.3, 0.3));
        append(one_key());
        if (cubic) append(reals(chance, width, -0.3, 0.3));
    }
    return {{"input", add_values(file, chance, times, "SCALAR", {}, Reader::others)},
            {"output", add_values(file, chance, values, type, encoding, Reader::others)},
            {"interpolation", mode}};
}

void add_channel(json& animation, const json& sampler, const json& target) {
    animation["samplers"].push_back(sampler);
    animation["channels"].push_back({{"sampler", animation["samplers"].size() - 1}, {"target", target}});
}

json target_of(Chance& chance, std::size_t node, const std::string& path) {
    if (chance.one_in(2)) return {{"node", node}, {"path", path}};
    return {{"path", "pointer"},
            {"extensions",
             {{"KHR_animation_pointer", {{"pointer", "/nodes/" + std::to_string(node) + "/" + path}}}}}};
}

void animate_node(GltfBuilder& file, Chance& chance, json& animation, std::size_t index, const Plan& plan) {
    const json node = file.json["nodes"][index];
    const auto animate = [&](const std::string& path, const std::string& type, std::size_t width,
                             Encoding encoding, const std::function<std::vector<double>()>& one_key) {
        const json sampler = random_sampler(file, chance, type, width, encoding, false, one_key);
        add_channel(animation, sampler, target_of(chance, index, path));
    };
    if (!node.contains("matrix")) {
        if (chance.one_in(3)) animate("translation", "VEC3", 3, {}, [&] { return reals(chance, 3, -2, 2); });
        if (chance.one_in(3))
            animate("rotation", "VEC4", 4, fraction(chance, true), [&] { return directions(chance, 1, 4); });
        if (chance.one_in(3)) animate("scale", "VEC3", 3, {}, [&] { return scales(chance, 1); });
    }
    const std::size_t targets = node.contains("mesh") ? plan.targets[node["mesh"]] : 0;
    if (targets > 0 && node.contains("weights") && chance.one_in(2))
        animate("weights", "SCALAR", targets, fraction(chance, true),
                [&] { return reals(chance, targets, -0.5, 1); });
    if (node.contains("extensions") && node["extensions"].contains("KHR_node_visibility") &&
        chance.one_in(2)) {
        const json sampler = random_sampler(file, chance, "SCALAR", 1, {uint8, false}, true,
                                            [&] { return std::vector{double(chance.whole(0, 1))}; });
        json target{{"path", "pointer"}};
        target["extensions"]["KHR_animation_pointer"]["pointer"] =
            "/nodes/" + std::to_string(index) + "/extensions/KHR_node_visibility/visible";
        add_channel(animation, sampler, target);
    }
}

}  // namespace

GltfBuilder random_file(std::uint32_t seed) {
    Chance chance(seed);
    Plan plan{.nodes = std::size_t(chance.whole(4, 12)),
              .meshes = std::size_t(chance.whole(2, 3)),
              .targets = {},
              .joints = std::size_t(chance.whole(1, 4))};
    for (std::size_t mesh = 0; mesh < plan.meshes; ++mesh)
        plan.targets.push_back(std::size_t(chance.whole(0, 3)));

    GltfBuilder file;
    const json extensions{"KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "KHR_node_visibility",
                          "KHR_animation_pointer"};
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = extensions;
    add_meshes(file, chance, plan);
    add_nodes(file, chance, plan);
    const int animations = chance.whole(0, 3);
    for (int i = 0; i < animations; ++i) {
        json animation;
        for (std::size_t node = 0; node < plan.nodes; ++node)
            if (chance.one_in(2)) animate_node(file, chance, animation, node, plan);
        if (!animation.is_null()) file.json["animations"].push_back(animation);
    }
    return file;
}

}  // namespace gridreel::test
