#pragma once
// One way to break a good file, and where the reader must point.

#include "gltf_builder.h"

#include <catch2/catch.hpp>

#include <string>

namespace gridreel::test {

struct Defect {
    std::string name;
    std::string pointer;
    std::string message;  ///< part of it
    void (*inflict)(GltfBuilder&);
};

/// Each defect, inflicted on one good triangle, is refused with its place and its message; a section each.
template <class Defects>
void check_refusals(const Defects& defects) {
    for (const Defect& defect : defects) {
        DYNAMIC_SECTION(defect.name) {
            auto file = one_triangle();
            defect.inflict(file);
            const auto refusal = refusal_of(file);
            CHECK(refusal.pointer == defect.pointer);
            CHECK_THAT(refusal.message, Catch::Matchers::Contains(defect.message));
        }
    }
}

}  // namespace gridreel::test
