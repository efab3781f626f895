#include "test_triangles.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace gridreel::tests {

std::uint32_t Random::next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ull + 1442695040888963407ull;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    const auto turn = static_cast<unsigned>(old >> 59);
    return shifted >> turn | shifted << ((32 - turn) & 31);
}

float Random::uniform(float low, float high) {
    return low + (high - low) * (static_cast<float>(next() >> 8) * 0x1p-24f);
}

glm::vec3 Random::in_box(float low, float high) {
    const float x = uniform(low, high), y = uniform(low, high), z = uniform(low, high);
    return {x, y, z};
}

glm::vec3 Random::on_sphere() {
    for (;;) {
        const glm::vec3 p = in_box(-1.0f, 1.0f);
        const float length = glm::length(p);
        if (length > 0.01f && length <= 1.0f) return p / length;
    }
}

void Triangles::add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), {a, b, c});
    triangles.emplace_back(first, first + 1, first + 2);
}

Triangles soup(std::size_t count, float size) {
    Triangles result{.name = "soup", .positions = {}, .triangles = {}};
    Random random(1);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 at = random.in_box(-1.0f, 1.0f);
        const glm::vec3 a = random.in_box(-size, size), b = random.in_box(-size, size),
                        c = random.in_box(-size, size);
        result.add(at + a, at + b, at + c);
    }
    return result;
}

Triangles sheet(int side) {
    Triangles result{.name = "sheet", .positions = {}, .triangles = {}};
    for (int j = 0; j <= side; ++j) {
        for (int i = 0; i <= side; ++i) {
            const float x = 2.0f * float(i) / float(side) - 1.0f, y = 2.0f * float(j) / float(side) - 1.0f;
            result.positions.emplace_back(x, y, 0.1f * std::sin(6.0f * x) + 0.08f * std::sin(9.0f * y));
        }
    }
    const auto row = static_cast<std::uint32_t>(side + 1);
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
        for (std::uint32_t i = 0; i + 1 < row; ++i) {
            const std::uint32_t a = j * row + i;
            result.triangles.emplace_back(a, a + 1, a + row + 1);
            result.triangles.emplace_back(a, a + row + 1, a + row);
        }
    }
    return result;
}

Triangles sphere(int rings) {
    Triangles result{.name = "sphere", .positions = {}, .triangles = {}};
    const int sectors = 2 * rings;
    // One vertex at each pole, and none twice: the mesh is closed by its indices.
    result.positions.emplace_back(0.0f, 0.0f, 1.0f);
    for (int ring = 1; ring < rings; ++ring) {
        for (int sector = 0; sector < sectors; ++sector) {
            const double polar = std::numbers::pi * ring / rings,
                         around = 2.0 * std::numbers::pi * sector / sectors;
            result.positions.emplace_back(std::sin(polar) * std::cos(around),
                                          std::sin(polar) * std::sin(around), std::cos(polar));
        }
    }
    result.positions.emplace_back(0.0f, 0.0f, -1.0f);
    const auto south = static_cast<std::uint32_t>(result.positions.size() - 1);
    const auto at = [&](int ring, int sector) {
        if (ring == 0) return 0u;
        if (ring == rings) return south;
        return static_cast<std::uint32_t>(1 + (ring - 1) * sectors + sector % sectors);
    };
    for (int ring = 0; ring < rings; ++ring) {
        for (int sector = 0; sector < sectors; ++sector) {
            const std::uint32_t a = at(ring, sector), b = at(ring + 1, sector), c = at(ring + 1, sector + 1),
                                d = at(ring, sector + 1);
            if (ring + 1 < rings) result.triangles.emplace_back(a, b, c);
            if (ring > 0) result.triangles.emplace_back(a, c, d);
        }
    }
    return result;
}

Triangles slivers(std::size_t count) {
    Triangles result{.name = "slivers", .positions = {}, .triangles = {}};
    Random random(2);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 a = random.in_box(-1.0f, 1.0f);
        const glm::vec3 b = a + random.on_sphere() * random.uniform(0.3f, 1.0f);
        result.add(a, b, a + random.on_sphere() * 1e-4f);
    }
    return result;
}

Triangles coplanar(std::size_t count) {
    Triangles result{.name = "coplanar", .positions = {}, .triangles = {}};
    Random random(3);
    for (std::size_t i = 0; i < count; ++i) {
        glm::vec3 corner[3];
        for (glm::vec3& p : corner) p = {random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f), 0.0f};
        result.add(corner[0], corner[1], corner[2]);
        if (i % 4 == 0) result.add(corner[0], corner[1], corner[2]);  // the very same once more
    }
    return result;
}

Triangles boxes(int side) {
    Triangles result{.name = "boxes", .positions = {}, .triangles = {}};
    for (int z = 0; z < side; ++z) {
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                if ((x + y + z) % 2 != 0) continue;
                for (int axis = 0; axis < 3; ++axis) {
                    for (int face = 0; face < 2; ++face) {
                        glm::vec3 low{float(x), float(y), float(z)};
                        low[axis] += float(face);
                        glm::vec3 u{0.0f}, v{0.0f};
                        u[(axis + 1) % 3] = 1.0f;
                        v[(axis + 2) % 3] = 1.0f;
                        result.add(low, low + u, low + u + v);
                        result.add(low, low + u + v, low + v);
                    }
                }
            }
        }
    }
    return result;
}

Triangles degenerate(std::size_t count) {
    Triangles result{.name = "degenerate", .positions = {}, .triangles = {}};
    Random random(4);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 a = random.in_box(-1.0f, 1.0f), b = random.in_box(-1.0f, 1.0f),
                        c = random.in_box(-1.0f, 1.0f);
        switch (i % 8) {
            case 0:
                result.add(a, a, a);
                break;
            case 1:
                result.add(a, a, b);
                break;
            case 2:
                result.add(a, 0.5f * (a + b), b);
                break;
            case 3:
                result.add(a, b, glm::vec3{std::numeric_limits<float>::quiet_NaN()});
                break;
            case 4:
                result.add(a, {infinity, 0.0f, 0.0f}, c);
                break;
            case 5:
                result.add(a, b, {1e30f, 0.0f, 0.0f});
                break;
            default:
                result.add(a, a + 0.2f * b, a + 0.2f * c);
                break;
        }
    }
    return result;
}

Triangles teapot_in_stadium() {
    Triangles result = scaled(sphere(16), 0.5f, {3.0f, 2.0f, 1.0f});
    result.name = "teapot in stadium";
    Triangles bowl = scaled(boxes(1), 400.0f, glm::vec3{-200.0f});
    for (const glm::uvec3& t : bowl.triangles)
        result.add(bowl.positions[t.x], bowl.positions[t.y], bowl.positions[t.z]);
    return result;
}

Triangles crowds_in_crowds() {
    Triangles result = soup(150, 0.05f);
    for (int depth = 0; depth < 3; ++depth) {
        const Triangles inner = soup(500, 0.1f);
        result = scaled(std::move(result), 30.0f, {});
        for (const glm::uvec3& t : inner.triangles)
            result.add(inner.positions[t.x], inner.positions[t.y], inner.positions[t.z]);
    }
    result.name = "crowds in crowds";
    return result;
}

Triangles scaled(Triangles triangles, float factor, const glm::vec3& shift) {
    for (glm::vec3& p : triangles.positions) p = p * factor + shift;
    return triangles;
}

}  // namespace gridreel::tests
