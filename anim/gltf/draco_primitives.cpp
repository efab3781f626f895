#include "anim/gltf/draco_primitives.h"

#include "anim/gltf/draco_mesh.h"
#include "anim/gltf/triangles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace gridreel::anim::gltf {
namespace {

constexpr auto remedy = "export the model again, without mesh compression if need be";

/// The names of the attributes that the extension says it holds.
std::vector<std::string> names_of(const Place& draco) {
    std::vector<std::string> names;
    const Place map = draco.at("attributes");
    for (const auto& [name, value] : std::get<Json::Object>(map.json().value)) names.push_back(name);
    return names;
}

/// What the primitive's accessors say about the compressed data.
DracoRequest request_of(Document& document, const Place& primitive, const Place& draco) {
    const Place attributes = primitive.at("attributes"), ids = draco.at("attributes");
    const auto topology = static_cast<Topology>(primitive.integer_or("mode", 4));
    if (topology != Topology::triangles && topology != Topology::triangle_strip)
        primitive.at("mode").refuse("only triangles and triangle strips can be compressed by Draco");

    DracoRequest request{.most_bytes = document.budget().left()};
    for (const std::string& name : names_of(draco)) {
        const Place id = ids.at(name);
        if (!attributes.has(name))
            id.refuse(fmt::format("the primitive has no {} for this compressed attribute", name));
        if (id.integer() > std::numeric_limits<std::uint32_t>::max())
            id.refuse(fmt::format("{} is not an identifier of Draco, which has 32 bits", id.integer()));

        const Accessor& accessor = document.accessors()[attributes.at(name).index()];
        if (accessor.element.columns > 1)
            attributes.at(name).refuse(
                fmt::format("{} is {}, which Draco does not hold", name, accessor.element.name));
        request.points = accessor.count;
        request.attributes.push_back({.name = name,
                                      .unique_id = id.index(),
                                      .component = accessor.component,
                                      .components = accessor.element.components()});
    }
    if (request.attributes.empty()) ids.refuse("the extension names no attribute");

    // A strip has as many indices as whoever made it liked; what is decoded are its triangles.
    if (const auto indices = primitive.find("indices"); indices && topology == Topology::triangles) {
        const std::size_t count = document.accessors()[indices->index()].count;
        if (count % 3 != 0) indices->refuse(fmt::format("{} indices do not make whole triangles", count));
        request.triangles = count / 3;
    }
    return request;
}

/// Whether everything that is compressed is there uncompressed, too.
bool has_copy(const Document& document, const Place& primitive, const Place& draco) {
    const auto has_bytes = [&](const Place& place) {
        const Accessor& accessor = document.accessors()[place.index()];
        return accessor.data != nullptr;
    };
    const auto names = names_of(draco);
    const Place attributes = primitive.at("attributes");
    const auto indices = primitive.find("indices");
    return (!indices || has_bytes(*indices)) &&
           std::all_of(names.begin(), names.end(),
                       [&](const std::string& name) { return has_bytes(attributes.at(name)); });
}

void set(Json& object, std::string_view name, double number) {
    if (Json* const found = object.find(name))
        found->value = number;
    else
        std::get<Json::Object>(object.value).emplace_back(name, Json{number});
}

Index add_indices(Document& document, const std::vector<std::uint32_t>& indices) {
    std::vector<std::byte> bytes(indices.size() * sizeof(std::uint32_t));
    if (!bytes.empty()) std::memcpy(bytes.data(), indices.data(), bytes.size());
    return document.add_accessor(
        {.component = ComponentType::uint32, .element = {.name = "SCALAR"}, .count = indices.size()},
        std::move(bytes));
}

/// Adds the decoded values to the document and makes the primitive name them.
void rewrite(Document& document, Json& json, const Place& primitive, const DracoRequest& request,
             DracoMesh mesh) {
    std::size_t bytes = mesh.indices.size() * sizeof(std::uint32_t);
    for (const auto& values : mesh.attributes) bytes += values.size();
    document.budget().spend(bytes, primitive);

    const Index indices = add_indices(document, mesh.indices);
    for (std::size_t i = 0; i < request.attributes.size(); ++i) {
        const std::string& name = request.attributes[i].name;
        const Accessor stated = document.accessors()[primitive.at("attributes").at(name).index()];
        set(*json.find("attributes"), name, document.add_accessor(stated, std::move(mesh.attributes[i])));
    }
    set(json, "indices", indices);
    set(json, "mode", static_cast<double>(Topology::triangles));
}

void decompress(Document& document, Json& json, const Place& primitive) {
    const auto draco = primitive.find_extension("KHR_draco_mesh_compression");
    if (!draco) return;

    const DracoRequest request = request_of(document, primitive, *draco);
    DracoMesh mesh = decode_draco(document.view(draco->at("bufferView").index()), request);
    if (mesh.refusal.empty())
        rewrite(document, json, primitive, request, std::move(mesh));
    else if (has_copy(document, primitive, *draco))
        document.warn(*draco, fmt::format("{}; the uncompressed copy is used", mesh.refusal));
    else
        draco->refuse(mesh.refusal, remedy);
}

}  // namespace

void decompress_primitives(Document& document) {
    const auto meshes = document.all("meshes");
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        Json& mesh = std::get<Json::Array>(document.json().find("meshes")->value)[m];
        auto& primitives = std::get<Json::Array>(mesh.find("primitives")->value);
        for (std::size_t p = 0; p < primitives.size(); ++p)
            decompress(document, primitives[p], meshes[m].at("primitives", p));
    }
}

}  // namespace gridreel::anim::gltf
