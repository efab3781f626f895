#pragma once
// Numbers laid down in a glTF file in every way that it allows.

#include "tests/anim/gltf_builder.h"

#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace gridreel::test {

/// Chance for tests: the same on every machine for the same seed.
class Chance {
public:
    explicit Chance(std::uint32_t seed) : engine_(seed) {}

    [[nodiscard]] double real(double low, double high) {
        return low + (high - low) * double(engine_()) / 4294967296.0;
    }
    /// From `low` to `high`, both included.
    [[nodiscard]] int whole(int low, int high) { return low + int(engine_() % unsigned(high - low + 1)); }
    [[nodiscard]] bool one_in(int n) { return whole(1, n) == 1; }

    template <class Items>
    [[nodiscard]] const auto& any_of(const Items& items) {
        return items[std::size_t(whole(0, int(items.size()) - 1))];
    }

private:
    std::mt19937 engine_;
};

struct Encoding {
    Component component = float32;
    bool normalized = false;
};

/// Who reads the numbers: vertex attributes may lie apart and must start at multiples of four bytes.
enum class Reader { vertices, others };

/// Appends an accessor of these values, rounded to what `encoding` can hold: anywhere in its buffer view,
/// with strange bytes around it, and at times sparse, over other values or over zeros.
/// @return its index
std::size_t add_values(GltfBuilder& file, Chance& chance, const std::vector<double>& values,
                       const std::string& type, Encoding encoding, Reader reader);

}  // namespace gridreel::test
