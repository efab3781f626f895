#pragma once
// Rigid marbles that fall into a bowl and come to rest.

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace gridreel::gallery {

/// A part of a spherical shell, open at the top, standing on the floor y = 0.
struct Bowl {
    double radius_m = 1.15;            ///< of the shell's middle
    double half_thickness_m = 0.03;    ///< the rim is rounded with this radius
    double rim_sine = 0.93;            ///< rim circle: radius_m * rim_sine, seen from the sphere's centre
    double rim_cosine = 0.3675595189;  ///< of the same angle, from straight down
    double lift_m = 0.09;              ///< the middle surface's lowest point above the floor

    [[nodiscard]] glm::dvec3 centre() const { return {0.0, lift_m + radius_m, 0.0}; }
};

struct MarbleState {
    glm::dvec3 position;
    glm::dquat rotation;
};

struct MarbleRun {
    std::uint32_t marble_count = 110;
    double radius_m = 0.1;
    double duration_s = 5.0;
    double mouth_height_m = 2.7;      ///< marbles come down a chute and fall freely from here
    double feed_speed_m_per_s = 2.2;  ///< inside the chute
    int keys_per_second = 24;
    std::uint64_t seed = 2;
};

/// Pours the marbles and records them at every key time, 0 and `duration_s` included.
///
/// Impulses at contacts with restitution and Coulomb friction, so marbles roll; half-millisecond steps;
/// rolling friction brings them to rest. Only additions, products and square roots in a fixed order: the
/// same numbers on every machine.
///
/// @return [key][marble]
[[nodiscard]] std::vector<std::vector<MarbleState>> simulate(const MarbleRun& run, const Bowl& bowl);

}  // namespace gridreel::gallery
