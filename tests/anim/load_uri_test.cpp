#include "gltf_builder.h"

#include <catch2/catch.hpp>

using namespace gridreel;
using Catch::Matchers::Contains;

namespace {

/// A model in `folder` whose only buffer is at `uri`.
std::filesystem::path model_with_buffer_at(const test::TemporaryFolder& folder, std::string_view uri) {
    auto file = test::one_triangle();
    file.json["buffers"] = {{{"byteLength", file.buffer.size()}, {"uri", uri}}};
    return folder.write("models/model.gltf", file.gltf());
}

std::vector<std::byte> buffer_bytes() {
    return test::one_triangle().buffer;
}

}  // namespace

TEST_CASE("relative URIs are percent-decoded", "[load]") {
    const test::TemporaryFolder folder;
    folder.write("models/sub/a b%c\xc3\xa9.bin", buffer_bytes());
    CHECK_NOTHROW(anim::load(model_with_buffer_at(folder, "sub/a%20b%25c%C3%a9.bin")));
    folder.write("models/part:1.bin", buffer_bytes());
    CHECK_NOTHROW(anim::load(model_with_buffer_at(folder, "part%3A1.bin")));
    CHECK_NOTHROW(anim::load(model_with_buffer_at(folder, "./sub/../sub/a b%25c\xc3\xa9.bin")));
    CHECK_NOTHROW(anim::load(model_with_buffer_at(folder, "sub\\a%20b%25c\xc3\xa9.bin")));
    CHECK_NOTHROW(anim::load(model_with_buffer_at(folder, "../models/sub/a b%25c\xc3\xa9.bin")));
}

TEST_CASE("URIs that lead out of the model's folder are refused", "[load]") {
    const test::TemporaryFolder folder;
    const auto secret = folder.write("secret.bin", buffer_bytes());
    folder.write("models.bin", buffer_bytes());
    folder.write("models/own.bin", buffer_bytes());
    const std::string absolute = secret.string();
    for (const std::string& uri :
         {std::string("../secret.bin"), std::string("%2e%2e/secret.bin"), std::string("..%2Fsecret.bin"),
          std::string("sub/../../secret.bin"), std::string("..\\secret.bin"), std::string("../models.bin"),
          absolute, "%2F" + absolute.substr(1), "file://" + absolute, std::string("http://example.com/a.bin"),
          std::string("C:/secret.bin"), std::string("own.bin%00.png"), std::string("own%zz.bin"),
          std::string("")}) {
        INFO("URI '" << uri << "'");
        CHECK_THROWS_WITH(anim::load(model_with_buffer_at(folder, uri)),
                          Contains("model.gltf: /buffers/0/uri: the URI") && Contains("beside the model"));
    }
}

TEST_CASE("symbolic links do not lead out of the model's folder", "[load]") {
    const test::TemporaryFolder folder;
    folder.write("secret.bin", buffer_bytes());
    folder.write("models/own.bin", buffer_bytes());
    std::filesystem::create_symlink("../secret.bin", folder.path() / "models/out.bin");
    std::filesystem::create_symlink("own.bin", folder.path() / "models/in.bin");

    CHECK_THROWS_WITH(anim::load(model_with_buffer_at(folder, "out.bin")),
                      Contains("leads out of the model's folder"));
    // Below a folder that is not there, too.
    CHECK_THROWS_WITH(anim::load(model_with_buffer_at(folder, "missing/../out.bin")),
                      Contains("leads out of the model's folder"));
    CHECK_NOTHROW(anim::load(model_with_buffer_at(folder, "in.bin")));
}

TEST_CASE("URIs may lead into the asset root, and into nothing beside it", "[load]") {
    const test::TemporaryFolder folder;
    folder.write("secret.bin", buffer_bytes());
    folder.write("shared/part.bin", buffer_bytes());
    folder.write("models/own.bin", buffer_bytes());
    std::filesystem::create_symlink("../secret.bin", folder.path() / "shared/out.bin");
    const auto load_with = [&](std::string_view uri, const std::filesystem::path& root) {
        return anim::load(model_with_buffer_at(folder, uri), root);
    };

    const auto shared = folder.path() / "shared";
    CHECK_NOTHROW(load_with("../shared/part.bin", shared));
    CHECK_NOTHROW(load_with("../shared/part.bin", shared / ""));
    CHECK_NOTHROW(load_with("../shared/part.bin", folder.path()));
    CHECK_NOTHROW(load_with("own.bin", shared));
    // Where a URI starts does not change.
    CHECK_THROWS_WITH(load_with("part.bin", shared), Contains("cannot be read"));
    for (const auto* const uri : {"../secret.bin", "../shared/out.bin", "missing/../../shared/out.bin"}) {
        INFO(uri);
        CHECK_THROWS_WITH(load_with(uri, shared),
                          Contains("/buffers/0/uri: the URI leads out of the model's folder "
                                   "and of the asset root") &&
                              Contains("--asset-root"));
    }
    CHECK_THROWS_WITH(load_with("../shared/part.bin", folder.path() / "none"),
                      Contains("the asset root cannot be found"));
}

TEST_CASE("a missing or short buffer file is refused", "[load]") {
    const test::TemporaryFolder folder;
    CHECK_THROWS_WITH(anim::load(model_with_buffer_at(folder, "missing.bin")),
                      Contains("/buffers/0/uri: the file \"missing.bin\" cannot be read"));

    std::filesystem::create_directories(folder.path() / "models/folder.bin");
    CHECK_THROWS_WITH(anim::load(model_with_buffer_at(folder, "folder.bin")), Contains("cannot be read"));

    auto bytes = buffer_bytes();
    bytes.pop_back();
    folder.write("models/short.bin", bytes);
    CHECK_THROWS_WITH(anim::load(model_with_buffer_at(folder, "short.bin")),
                      Contains("/buffers/0: the buffer states"));
}

TEST_CASE("malformed data URIs are refused", "[load]") {
    for (const auto* const uri : {"data:application/octet-stream;base64", "data:;base64,a",
                                  "data:;base64,ab*d", "data:;base64,ab=d", "data:,%4", "data:,%zz"}) {
        DYNAMIC_SECTION(uri) {
            auto file = test::one_triangle();
            file.json["buffers"] = {{{"byteLength", file.buffer.size()}, {"uri", uri}}};
            const auto refusal = test::refusal_of(file);
            CHECK(refusal.pointer == "/buffers/0/uri");
            CHECK_THAT(refusal.message, Contains("the data URI"));
        }
    }
}

TEST_CASE("a data URI may be percent-encoded", "[load]") {
    auto file = test::one_triangle();
    std::string encoded;
    for (const std::byte byte : file.buffer) {
        encoded += '%';
        for (const int nibble : {int(byte) >> 4, int(byte) & 15}) encoded += "0123456789ABCDEF"[nibble];
    }
    file.json["buffers"] = {
        {{"byteLength", file.buffer.size()}, {"uri", "data:application/octet-stream," + encoded}}};
    const auto scene = anim::load_bytes(test::bytes_of(file.json.dump()), "test.gltf");
    CHECK(scene.meshes[0].primitives[0].positions ==
          test::one_triangle().load().meshes[0].primitives[0].positions);
}

TEST_CASE("images come from files, data URIs and buffer views as they are", "[load]") {
    const test::TemporaryFolder folder;
    folder.write("photo 1.png", "file bytes");
    auto file = test::one_triangle();
    const auto view = file.add_view<char>({'v', 'i', 'e', 'w'});
    file.json["images"] = {{{"uri", "photo%201.png"}},
                           {{"uri", "data:image/jpeg;base64,ZGF0YQ=="}, {"name", "embedded"}},
                           {{"bufferView", view}, {"mimeType", "image/png"}}};
    const auto scene = anim::load(folder.write("model.gltf", file.gltf()));

    REQUIRE(scene.images.size() == 3);
    CHECK(scene.images[0].encoded == test::bytes_of("file bytes"));
    CHECK(scene.images[0].name == "photo%201.png");
    CHECK(scene.images[1].encoded == test::bytes_of("data"));
    CHECK(scene.images[1].name == "embedded");
    CHECK(scene.images[1].mime_type == "image/jpeg");
    CHECK(scene.images[2].encoded == test::bytes_of("view"));
    CHECK(scene.images[2].mime_type == "image/png");
    CHECK(scene.warnings.empty());
}

TEST_CASE("an image that cannot be read is left out with a warning", "[load]") {
    const test::TemporaryFolder folder;
    folder.write("secret.png", "secret");
    auto file = test::one_triangle();
    file.json["images"] = {{{"uri", "missing.png"}},
                           {{"uri", "../secret.png"}},
                           {{"uri", "http://a.b/c.png"}},
                           nlohmann::json::object()};
    const auto scene = anim::load(folder.write("models/model.gltf", file.gltf()));

    REQUIRE(scene.images.size() == 4);
    for (const auto& image : scene.images) CHECK(image.encoded.empty());
    CHECK_THAT(test::warning_at(scene, "/images/0"), Contains("missing.png") && Contains("cannot be read"));
    CHECK_THAT(test::warning_at(scene, "/images/1"), Contains("leads out of the model's folder"));
    CHECK_THAT(test::warning_at(scene, "/images/2"), Contains("scheme"));
    CHECK_THAT(test::warning_at(scene, "/images/3"), Contains("no bytes"));
}
