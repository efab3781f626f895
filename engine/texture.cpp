#include "engine/texture.h"

#include "engine/srgb.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace gridreel::engine {
namespace {

// --- Making the sizes --------------------------------------------------------------------------

std::uint16_t quantised(float value) {
    return static_cast<std::uint16_t>(std::lround(value * 65535.0f));
}

std::uint16_t linearised(std::uint16_t encoded) {
    static const std::vector<std::uint16_t> table = [] {
        std::vector<std::uint16_t> entries(65536);
        for (std::size_t i = 0; i < entries.size(); ++i) {
            entries[i] = quantised(linear_from_srgb(static_cast<float>(i) / 65535.0f));
        }
        return entries;
    }();
    return table[encoded];
}

/// The texels that one texel of the next size covers along an axis, and how much of each.
struct Cover {
    std::int32_t first = 0, count = 0;
    std::array<float, 3> share{};  ///< sums to 1; an odd side halves to texels of up to 3
};

Cover cover(std::int32_t texel, std::int32_t fine_side, std::int32_t coarse_side) {
    // In units of 1 / coarse_side of a fine texel everything is whole.
    const std::int32_t begin = texel * fine_side;
    const std::int32_t end = begin + fine_side;
    Cover c{.first = begin / coarse_side};
    for (std::int32_t fine = c.first; fine * coarse_side < end; ++fine) {
        const std::int32_t overlap =
            std::min(end, (fine + 1) * coarse_side) - std::max(begin, fine * coarse_side);
        c.share[static_cast<std::size_t>(c.count++)] =
            static_cast<float>(overlap) / static_cast<float>(fine_side);
    }
    return c;
}

glm::vec4 fetch(const Pyramid::Level& level, std::int32_t x, std::int32_t y) {
    const auto i =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width) + static_cast<std::size_t>(x);
    return glm::vec4(level.texels[i]) * (1.0f / 65535.0f);
}

Pyramid::Level halved(const Pyramid::Level& fine) {
    Pyramid::Level coarse{.width = std::max(1, fine.width / 2), .height = std::max(1, fine.height / 2)};
    coarse.texels.reserve(static_cast<std::size_t>(coarse.width) * static_cast<std::size_t>(coarse.height));
    for (std::int32_t y = 0; y < coarse.height; ++y) {
        const Cover rows = cover(y, fine.height, coarse.height);
        for (std::int32_t x = 0; x < coarse.width; ++x) {
            const Cover columns = cover(x, fine.width, coarse.width);
            glm::vec4 sum{0.0f};
            for (std::int32_t j = 0; j < rows.count; ++j) {
                for (std::int32_t i = 0; i < columns.count; ++i) {
                    sum += rows.share[static_cast<std::size_t>(j)] *
                           columns.share[static_cast<std::size_t>(i)] *
                           fetch(fine, columns.first + i, rows.first + j);
                }
            }
            sum = glm::clamp(sum, 0.0f, 1.0f);
            coarse.texels.emplace_back(quantised(sum.x), quantised(sum.y), quantised(sum.z),
                                       quantised(sum.w));
        }
    }
    return coarse;
}

// --- Looking up --------------------------------------------------------------------------------

/// The coordinate with whole repeats taken off, so that it can be counted in texels.
float reduced(float coordinate, anim::Wrap wrap) {
    if (!std::isfinite(coordinate)) return 0.0f;
    switch (wrap) {
        case anim::Wrap::repeat:
            return coordinate - std::floor(coordinate);
        case anim::Wrap::mirrored_repeat:
            return coordinate - 2.0f * std::floor(0.5f * coordinate);
        case anim::Wrap::clamp_to_edge:
            return glm::clamp(coordinate, 0.0f, 1.0f);
    }
    return 0.0f;
}

/// The texel that stands at `index`, in [-1, 2 * side], along an axis of `side` texels.
std::int32_t wrapped(std::int32_t index, std::int32_t side, anim::Wrap wrap) {
    switch (wrap) {
        case anim::Wrap::repeat:
            return index < 0 ? index + side : index % side;
        case anim::Wrap::mirrored_repeat: {
            const std::int32_t phase = (index + 2 * side) % (2 * side);
            return phase < side ? phase : 2 * side - 1 - phase;
        }
        case anim::Wrap::clamp_to_edge:
            return std::clamp(index, 0, side - 1);
    }
    return 0;
}

glm::vec4 nearest(const Pyramid::Level& level, const anim::Texture& sampler, const glm::vec2& uv) {
    const auto x = static_cast<std::int32_t>(std::floor(uv.x * static_cast<float>(level.width)));
    const auto y = static_cast<std::int32_t>(std::floor(uv.y * static_cast<float>(level.height)));
    return fetch(level, wrapped(x, level.width, sampler.wrap_s), wrapped(y, level.height, sampler.wrap_t));
}

glm::vec4 bilinear(const Pyramid::Level& level, const anim::Texture& sampler, const glm::vec2& uv) {
    const float x = uv.x * static_cast<float>(level.width) - 0.5f;
    const float y = uv.y * static_cast<float>(level.height) - 0.5f;
    const float left = std::floor(x);
    const float top = std::floor(y);
    const auto i = static_cast<std::int32_t>(left);
    const auto j = static_cast<std::int32_t>(top);
    const std::array columns{wrapped(i, level.width, sampler.wrap_s),
                             wrapped(i + 1, level.width, sampler.wrap_s)};
    const std::array rows{wrapped(j, level.height, sampler.wrap_t),
                          wrapped(j + 1, level.height, sampler.wrap_t)};
    const glm::vec4 upper =
        glm::mix(fetch(level, columns[0], rows[0]), fetch(level, columns[1], rows[0]), x - left);
    const glm::vec4 lower =
        glm::mix(fetch(level, columns[0], rows[1]), fetch(level, columns[1], rows[1]), x - left);
    return glm::mix(upper, lower, y - top);
}

glm::vec4 filtered(const Pyramid::Level& level, const anim::Texture& sampler, const glm::vec2& uv,
                   anim::Filter filter) {
    return filter == anim::Filter::nearest ? nearest(level, sampler, uv) : bilinear(level, sampler, uv);
}

}  // namespace

Pyramid::Pyramid(DecodedImage image, Encoding encoding) {
    assert(image.width >= 1 && image.height >= 1);
    if (encoding == Encoding::srgb) {
        for (glm::u16vec4& texel : image.texels) {
            texel = {linearised(texel.x), linearised(texel.y), linearised(texel.z), texel.w};
        }
    }
    levels.push_back({.width = image.width, .height = image.height, .texels = std::move(image.texels)});
    while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(halved(levels.back()));
}

glm::vec4 sample(const Pyramid& image, const anim::Texture& sampler, const glm::vec2& uv, float footprint) {
    const glm::vec2 place{reduced(uv.x, sampler.wrap_s), reduced(uv.y, sampler.wrap_t)};

    // Level of detail: 0 where the footprint is a texel of the finest size.
    const Pyramid::Level& finest = image.levels.front();
    const float texels =
        footprint * std::sqrt(static_cast<float>(finest.width) * static_cast<float>(finest.height));
    if (!(texels > 1.0f)) return filtered(finest, sampler, place, sampler.mag_filter);
    if (sampler.mip_filter == anim::MipFilter::none)
        return filtered(finest, sampler, place, sampler.min_filter);

    const auto last = static_cast<float>(image.levels.size() - 1);
    const float detail = std::min(std::log2(texels), last);
    if (sampler.mip_filter == anim::MipFilter::nearest) {
        const auto level = static_cast<std::size_t>(std::lround(detail));
        return filtered(image.levels[level], sampler, place, sampler.min_filter);
    }
    const auto finer = static_cast<std::size_t>(detail);
    const std::size_t coarser = std::min(finer + 1, image.levels.size() - 1);
    return glm::mix(filtered(image.levels[finer], sampler, place, sampler.min_filter),
                    filtered(image.levels[coarser], sampler, place, sampler.min_filter),
                    detail - static_cast<float>(finer));
}

}  // namespace gridreel::engine
