#include "draco_builder.h"

#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>
#include <glm/glm.hpp>

#include <cmath>
#include <memory>
#include <random>
#include <stdexcept>

namespace gridreel::test {
namespace {

template <class Vector>
void add_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, draco::DataType data_type,
                   const std::vector<Vector>& values, bool normalized = false) {
    if (values.empty()) return;
    auto attribute = std::make_unique<draco::PointAttribute>();
    attribute->Init(type, static_cast<std::int8_t>(Vector::length()), data_type, normalized, values.size());
    for (std::uint32_t i = 0; i < values.size(); ++i)
        attribute->SetAttributeValue(draco::AttributeValueIndex(i), &values[i]);
    mesh.AddAttribute(std::move(attribute));
}

std::unique_ptr<draco::Mesh> draco_mesh(const PlainMesh& plain) {
    auto mesh = std::make_unique<draco::Mesh>();
    mesh->set_num_points(static_cast<std::uint32_t>(plain.positions.size()));
    for (const glm::uvec3& t : plain.triangles)
        mesh->AddFace({draco::PointIndex(t.x), draco::PointIndex(t.y), draco::PointIndex(t.z)});
    using draco::GeometryAttribute;
    add_attribute(*mesh, GeometryAttribute::POSITION, draco::DT_FLOAT32, plain.positions);
    add_attribute(*mesh, GeometryAttribute::NORMAL, draco::DT_FLOAT32, plain.normals);
    add_attribute(*mesh, GeometryAttribute::TEX_COORD, draco::DT_FLOAT32, plain.texcoords);
    add_attribute(*mesh, GeometryAttribute::COLOR, draco::DT_UINT8, plain.colors, true);
    add_attribute(*mesh, GeometryAttribute::GENERIC, draco::DT_UINT16, plain.joints);
    add_attribute(*mesh, GeometryAttribute::GENERIC, draco::DT_FLOAT32, plain.weights);
    // Shared positions make connectivity, the rest makes seams.
    if (!mesh->DeduplicateAttributeValues()) throw std::logic_error("Draco cannot share values");
    return mesh;
}

}  // namespace

PlainMesh bumpy_sheet(std::uint32_t seed, std::uint32_t cells) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> fraction(0.0f, 1.0f);
    PlainMesh mesh;
    const std::uint32_t side = cells + 1, seam = cells / 2;
    std::vector<float> heights(side * side);
    for (float& height : heights) height = fraction(random);

    // One sheet left of the seam, one right of it: columns of vertices along the seam come twice.
    for (const bool right : {false, true}) {
        const std::uint32_t first = right ? seam : 0, last = right ? cells : seam;
        const auto base = static_cast<std::uint32_t>(mesh.positions.size()), width = last - first + 1;
        for (std::uint32_t y = 0; y <= cells; ++y)
            for (std::uint32_t x = first; x <= last; ++x) {
                const auto number = static_cast<std::uint16_t>(mesh.positions.size());
                mesh.positions.emplace_back(x, heights[y * side + x], y);
                mesh.normals.push_back(glm::normalize(glm::vec3(fraction(random) - 0.5f, 1.0f, 0.3f)));
                mesh.texcoords.emplace_back(float(x) / float(cells) + (right ? 0.25f : 0.0f),
                                            float(y) / float(cells));
                mesh.colors.emplace_back(random() % 256, random() % 256, number % 256, 255);
                mesh.joints.emplace_back(number, 1, 2, 3);
                const glm::vec4 weights(1.0f + fraction(random), 1.0f + fraction(random), 1.0f, 1.0f);
                mesh.weights.push_back(weights / (weights.x + weights.y + 2.0f));
            }
        for (std::uint32_t y = 0; y < cells; ++y)
            for (std::uint32_t x = 0; x + 1 < width; ++x) {
                const std::uint32_t a = base + y * width + x, b = a + width;
                mesh.triangles.emplace_back(a, b, a + 1);
                mesh.triangles.emplace_back(a + 1, b, b + 1);
            }
    }
    return mesh;
}

std::vector<std::byte> encode_draco(const PlainMesh& plain, const DracoSettings& settings) {
    const auto mesh = draco_mesh(plain);
    draco::ExpertEncoder encoder(*mesh);
    encoder.SetEncodingMethod(settings.sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                                  : draco::MESH_EDGEBREAKER_ENCODING);
    encoder.SetSpeedOptions(settings.speed, settings.speed);
    for (int i = 0; i < mesh->num_attributes(); ++i) {
        const auto& attribute = *mesh->attribute(i);
        if (attribute.data_type() != draco::DT_FLOAT32) continue;
        const bool is_position = attribute.attribute_type() == draco::GeometryAttribute::POSITION;
        encoder.SetAttributeQuantization(i, is_position ? settings.position_bits : settings.other_bits);
    }
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeToBuffer(&buffer).ok()) throw std::logic_error("Draco cannot encode the mesh");
    const auto* const data = reinterpret_cast<const std::byte*>(buffer.data());
    return {data, data + buffer.size()};
}

GltfBuilder draco_file(const PlainMesh& mesh, const std::vector<std::byte>& stream) {
    GltfBuilder file;
    const auto view = file.add_view(stream);
    nlohmann::json primitive = {{"attributes", nlohmann::json::object()}, {"mode", 4}};
    auto& draco = primitive["extensions"]["KHR_draco_mesh_compression"];
    draco = {{"bufferView", view}, {"attributes", nlohmann::json::object()}};
    file.json["accessors"] = nlohmann::json::array();
    const auto add = [&](Component component, std::string_view type, std::size_t count) {
        file.json["accessors"].push_back(
            {{"componentType", int(component)}, {"type", type}, {"count", count}});
        return file.json["accessors"].size() - 1;
    };
    const auto add_attribute = [&](const char* name, Component component, std::string_view type,
                                   std::size_t count) {
        if (count == 0) return;
        const std::size_t id = draco["attributes"].size();
        draco["attributes"][name] = id;
        primitive["attributes"][name] = add(component, type, count);
    };
    add_attribute("POSITION", float32, "VEC3", mesh.positions.size());
    add_attribute("NORMAL", float32, "VEC3", mesh.normals.size());
    add_attribute("TEXCOORD_0", float32, "VEC2", mesh.texcoords.size());
    add_attribute("COLOR_0", uint8, "VEC4", mesh.colors.size());
    if (!mesh.colors.empty()) file.json["accessors"].back()["normalized"] = true;
    add_attribute("JOINTS_0", uint16, "VEC4", mesh.joints.size());
    add_attribute("WEIGHTS_0", float32, "VEC4", mesh.weights.size());
    primitive["indices"] = add(uint16, "SCALAR", 3 * mesh.triangles.size());

    file.json["meshes"] = nlohmann::json::array({{{"primitives", nlohmann::json::array({primitive})}}});
    file.json["nodes"] = nlohmann::json::array({{{"mesh", 0}}});
    file.json["extensionsUsed"] = file.json["extensionsRequired"] =
        nlohmann::json::array({"KHR_draco_mesh_compression"});
    return file;
}

GltfBuilder draco_file(const PlainMesh& mesh, const DracoSettings& settings) {
    return draco_file(mesh, encode_draco(mesh, settings));
}

}  // namespace gridreel::test
