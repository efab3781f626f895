#include "sequences/image_settings.h"
#include "sequences/errors.h"

#include <catch2/catch.hpp>

using namespace gridreel::sequences;

TEST_CASE("the extension picks the format", "[image_settings]") {
    CHECK(image_format(".exr") == ImageFormat::exr);
    CHECK(image_format(".png") == ImageFormat::png);
    CHECK_THROWS_WITH(image_format(".jpg"), Catch::Contains(".exr") && Catch::Contains(".png"));
    CHECK_THROWS_AS(image_format(""), UsageError);
}

TEST_CASE("channel groups are chosen by name", "[image_settings]") {
    ImageSettings settings;
    choose_aovs("n", settings);
    CHECK(settings.aov_n);
    CHECK_FALSE(settings.aov_z);
    choose_aovs("z", settings);
    CHECK(settings.aov_z);

    ImageSettings all;
    choose_aovs("all", all);
    CHECK((all.aov_n && all.aov_z));
    CHECK_THROWS_AS(choose_aovs("z,depth", all), UsageError);
    CHECK_THROWS_AS(choose_aovs("", all), UsageError);
}

TEST_CASE("PNG refuses what it cannot hold", "[image_settings]") {
    CHECK_NOTHROW(check(ImageSettings{}));
    CHECK_NOTHROW(check(ImageSettings{.format = ImageFormat::png}));
    CHECK_THROWS_AS(check(ImageSettings{.format = ImageFormat::png, .aov_z = true}), UsageError);
    CHECK_THROWS_AS(check(ImageSettings{.format = ImageFormat::png, .depth = Depth::single_float}),
                    UsageError);
    CHECK_THROWS_AS(check(ImageSettings{.format = ImageFormat::png, .compression = "piz"}), UsageError);
}

TEST_CASE("only lossless compressions are offered", "[image_settings]") {
    for (const auto& name : compressions()) CHECK_NOTHROW(check(ImageSettings{.compression = name}));
    CHECK_THROWS_AS(check(ImageSettings{.compression = "dwaa"}), UsageError);
}
