#include "sequences/image_writer.h"
#include "sequences/errors.h"
#include "tests/sequences/scratch_folder.h"

#include <OpenImageIO/imageio.h>
#include <catch2/catch.hpp>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <thread>
#include <vector>

using namespace gridreel;
using namespace gridreel::sequences;
using test::ScratchFolder;

namespace {

/// A film whose every value says where it stands.
engine::Film numbered_film(std::int32_t width, std::int32_t height) {
    engine::Film film;
    film.resize(width, height);
    for (std::int32_t y = 0; y < height; ++y) {
        for (std::int32_t x = 0; x < width; ++x) {
            for (std::size_t c = 0; c < engine::Film::channel_count; ++c) {
                film.pixel(x, y)[c] = float(x) / 16.0f + float(y) / 256.0f + float(c);
            }
            film.pixel(x, y)[engine::Film::A] = 1.0f;
        }
    }
    return film;
}

void write(const engine::Film& film, const ImageSettings& settings, const std::filesystem::path& file) {
    Picture picture;
    store(film, settings, picture);
    write_image(picture, settings, file);
}

struct ReadBack {
    OIIO::ImageSpec spec;
    std::vector<float> values;

    float at(int x, int y, int channel) const {
        return values[std::size_t((y * spec.width + x) * spec.nchannels + channel)];
    }
};

ReadBack read(const std::filesystem::path& file) {
    const auto in = OIIO::ImageInput::open(file.string());
    REQUIRE(in);
    ReadBack back{.spec = in->spec(), .values = {}};
    back.values.resize(std::size_t(back.spec.width) * std::size_t(back.spec.height) *
                       std::size_t(back.spec.nchannels));
    REQUIRE(in->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, back.values.data()));
    return back;
}

/// Files of this process can grow to `bytes` and no further, as on a full disk.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

private:
    void (*handler_)(int);
    rlimit before_{};
};

}  // namespace

TEST_CASE("an EXR reads back as it was rendered", "[image_writer]") {
    const ScratchFolder folder;
    const auto film = numbered_film(5, 3);
    write(film, {.aov_z = true, .aov_n = true}, folder / "a.exr");

    const ReadBack back = read(folder / "a.exr");
    CHECK(back.spec.width == 5);
    CHECK(back.spec.height == 3);
    CHECK(back.spec.channelnames == std::vector<std::string>{"R", "G", "B", "A", "Z", "N.X", "N.Y", "N.Z"});
    CHECK(back.spec.channelformat(0) == OIIO::TypeDesc::HALF);
    CHECK(back.spec.channelformat(4) == OIIO::TypeDesc::FLOAT);
    CHECK(back.spec.get_string_attribute("compression") == "zip");
    // All values are sums of few powers of two: exact in half precision.
    CHECK(back.at(4, 2, 1) == 4 / 16.0f + 2 / 256.0f + 1);
    CHECK(back.at(4, 2, 3) == 1.0f);
    CHECK(back.at(3, 1, 4) == 3 / 16.0f + 1 / 256.0f + 4);
    CHECK(back.at(3, 1, 7) == 3 / 16.0f + 1 / 256.0f + 7);
}

TEST_CASE("every compression keeps every value", "[image_writer]") {
    const ScratchFolder folder;
    const auto film = numbered_film(33, 17);
    write(film, {.depth = Depth::single_float, .compression = "none"}, folder / "none.exr");
    const ReadBack plain = read(folder / "none.exr");
    for (const std::string& name : compressions()) {
        INFO(name);
        write(film, {.depth = Depth::single_float, .compression = name}, folder / "packed.exr");
        const ReadBack packed = read(folder / "packed.exr");
        CHECK(packed.spec.get_string_attribute("compression") == name);
        CHECK(packed.values == plain.values);
    }
}

TEST_CASE("a PNG reads back as 8-bit sRGB with straight alpha", "[image_writer]") {
    const ScratchFolder folder;
    engine::Film film;
    film.resize(2, 1);
    film.pixels = {0.25f, 0.0f, 0.5f, 0.5f, 0, 0, 0, 0, 1.0f, 1.0f, 1.0f, 1.0f, 0, 0, 0, 0};
    write(film, {.format = ImageFormat::png}, folder / "a.png");

    OIIO::ImageSpec as_stored;
    as_stored.attribute("oiio:UnassociatedAlpha", 1);
    const auto in = OIIO::ImageInput::open((folder / "a.png").string(), &as_stored);
    REQUIRE(in);
    CHECK(in->spec().format == OIIO::TypeDesc::UINT8);
    CHECK(in->spec().nchannels == 4);
    CHECK(in->spec().get_string_attribute("oiio:ColorSpace") == "sRGB");
    std::vector<std::uint8_t> values(8);
    REQUIRE(in->read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, values.data()));
    // Straightened 0.5 is 187.5 of sRGB's 255, so 188.
    CHECK(values == std::vector<std::uint8_t>{188, 0, 255, 128, 255, 255, 255, 255});
}

TEST_CASE("equal pictures are equal files, whenever they are written", "[image_writer]") {
    const ScratchFolder folder;
    const auto film = numbered_film(40, 30);
    for (const std::string extension : {".exr", ".png"}) {
        const ImageSettings settings{.format = image_format(extension)};
        write(film, settings, folder / ("a" + extension));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    for (const std::string extension : {".exr", ".png"}) {
        const ImageSettings settings{.format = image_format(extension)};
        write(film, settings, folder / ("another name" + extension));
        const std::string bytes = test::bytes_of(folder / ("a" + extension));
        CHECK(bytes.size() > 100);
        CHECK(test::bytes_of(folder / ("another name" + extension)) == bytes);
        CHECK(bytes.find(folder.path().filename().string()) == std::string::npos);
    }
}

TEST_CASE("a written file replaces what was there and leaves nothing else", "[image_writer]") {
    const ScratchFolder folder;
    test::write_file(folder / "a.exr", "old");
    write(numbered_film(4, 4), {}, folder / "a.exr");
    CHECK(read(folder / "a.exr").spec.width == 4);
    CHECK(folder.names() == std::vector<std::string>{"a.exr"});
}

TEST_CASE("a file that cannot be written is an OutputError and leaves nothing behind", "[image_writer]") {
    const ScratchFolder folder;
    const auto film = numbered_film(8, 8);

    SECTION("no such folder") {
        for (const std::string name : {"missing/a.exr", "missing/a.png"}) {
            const ImageSettings settings{.format = image_format(name.substr(9))};
            CHECK_THROWS_AS(write(film, settings, folder / name), OutputError);
            CHECK_THROWS_WITH(write(film, settings, folder / name), Catch::Contains(name));
        }
        CHECK(folder.names().empty());
    }
    SECTION("a folder stands in its place") {
        std::filesystem::create_directory(folder / "a.exr");
        CHECK_THROWS_AS(write(film, {}, folder / "a.exr"), OutputError);
        CHECK(folder.names() == std::vector<std::string>{"a.exr"});
    }
    SECTION("the disk is full") {
        const auto large = numbered_film(300, 200);
        for (const std::string name : {"a.exr", "a.png"}) {
            INFO(name);
            const ImageSettings settings{.format = image_format(name.substr(1)), .compression = "zip"};
            test::write_file(folder / name, "old");
            {
                const FileSizeLimit full(512);
                CHECK_THROWS_AS(write(large, settings, folder / name), OutputError);
            }
            CHECK(test::bytes_of(folder / name) == "old");
        }
        CHECK(folder.names() == std::vector<std::string>{"a.exr", "a.png"});
    }
}
