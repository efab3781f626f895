// The validator's DATA and GLB codes, in the order of its ISSUES.md, and those of its newer versions. Left
// out are ACCESSOR_INDEX_TRIANGLE_DEGENERATE and IMAGE_NPOT_DIMENSIONS, which are no defects; what becomes of
// images whose bytes are no image is a matter of `engine` (IMAGE_DATA_INVALID, IMAGE_MIME_TYPE_INVALID,
// IMAGE_UNEXPECTED_EOS, IMAGE_UNRECOGNIZED_FORMAT: tests/engine/image_decode_test.cpp).

#include "khronos_code.h"

#include <limits>

using namespace gridreel;
using Catch::Matchers::Contains;
using nlohmann::json;
using test::attributes;
using test::key_sampler;
using enum test::Verdict;
using File = test::GltfBuilder;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

std::size_t byte_accessor(File& file, std::vector<std::uint8_t> values, std::string_view type,
                          std::size_t count) {
    return file.add_accessor(values, test::uint8, type, count);
}

void put_word(std::vector<std::byte>& bytes, std::size_t offset, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) bytes[offset + i] = static_cast<std::byte>(value >> 8 * i & 0xff);
}

std::uint32_t word_at(const std::vector<std::byte>& bytes, std::size_t offset) {
    std::uint32_t word = 0;
    for (std::size_t i = 4; i-- > 0;) word = word << 8 | std::to_integer<std::uint32_t>(bytes[offset + i]);
    return word;
}

/// Gives the positions one sparse element per index.
void make_sparse(File& file, const std::vector<std::uint8_t>& indices) {
    const auto targets = file.add_view(indices);
    const auto values = file.add_view(std::vector<float>(3 * indices.size(), 1.0f));
    file.json["accessors"][0]["sparse"] = {{"count", indices.size()},
                                           {"indices", {{"bufferView", targets}, {"componentType", 5121}}},
                                           {"values", {{"bufferView", values}}}};
}

}  // namespace

TEST_CASE("numbers that make no sense meet the verdict of the table", "[validate][khronos]") {
    const test::KhronosCode codes[] = {
        {"ACCESSOR_ANIMATION_INPUT_NEGATIVE", refused, "/animations/0/samplers/0/input", "key 0 is at -1 s",
         [](File& f) {
             key_sampler(f)["input"] = f.add_scalars({-1, 0});
         }},
        {"ACCESSOR_ANIMATION_INPUT_NON_INCREASING", refused, "/animations/0/samplers/0/input",
         "does not come after",
         [](File& f) {
             key_sampler(f)["input"] = f.add_scalars({1, 1});
         }},
        {"ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND", tolerated, "", "bounds are found from the values",
         [](File& f) {
             f.json["accessors"][0]["max"] = {0, 0, 0};
         }},
        {"ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND", tolerated, "", "bounds are found from the values",
         [](File& f) {
             f.json["accessors"][0]["min"] = {9, 9, 9};
         }},
        {"ACCESSOR_MAX_MISMATCH", tolerated, "", "bounds are found from the values",
         [](File& f) {
             f.json["accessors"][0]["max"] = {7, 7, 7};
         }},
        {"ACCESSOR_MIN_MISMATCH", tolerated, "", "bounds are found from the values",
         [](File& f) {
             f.json["accessors"][0]["min"] = {-7, -7, -7};
         }},
        {"ACCESSOR_INDECOMPOSABLE_MATRIX", tolerated, "", "a matrix is applied as it stands, shear and all",
         [](File& f) {
             std::vector<float> matrices(32, 1.0f);
             f.json["skins"][0]["inverseBindMatrices"] = f.add_accessor(matrices, test::float32, "MAT4", 2);
         }},
        {"ACCESSOR_INDEX_OOB", refused, "/meshes/0/primitives/0/indices", "index 1 is 3",
         [](File& f) {
             f.json["meshes"][0]["primitives"][0]["indices"] = byte_accessor(f, {0, 3, 1}, "SCALAR", 3);
         }},
        {"ACCESSOR_INDEX_PRIMITIVE_RESTART", refused, "/meshes/0/primitives/0/indices", "restart value",
         [](File& f) {
             f.json["meshes"][0]["primitives"][0]["indices"] = byte_accessor(f, {0, 255, 1}, "SCALAR", 3);
         }},
        {"ACCESSOR_INVALID_FLOAT: positions", refused, "/meshes/0/primitives/0/attributes/POSITION",
         "component 1 is nan",
         [](File& f) {
             attributes(f)["POSITION"] = f.add_vec3s({0, not_a_number, 0, 0, 0, 0, 0, 0, 0});
         }},
        {"ACCESSOR_INVALID_FLOAT: normals", warned, "/meshes/0/primitives/0/attributes/NORMAL", "set to zero",
         [](File& f) {
             attributes(f)["NORMAL"] = f.add_vec3s({0, not_a_number, 0, 0, 0, 1, 0, 0, 1});
         }},
        {"ACCESSOR_INVALID_FLOAT: keys", refused, "/animations/0/samplers/0/output", "a key value is nan",
         [](File& f) {
             key_sampler(f)["output"] = f.add_vec3s({0, not_a_number, 0, 0, 0, 1});
         }},
        {"ACCESSOR_INVALID_IBM", tolerated, "", "the last row is taken for 0 0 0 1",
         [](File& f) {
             std::vector<float> matrices(32, 0.0f);
             for (std::size_t i = 0; i < 32; ++i) matrices[i] = i % 16 % 5 == 0 || i == 3 ? 1.0f : 0.0f;
             f.json["skins"][0]["inverseBindMatrices"] = f.add_accessor(matrices, test::float32, "MAT4", 2);
         }},
        {"ACCESSOR_INVALID_SIGN", tolerated, "", "tangents are read, and not drawn yet",
         [](File& f) {
             attributes(f)["TANGENT"] = f.add_vec4s({1, 0, 0, 2, 1, 0, 0, 1, 1, 0, 0, 1});
         }},
        {"ACCESSOR_NON_UNIT: normals", tolerated, "", "normals are normalized once they are posed",
         [](File& f) {
             attributes(f)["NORMAL"] = f.add_vec3s({0, 0, 9, 0, 0, 0, 0, 0, 1});
         }},
        {"ACCESSOR_NON_UNIT: rotations of length zero", refused, "/animations/0/samplers/0/output",
         "rotation of key 1",
         [](File& f) {
             test::channel_target(f)["path"] = "rotation";
             key_sampler(f)["output"] = f.add_vec4s({0, 0, 0, 1, 0, 0, 0, 0});
         }},
        {"ACCESSOR_JOINTS_INDEX_OOB", refused, "/nodes/0/skin", "follows joint 9",
         [](File& f) {
             attributes(f)["JOINTS_0"] = byte_accessor(f, {9, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4", 3);
         }},
        {"ACCESSOR_JOINTS_INDEX_DUPLICATE", tolerated, "", "the joint's weights add up",
         [](File& f) {
             attributes(f)["JOINTS_0"] = byte_accessor(f, {1, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4", 3);
         }},
        {"ACCESSOR_JOINTS_USED_ZERO_WEIGHT", tolerated, "", "a joint without weight does nothing",
         [](File& f) {
             attributes(f)["JOINTS_0"] = byte_accessor(f, {0, 1, 9, 9, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4", 3);
         }},
        {"ACCESSOR_WEIGHTS_NEGATIVE", refused, "/meshes/0/primitives/0/attributes/WEIGHTS_0", "weight -1",
         [](File& f) {
             attributes(f)["WEIGHTS_0"] = f.add_vec4s({-1, 2, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
         }},
        {"ACCESSOR_WEIGHTS_NON_NORMALIZED", tolerated, "", "weights are normalized as they are read",
         [](File& f) {
             attributes(f)["WEIGHTS_0"] = f.add_vec4s({5, 5, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
         }},
        {"ACCESSOR_SPARSE_INDEX_OOB", refused, "/accessors/0/sparse/indices", "is 3, but the accessor has 3",
         [](File& f) { make_sparse(f, {3}); }},
        {"ACCESSOR_SPARSE_INDICES_NON_INCREASING", refused, "/accessors/0/sparse/indices",
         "strictly increase",
         [](File& f) {
             make_sparse(f, {1, 1});
         }},
        {"BUFFER_EMBEDDED_BYTELENGTH_MISMATCH: too few bytes", refused, "/buffers/0", "but there are",
         [](File& f) {
             f.json["buffers"] = {{{"byteLength", f.buffer.size() + 1},
                                   {"uri", "data:application/gltf-buffer;base64," + test::base64(f.buffer)}}};
         }},
        {"BUFFER_EMBEDDED_BYTELENGTH_MISMATCH: too many", tolerated, "", "what no view names is not read",
         [](File& f) {
             const auto used = f.buffer.size();
             f.buffer.resize(used + 8);
             f.json["buffers"] = {{{"byteLength", used},
                                   {"uri", "data:application/gltf-buffer;base64," + test::base64(f.buffer)}}};
         }},
    };
    test::check_codes(codes);
}

TEST_CASE("a buffer beside the model that ends too early is refused", "[validate][khronos]") {
    // BUFFER_EXTERNAL_BYTELENGTH_MISMATCH
    auto file = test::bit_of_everything();
    const test::TemporaryFolder folder;
    folder.write("short.bin", std::string_view("abc"));
    file.json["buffers"] = {{{"byteLength", file.buffer.size()}, {"uri", "short.bin"}}};
    const auto refusal = test::refusal_of(test::bytes_of(file.gltf()), folder.path() / "a.gltf");
    CHECK(refusal.pointer == "/buffers/0");
    CHECK_THAT(refusal.message, Contains("but there are 3"));
}

TEST_CASE("binary containers that are broken meet the verdict of the table", "[validate][khronos]") {
    struct Damage {
        std::string code;
        std::string text;  ///< of the refusal; empty: it loads
        void (*inflict)(std::vector<std::byte>&);
    };
    using Bytes = std::vector<std::byte>;
    const Damage damages[] = {
        {"INVALID_JSON", "the JSON cannot be read", [](Bytes& b) { b[20] = std::byte{'['}; }},
        {"GLB_CHUNK_LENGTH_UNALIGNED", "",  // chunks are found by their lengths alone
         [](Bytes& b) {
             const std::size_t binary = 20 + word_at(b, 12);
             put_word(b, binary, word_at(b, binary) + 1);
             b.push_back(std::byte{0});
             put_word(b, 8, static_cast<std::uint32_t>(b.size()));
         }},
        {"GLB_CHUNK_TOO_BIG", "chunk 0 states 4294967295", [](Bytes& b) { put_word(b, 12, 0xffffffff); }},
        {"GLB_DUPLICATE_CHUNK", "",  // the first counts
         [](Bytes& b) {
             const std::size_t old = b.size();
             b.resize(old + 12);
             put_word(b, old, 4);
             put_word(b, old + 4, 0x004E4942);
             put_word(b, 8, static_cast<std::uint32_t>(b.size()));
         }},
        {"GLB_EMPTY_CHUNK", "the JSON cannot be read",
         [](Bytes& b) {
             b.resize(20);
             put_word(b, 8, 20);
             put_word(b, 12, 0);
         }},
        {"GLB_INVALID_MAGIC", "the JSON cannot be read", [](Bytes& b) { b[0] = std::byte{'x'}; }},
        {"GLB_INVALID_VERSION", "version 1", [](Bytes& b) { put_word(b, 4, 1); }},
        {"GLB_LENGTH_MISMATCH: too long", "the header states",
         [](Bytes& b) { put_word(b, 8, static_cast<std::uint32_t>(b.size() + 4)); }},
        {"GLB_LENGTH_MISMATCH: too short", "",  // a warning names the bytes after it
         [](Bytes& b) { b.resize(b.size() + 4); }},
        {"GLB_LENGTH_TOO_SMALL", "less than a header", [](Bytes& b) { put_word(b, 8, 12); }},
        {"GLB_UNEXPECTED_BIN_CHUNK", "the first chunk is not JSON",
         [](Bytes& b) { put_word(b, 16, 0x004E4942); }},
        {"GLB_UNEXPECTED_END_OF_CHUNK_DATA", "chunk 1 states",
         [](Bytes& b) {
             b.resize(b.size() - 4);
             put_word(b, 8, static_cast<std::uint32_t>(b.size()));
         }},
        {"GLB_UNEXPECTED_END_OF_CHUNK_HEADER", "ends inside its header", [](Bytes& b) { b.resize(16); }},
        {"GLB_UNEXPECTED_END_OF_HEADER", "ends inside its header", [](Bytes& b) { b.resize(10); }},
        {"GLB_UNEXPECTED_FIRST_CHUNK", "the first chunk is not JSON",
         [](Bytes& b) { put_word(b, 16, 0x12345678); }},
        {"GLB_UNKNOWN_CHUNK_TYPE", "",  // chunks of extensions may follow
         [](Bytes& b) {
             const std::size_t old = b.size();
             b.resize(old + 8);
             put_word(b, old + 4, 0x12345678);
             put_word(b, 8, static_cast<std::uint32_t>(b.size()));
         }},
    };
    for (const Damage& damage : damages) {
        DYNAMIC_SECTION(damage.code) {
            auto bytes = test::bit_of_everything().glb();
            damage.inflict(bytes);
            const auto message = test::refusal_of(bytes, "a.glb").message;
            if (damage.text.empty())
                CHECK(message.empty());
            else
                CHECK_THAT(message, Contains("a.glb: ") && Contains(damage.text));
        }
    }
}
