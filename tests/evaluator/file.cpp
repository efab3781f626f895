#include "file.h"

#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

namespace gridreel::evaluator {
namespace {

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw std::runtime_error("cannot read " + path.string());
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::size_t word(const std::string& bytes, std::size_t offset) {
    std::size_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<std::uint8_t>(bytes.at(offset + i));
    return value;
}

std::string decode_base64(std::string_view text) {
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        std::uint32_t digit = 0;
        if (c >= 'A' && c <= 'Z')
            digit = static_cast<std::uint32_t>(c - 'A');
        else if (c >= 'a' && c <= 'z')
            digit = static_cast<std::uint32_t>(c - 'a') + 26;
        else if (c >= '0' && c <= '9')
            digit = static_cast<std::uint32_t>(c - '0') + 52;
        else if (c == '+' || c == '/')
            digit = c == '+' ? 62 : 63;
        else
            continue;  // the padding
        bits = bits << 6 | digit;
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 0xff);
    }
    return bytes;
}

std::string decode_percent(std::string_view text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        decoded += static_cast<char>(std::stoi(std::string(text.substr(i + 1, 2)), nullptr, 16));
        i += 2;
    }
    return decoded;
}

std::string read_buffer(const std::string& uri, const std::filesystem::path& folder) {
    if (!uri.starts_with("data:")) return bytes_of(folder / decode_percent(uri));
    return decode_base64(std::string_view(uri).substr(uri.find(',') + 1));
}

}  // namespace

File read_file(const std::filesystem::path& path) {
    const std::string bytes = bytes_of(path);
    File file;
    std::string binary_chunk;
    if (bytes.starts_with("glTF")) {
        // Twelve bytes of header; then each chunk is its length, its type, its data.
        const std::size_t json_length = word(bytes, 12), second_chunk = 20 + json_length;
        file.json = nlohmann::json::parse(bytes.substr(20, json_length));
        if (second_chunk + 8 <= bytes.size() && bytes.compare(second_chunk + 4, 3, "BIN") == 0)
            binary_chunk = bytes.substr(second_chunk + 8, word(bytes, second_chunk));
    } else {
        file.json = nlohmann::json::parse(bytes);
    }
    for (const auto& buffer : file.json.value("buffers", nlohmann::json::array())) {
        if (buffer.contains("uri"))
            file.buffers.push_back(read_buffer(buffer["uri"], path.parent_path()));
        else
            file.buffers.push_back(file.buffers.empty() ? binary_chunk : "");
    }
    return file;
}

}  // namespace gridreel::evaluator
