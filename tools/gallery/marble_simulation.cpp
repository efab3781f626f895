#include "tools/gallery/marble_simulation.h"

#include "tools/gallery/random.h"
#include "tools/gallery/turns.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace gridreel::gallery {

namespace {

constexpr double gravity = 9.81;
constexpr int steps_per_key = 80;
constexpr double restitution = 0.45;
constexpr double friction = 0.35;
constexpr double resting_speed = 0.15;    ///< m/s; slower contacts do not bounce
constexpr double rolling_friction = 0.9;  ///< rad/s² per (m/s²): spin lost while touching

struct Marble {
    glm::dvec3 position;
    glm::dvec3 velocity{0.0};
    glm::dvec3 spin{0.0};  ///< rad/s
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    bool touches = false;
};

/// How far a point is from a still surface, and which way is off it.
struct Nearest {
    double distance;
    glm::dvec3 away;
};

/// The bowl's shell: the middle surface, or the rim where the point is above it.
Nearest nearest_of_bowl(const Bowl& bowl, const glm::dvec3& p) {
    const glm::dvec3 out = p - bowl.centre();
    const double across = std::sqrt(out.x * out.x + out.z * out.z);
    const double length = glm::length(out);

    // Below the cone through the rim?
    if (across * bowl.rim_cosine <= -out.y * bowl.rim_sine) {
        const double side = length < bowl.radius_m ? -1.0 : 1.0;
        return {side * (length - bowl.radius_m) - bowl.half_thickness_m, side * out / length};
    }
    const double rim_x = bowl.radius_m * bowl.rim_sine, rim_y = -bowl.radius_m * bowl.rim_cosine;
    const glm::dvec3 radial =
        across > 0.0 ? glm::dvec3(out.x, 0.0, out.z) / across : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 from_rim = (across - rim_x) * radial + glm::dvec3(0.0, out.y - rim_y, 0.0);
    const double distance = glm::length(from_rim);
    return {distance - bowl.half_thickness_m, from_rim / distance};
}

/// Velocity change of one contact per unit of inverse mass: `approach` is the surfaces' relative velocity,
/// `share` 1 against a still surface and 2 between two equal marbles.
///
/// A solid ball resists a tangential impulse with 2/7 of its mass: 1/m + r²/(2/5 m r²) = 3.5/m.
glm::dvec3 impulse(const glm::dvec3& approach, const glm::dvec3& normal, double share) {
    const double closing = -glm::dot(approach, normal);
    if (closing <= 0.0) return glm::dvec3(0.0);
    const double push = closing * (closing > resting_speed ? 1.0 + restitution : 1.0) / share;

    const glm::dvec3 sliding = approach + closing * normal;
    const double speed = glm::length(sliding);
    if (speed < 1e-9) return push * normal;
    const double drag = std::min(friction * push, speed / (3.5 * share));
    return push * normal - (drag / speed) * sliding;
}

/// Each component uniform in [-reach, reach). Braces: evaluated from left to right by every compiler.
glm::dvec3 random_vector(Random& random, double reach) {
    return glm::dvec3{random.between(-reach, reach), random.between(-reach, reach),
                      random.between(-reach, reach)};
}

class Simulation {
public:
    Simulation(const MarbleRun& run, const Bowl& bowl)
        : bowl_(bowl),
          radius_(run.radius_m),
          mouth_height_(run.mouth_height_m),
          step_s_(1.0 / (run.keys_per_second * steps_per_key)) {
        // A loose spiral in the chute, a marble every few centimetres, so that neighbours do not touch.
        Random random(run.seed);
        double height = run.mouth_height_m - 1.0;
        for (std::uint32_t i = 0; i < run.marble_count; ++i) {
            const double reach = random.between(0.20, 0.34);
            const double turn = 0.381966 * i + random.between(0.0, 0.04);
            const glm::dvec3 spin = random_vector(random, 4.0), axis = random_vector(random, 1.0);
            marbles_.push_back({.position = {reach * cos_turns(turn), height, reach * sin_turns(turn)},
                                .velocity = {0.0, -run.feed_speed_m_per_s, 0.0},
                                .spin = spin,
                                .rotation = glm::normalize(glm::dquat(1.0, axis))});
            height += random.between(0.055, 0.07);
        }
    }

    void advance() {
        for (Marble& marble : marbles_) {
            if (marble.position.y < mouth_height_) marble.velocity.y -= gravity * step_s_;
            marble.touches = false;
        }
        for (std::size_t i = 0; i < marbles_.size(); ++i)
            for (std::size_t j = i + 1; j < marbles_.size(); ++j) collide(marbles_[i], marbles_[j]);
        for (Marble& marble : marbles_) {
            collide(marble, nearest_of_bowl(bowl_, marble.position));
            collide(marble, Nearest{marble.position.y, {0.0, 1.0, 0.0}});
        }
        for (Marble& marble : marbles_) move(marble);
    }

    [[nodiscard]] std::vector<MarbleState> states() const {
        std::vector<MarbleState> states;
        for (const Marble& marble : marbles_) states.push_back({marble.position, marble.rotation});
        return states;
    }

private:
    void collide(Marble& a, Marble& b) const {
        const glm::dvec3 between = a.position - b.position;
        const double square = glm::dot(between, between);
        if (square >= 4.0 * radius_ * radius_ || square == 0.0) return;
        const double distance = std::sqrt(square);
        const glm::dvec3 normal = between / distance;
        a.touches = b.touches = true;

        const glm::dvec3 approach = a.velocity - b.velocity - radius_ * glm::cross(a.spin + b.spin, normal);
        const glm::dvec3 kick = impulse(approach, normal, 2.0);
        a.velocity += kick;
        b.velocity -= kick;
        const glm::dvec3 twist = (2.5 / radius_) * glm::cross(-normal, kick);
        a.spin += twist;
        b.spin += twist;

        // Half of the overlap a step, shared.
        const glm::dvec3 apart = (0.25 * (2.0 * radius_ - distance)) * normal;
        a.position += apart;
        b.position -= apart;
    }

    void collide(Marble& marble, const Nearest& wall) const {
        if (wall.distance >= radius_) return;
        marble.touches = true;
        const glm::dvec3 approach = marble.velocity - radius_ * glm::cross(marble.spin, wall.away);
        const glm::dvec3 kick = impulse(approach, wall.away, 1.0);
        marble.velocity += kick;
        marble.spin += (2.5 / radius_) * glm::cross(-wall.away, kick);
        marble.position += (0.5 * (radius_ - wall.distance)) * wall.away;
    }

    void move(Marble& marble) const {
        if (marble.touches) {
            // Rolling friction, and a little drag that lets the heap settle.
            const double speed = glm::length(marble.spin);
            const double lost = rolling_friction * gravity * step_s_;
            marble.spin *= speed > lost ? 1.0 - lost / speed : 0.0;
            marble.velocity *= 1.0 - 0.8 * step_s_;
        }
        marble.position += step_s_ * marble.velocity;
        const glm::dquat spin(0.0, marble.spin.x, marble.spin.y, marble.spin.z);
        marble.rotation = glm::normalize(marble.rotation + (0.5 * step_s_) * (spin * marble.rotation));
    }

    Bowl bowl_;
    double radius_, mouth_height_, step_s_;
    std::vector<Marble> marbles_;
};

}  // namespace

std::vector<std::vector<MarbleState>> simulate(const MarbleRun& run, const Bowl& bowl) {
    Simulation simulation(run, bowl);
    std::vector<std::vector<MarbleState>> keys{simulation.states()};
    const int key_count = static_cast<int>(run.duration_s * run.keys_per_second);
    for (int key = 0; key < key_count; ++key) {
        for (int step = 0; step < steps_per_key; ++step) simulation.advance();
        keys.push_back(simulation.states());
    }
    return keys;
}

}  // namespace gridreel::gallery
