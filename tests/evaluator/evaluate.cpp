#include "evaluate.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace gridreel::evaluator {
namespace {

using nlohmann::json;

/// Base values plus the weighted displacements (section 3.7.2.2).
Table morph(const Table& base, const std::vector<MorphTarget>& targets, Table MorphTarget::*displacements,
            const std::vector<double>& weights) {
    Table morphed = base;
    for (std::size_t target = 0; target < targets.size(); ++target) {
        const Table& displacement = targets[target].*displacements;
        if (base.values.empty() || displacement.values.empty()) continue;
        for (std::size_t i = 0; i < morphed.values.size(); ++i)
            morphed.values[i] += weights.at(target) * displacement.values.at(i);
    }
    return morphed;
}

/// The weighted sum of the joints' matrices (section 3.7.3.3), weights divided by their sum.
Matrix blend(const Primitive& primitive, std::size_t vertex, const std::vector<Matrix>& joints) {
    Matrix blended{};
    double sum = 0;
    for (std::size_t set = 0; set < primitive.joints.size(); ++set) {
        for (std::size_t k = 0; k < 4; ++k) {
            const double weight = primitive.weights.at(set)[vertex][k];
            const auto joint = static_cast<std::size_t>(primitive.joints[set][vertex][k]);
            for (std::size_t i = 0; i < 16; ++i) blended[i] += weight * joints.at(joint)[i];
            sum += weight;
        }
    }
    for (double& element : blended) element /= sum;
    return blended;
}

std::vector<Matrix> read_inverse_bind(const File& file, const json& skin) {
    std::vector<Matrix> matrices(skin.at("joints").size(), identity);
    if (!skin.contains("inverseBindMatrices")) return matrices;
    const Table table = read_accessor(file, skin["inverseBindMatrices"]);
    for (std::size_t joint = 0; joint < matrices.size(); ++joint)
        for (std::size_t i = 0; i < 16; ++i) matrices[joint][i] = table[joint][i];
    return matrices;
}

/// Matrices of a node's instances (EXT_mesh_gpu_instancing), or one that changes nothing.
std::vector<Matrix> read_instances(const File& file, const json& node) {
    const json::json_pointer place("/extensions/EXT_mesh_gpu_instancing/attributes");
    if (!node.contains(place)) return {identity};
    std::map<std::string, Table> attributes;
    for (const auto& [name, accessor] : node[place].items()) attributes[name] = read_accessor(file, accessor);

    std::vector<Matrix> instances;
    for (std::size_t i = 0; i < attributes.begin()->second.count(); ++i) {
        Vec3 translation{0, 0, 0}, scale{1, 1, 1};
        Vec4 rotation{0, 0, 0, 1};
        const auto set = [&](const char* name, auto& vector) {
            if (const auto found = attributes.find(name); found != attributes.end())
                std::copy_n(found->second[i].begin(), vector.size(), vector.begin());
        };
        set("TRANSLATION", translation);
        set("ROTATION", rotation);
        set("SCALE", scale);
        instances.push_back(compose(translation, rotation, scale));
    }
    return instances;
}

/// Appends one primitive to the frame.
/// @param joints    empty, or the matrix of each joint: then `placement` is not used
void append(const Primitive& primitive, const std::vector<double>& weights, const Matrix& placement,
            const std::vector<Matrix>& joints, bool visible, Frame& frame) {
    const auto first = static_cast<std::uint32_t>(frame.positions.size());
    const Table positions = morph(primitive.positions, primitive.targets, &MorphTarget::positions, weights);
    const Table normals = morph(primitive.normals, primitive.targets, &MorphTarget::normals, weights);
    for (std::size_t vertex = 0; vertex < positions.count(); ++vertex) {
        const Matrix matrix = joints.empty() ? placement : blend(primitive, vertex, joints);
        frame.positions.push_back(transform_point(matrix, positions[vertex]));
        frame.normals.push_back(
            normals.values.empty() ? Vec3{} : transform_normal(normal_matrix(matrix), normals[vertex]));
    }
    if (!visible) return;
    for (const auto& [a, b, c] : primitive.triangles)
        frame.triangles.push_back({first + a, first + b, first + c});
}

}  // namespace

Model read_model(const std::filesystem::path& path) {
    Model model{.file = read_file(path), .meshes = {}, .inverse_bind = {}, .instances = {}};
    const json none = json::array();
    for (std::size_t mesh = 0; mesh < model.file.json.value("meshes", none).size(); ++mesh)
        model.meshes.push_back(read_primitives(model.file, mesh));
    for (const json& skin : model.file.json.value("skins", none))
        model.inverse_bind.push_back(read_inverse_bind(model.file, skin));
    for (const json& node : model.file.json.value("nodes", none))
        model.instances.push_back(read_instances(model.file, node));
    return model;
}

Film::Film(const Model& model, const std::vector<std::size_t>& animations, std::size_t scene)
    : model_(model), clip_(play(model.file, animations)) {
    const auto ever_visible = nodes_ever_visible(model.file, clip_);
    for (const std::size_t node : nodes_of_scene(model.file, scene))
        if (ever_visible[node]) shown_nodes_.push_back(node);
}

Frame Film::at(double time_s) const {
    const auto states = nodes_at(model_.file, clip_, time_s);
    Frame frame;
    for (const std::size_t index : shown_nodes_) {
        const json& node = model_.file.json["nodes"][index];
        if (!node.contains("mesh")) continue;
        const NodeState& state = states[index];
        std::vector<Matrix> joints;
        if (node.contains("skin")) {
            const std::size_t skin = node["skin"];
            for (const json& joint : model_.file.json["skins"][skin]["joints"])
                joints.push_back(states.at(joint.get<std::size_t>()).world *
                                 model_.inverse_bind[skin][joints.size()]);
        }
        for (const Matrix& instance : model_.instances[index])
            for (const Primitive& primitive : model_.meshes.at(node["mesh"].get<std::size_t>()))
                append(primitive, state.weights, state.world * instance, joints, state.visible, frame);
    }
    return frame;
}

}  // namespace gridreel::evaluator
