#include "random_values.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>

namespace gridreel::test {
namespace {

template <class T>
void append(std::vector<std::uint8_t>& bytes, T value) {
    const std::size_t end = bytes.size();
    bytes.resize(end + sizeof value);
    std::memcpy(bytes.data() + end, &value, sizeof value);
}

template <class T>
void append_whole(std::vector<std::uint8_t>& bytes, double value, bool normalized) {
    constexpr double lowest = double(std::numeric_limits<T>::lowest()),
                     highest = double(std::numeric_limits<T>::max());
    append(bytes,
           static_cast<T>(std::clamp(std::round(normalized ? value * highest : value), lowest, highest)));
}

void append_number(std::vector<std::uint8_t>& bytes, double value, Encoding encoding) {
    switch (encoding.component) {
        case int8:
            return append_whole<std::int8_t>(bytes, value, encoding.normalized);
        case uint8:
            return append_whole<std::uint8_t>(bytes, value, encoding.normalized);
        case int16:
            return append_whole<std::int16_t>(bytes, value, encoding.normalized);
        case uint16:
            return append_whole<std::uint16_t>(bytes, value, encoding.normalized);
        case uint32:
            return append_whole<std::uint32_t>(bytes, value, encoding.normalized);
        case float32:
            return append(bytes, float(value));
    }
}

void pad(std::vector<std::uint8_t>& bytes, std::size_t count) {
    bytes.insert(bytes.end(), count, 0xa5);
}

/// Elements of a base array that `sparse` puts right.
std::vector<double> spoiled(const std::vector<double>& values, std::size_t width,
                            const std::vector<std::uint32_t>& elements) {
    std::vector<double> result = values;
    for (const std::size_t element : elements)
        for (std::size_t i = 0; i < width; ++i)
            result[element * width + i] = 1.0 - values[element * width + i];
    return result;
}

nlohmann::json sparse_part(GltfBuilder& file, Chance& chance, const std::vector<double>& values,
                           std::size_t width, const std::vector<std::uint32_t>& elements, Encoding encoding) {
    const Encoding index_encoding{chance.any_of(std::vector{uint8, uint16, uint32}), false};
    std::vector<std::uint8_t> indices, replacements;
    pad(indices, 4);
    for (const std::uint32_t element : elements) {
        append_number(indices, element, index_encoding);
        for (std::size_t i = 0; i < width; ++i)
            append_number(replacements, values[element * width + i], encoding);
    }
    return {{"count", elements.size()},
            {"indices",
             {{"bufferView", file.add_view(indices)},
              {"byteOffset", 4},
              {"componentType", int(index_encoding.component)}}},
            {"values", {{"bufferView", file.add_view(replacements)}}}};
}

}  // namespace

std::size_t add_values(GltfBuilder& file, Chance& chance, const std::vector<double>& values,
                       const std::string& type, Encoding encoding, Reader reader) {
    static const std::map<std::string, std::size_t> widths{
        {"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const std::size_t width = widths.at(type), count = values.size() / width;
    nlohmann::json accessor{{"componentType", int(encoding.component)}, {"type", type}, {"count", count}};
    if (encoding.normalized) accessor["normalized"] = true;

    std::vector<std::uint32_t> displaced;
    if (chance.one_in(3))
        for (std::uint32_t element = 0; element < count; ++element)
            if (chance.one_in(2)) displaced.push_back(element);
    std::vector<double> base = spoiled(values, width, displaced);
    // Without a buffer view the base is zeros, and everything must be put right.
    const bool without_base = displaced.size() == count;
    if (!displaced.empty())
        accessor["sparse"] = sparse_part(file, chance, values, width, displaced, encoding);

    if (!without_base) {
        std::vector<std::uint8_t> bytes;
        const std::size_t offset = 4 * std::size_t(chance.whole(0, 2));
        pad(bytes, offset);
        std::size_t stride = 0;
        for (std::size_t element = 0; element < count; ++element) {
            const std::size_t start = bytes.size();
            for (std::size_t i = 0; i < width; ++i) append_number(bytes, base[element * width + i], encoding);
            if (reader == Reader::others) continue;
            if (stride == 0)
                stride = (bytes.size() - start + 3) / 4 * 4 + 4 * std::size_t(chance.whole(0, 2));
            pad(bytes, start + stride - bytes.size());
        }
        accessor["bufferView"] = file.add_view(bytes);
        if (offset > 0) accessor["byteOffset"] = offset;
        if (stride > 0) file.json["bufferViews"].back()["byteStride"] = stride;
    }
    file.json["accessors"].push_back(accessor);
    return file.json["accessors"].size() - 1;
}

}  // namespace gridreel::test
