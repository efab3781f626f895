#include "accessor.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>

namespace gridreel::evaluator {
namespace {

using nlohmann::json;

template <class T>
double number(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return double(value);
}

std::size_t size_of(int component_type) {
    switch (component_type) {
        case 5120:
        case 5121:
            return 1;
        case 5122:
        case 5123:
            return 2;
        case 5125:
        case 5126:
            return 4;
        default:
            throw std::runtime_error("unknown component type");
    }
}

/// Section 3.6.2.2 for the types, section 3.11 for the equations of normalised integers.
double decode(int component_type, bool normalized, const char* bytes) {
    switch (component_type) {
        case 5120:
            return normalized ? std::max(number<std::int8_t>(bytes) / 127.0, -1.0)
                              : number<std::int8_t>(bytes);
        case 5121:
            return number<std::uint8_t>(bytes) / (normalized ? 255.0 : 1.0);
        case 5122:
            return normalized ? std::max(number<std::int16_t>(bytes) / 32767.0, -1.0)
                              : number<std::int16_t>(bytes);
        case 5123:
            return number<std::uint16_t>(bytes) / (normalized ? 65535.0 : 1.0);
        case 5125:
            return number<std::uint32_t>(bytes);
        default:
            return number<float>(bytes);
    }
}

/// Elements one after another in a buffer view, `byteStride` apart where the view has one.
Table read_elements(const File& file, const json& place, int component_type, bool normalized,
                    std::size_t width, std::size_t count) {
    const json& view = file.json.at("bufferViews").at(place.at("bufferView").get<std::size_t>());
    const std::string& buffer = file.buffers.at(view.at("buffer").get<std::size_t>());
    const std::size_t size = size_of(component_type);
    const std::size_t stride = view.value("byteStride", size * width);
    const std::size_t start =
        view.value("byteOffset", std::size_t{0}) + place.value("byteOffset", std::size_t{0});
    if (count > 0 && start + stride * (count - 1) + size * width > buffer.size())
        throw std::out_of_range("accessor past its buffer");

    Table table{.width = width, .values = {}};
    for (std::size_t element = 0; element < count; ++element) {
        for (std::size_t i = 0; i < width; ++i) {
            const char* const bytes = buffer.data() + start + element * stride + i * size;
            table.values.push_back(decode(component_type, normalized, bytes));
        }
    }
    return table;
}

}  // namespace

Table read_accessor(const File& file, std::size_t index) {
    static const std::map<std::string, std::size_t> widths{
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
    const json& accessor = file.json.at("accessors").at(index);
    const int component_type = accessor.at("componentType");
    const bool normalized = accessor.value("normalized", false);
    const std::size_t width = widths.at(accessor.at("type")), count = accessor.at("count");

    Table table{.width = width, .values = std::vector<double>(width * count, 0.0)};
    if (accessor.contains("bufferView"))
        table = read_elements(file, accessor, component_type, normalized, width, count);
    if (!accessor.contains("sparse")) return table;

    const json& sparse = accessor["sparse"];
    const std::size_t displaced = sparse.at("count");
    const Table indices =
        read_elements(file, sparse.at("indices"), sparse["indices"].at("componentType"), false, 1, displaced);
    const Table values =
        read_elements(file, sparse.at("values"), component_type, normalized, width, displaced);
    for (std::size_t i = 0; i < displaced; ++i) {
        const auto element = static_cast<std::size_t>(indices.values[i]);
        for (std::size_t k = 0; k < width; ++k) table.values.at(element * width + k) = values[i][k];
    }
    return table;
}

}  // namespace gridreel::evaluator
