#include "sequences/picture.h"

#include "engine/srgb.h"

#include <OpenImageIO/half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace gridreel::sequences {
namespace {

using engine::Film;

/// Where each stored channel comes from.
struct Source {
    PictureChannel channel;
    std::size_t film_channel = 0;
};

std::vector<Source> exr_sources(const ImageSettings& settings) {
    const PixelType type =
        settings.depth == Depth::half_float ? PixelType::half_float : PixelType::single_float;
    std::vector<Source> sources{
        {{"R", type}, Film::R}, {{"G", type}, Film::G}, {{"B", type}, Film::B}, {{"A", type}, Film::A}};
    if (settings.aov_z) sources.push_back({{"Z", PixelType::single_float}, Film::Z});
    if (settings.aov_n) {
        sources.push_back({{"N.X", type}, Film::NX});
        sources.push_back({{"N.Y", type}, Film::NY});
        sources.push_back({{"N.Z", type}, Film::NZ});
    }
    return sources;
}

half finite_half(float value) {
    constexpr float largest = 65504.0f;
    return half(std::isnan(value) ? value : std::clamp(value, -largest, largest));
}

void store_exr(const Film& film, const ImageSettings& settings, Picture& picture) {
    const std::vector<Source> sources = exr_sources(settings);
    std::size_t pixel_bytes = 0;
    for (const Source& source : sources) {
        picture.channels.push_back(source.channel);
        pixel_bytes += source.channel.type == PixelType::half_float ? sizeof(half) : sizeof(float);
    }

    const std::size_t pixel_count = film.pixels.size() / Film::channel_count;
    picture.pixels.resize(pixel_count * pixel_bytes);
    std::byte* out = picture.pixels.data();
    const float* in = film.pixels.data();
    for (std::size_t pixel = 0; pixel < pixel_count; ++pixel, in += Film::channel_count) {
        for (const Source& source : sources) {
            const float value = in[source.film_channel];
            if (source.channel.type == PixelType::half_float) {
                const half stored = finite_half(value);
                std::memcpy(out, &stored, sizeof stored);
                out += sizeof stored;
            } else {
                std::memcpy(out, &value, sizeof value);
                out += sizeof value;
            }
        }
    }
}

void store_png(const Film& film, Picture& picture) {
    for (const char* name : {"R", "G", "B", "A"}) picture.channels.push_back({name, PixelType::byte});
    const std::size_t pixel_count = film.pixels.size() / Film::channel_count;
    picture.pixels.resize(pixel_count * 4);
    std::byte* out = picture.pixels.data();
    const float* in = film.pixels.data();
    for (std::size_t pixel = 0; pixel < pixel_count; ++pixel, in += Film::channel_count) {
        const float alpha = in[Film::A] > 0.0f ? std::min(in[Film::A], 1.0f) : 0.0f;
        const float straighten = alpha > 0.0f ? 1.0f / alpha : 0.0f;
        for (const auto channel : {Film::R, Film::G, Film::B}) {
            *out++ = std::byte{srgb_byte(in[channel] * straighten)};
        }
        *out++ = std::byte{static_cast<std::uint8_t>(std::lround(alpha * 255.0f))};
    }
}

/// Linear values at which the rounded 8-bit code goes up, and a table to start looking from.
struct SrgbSteps {
    static constexpr std::size_t buckets = 4096;
    std::array<float, 257> at_least{};  ///< code c is right from at_least[c] up to at_least[c + 1]
    std::array<std::uint8_t, buckets + 1> first_code{};

    SrgbSteps() {
        for (std::size_t code = 1; code < 256; ++code) {
            at_least[code] = engine::linear_from_srgb((float(code) - 0.5f) / 255.0f);
        }
        at_least[256] = 2.0f;  // beyond every clamped value
        std::size_t code = 0;
        for (std::size_t bucket = 0; bucket <= buckets; ++bucket) {
            while (at_least[code + 1] <= float(bucket) / float(buckets)) ++code;
            first_code[bucket] = static_cast<std::uint8_t>(code);
        }
    }
};

}  // namespace

std::uint8_t srgb_byte(float linear) {
    static const SrgbSteps steps;
    const float value = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;
    std::size_t code = steps.first_code[static_cast<std::size_t>(value * float(SrgbSteps::buckets))];
    while (steps.at_least[code + 1] <= value) ++code;
    return static_cast<std::uint8_t>(code);
}

void store(const Film& film, const ImageSettings& settings, Picture& picture) {
    picture.width = film.width;
    picture.height = film.height;
    picture.channels.clear();
    if (settings.format == ImageFormat::exr) {
        store_exr(film, settings, picture);
    } else {
        store_png(film, picture);
    }
}

}  // namespace gridreel::sequences
