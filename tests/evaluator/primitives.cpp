#include "primitives.h"

#include <string>

namespace gridreel::evaluator {
namespace {

using nlohmann::json;

std::vector<Triangle> assemble(int mode, const std::vector<std::uint32_t>& v) {
    std::vector<Triangle> triangles;
    if (mode == 4)
        for (std::size_t i = 0; i + 2 < v.size(); i += 3) triangles.push_back({v[i], v[i + 1], v[i + 2]});
    if (mode == 5)
        for (std::size_t i = 0; i + 2 < v.size(); ++i)
            triangles.push_back({v[i], v[i + (1 + i % 2)], v[i + (2 - i % 2)]});
    if (mode == 6)
        for (std::size_t i = 0; i + 2 < v.size(); ++i) triangles.push_back({v[i + 1], v[i + 2], v[0]});
    return triangles;
}

Table attribute(const File& file, const json& attributes, const std::string& name) {
    return attributes.contains(name) ? read_accessor(file, attributes[name])
                                     : Table{.width = 3, .values = {}};
}

/// JOINTS_0, JOINTS_1, … or WEIGHTS_0, WEIGHTS_1, …
std::vector<Table> sets(const File& file, const json& attributes, const std::string& name) {
    std::vector<Table> tables;
    while (attributes.contains(name + std::to_string(tables.size())))
        tables.push_back(read_accessor(file, attributes[name + std::to_string(tables.size())]));
    return tables;
}

}  // namespace

std::vector<Primitive> read_primitives(const File& file, std::size_t mesh) {
    std::vector<Primitive> primitives;
    for (const json& entry : file.json.at("meshes").at(mesh).at("primitives")) {
        const json& attributes = entry.at("attributes");
        const int mode = entry.value("mode", 4);
        if (mode < 4 || !attributes.contains("POSITION")) continue;

        Primitive primitive{.positions = attribute(file, attributes, "POSITION"),
                            .normals = attribute(file, attributes, "NORMAL"),
                            .triangles = {},
                            .targets = {},
                            .joints = sets(file, attributes, "JOINTS_"),
                            .weights = sets(file, attributes, "WEIGHTS_")};
        std::vector<std::uint32_t> order;
        if (entry.contains("indices")) {
            for (const double index : read_accessor(file, entry["indices"]).values)
                order.push_back(static_cast<std::uint32_t>(index));
        } else {
            for (std::uint32_t i = 0; i < primitive.positions.count(); ++i) order.push_back(i);
        }
        primitive.triangles = assemble(mode, order);
        for (const json& target : entry.value("targets", json::array()))
            primitive.targets.push_back(
                {attribute(file, target, "POSITION"), attribute(file, target, "NORMAL")});
        primitives.push_back(std::move(primitive));
    }
    return primitives;
}

}  // namespace gridreel::evaluator
