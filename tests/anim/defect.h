#pragma once
// One way to break a good file, and where the reader must point.

#include "gltf_builder.h"

#include <string>

namespace gridreel::test {

struct Defect {
    std::string name;
    std::string pointer;
    std::string message;  ///< part of it
    void (*inflict)(GltfBuilder&);
};

}  // namespace gridreel::test
