#pragma once
// For tests that need Embree, which a build may be without.

#include "traversal/tracer.h"

#include <catch2/catch.hpp>

/// Leaves the test by name where there is nothing to test.
#define SKIP_WITHOUT_EMBREE()                                                             \
    do {                                                                                  \
        if (!gridreel::traversal::is_built_in(gridreel::traversal::TracerKind::embree)) { \
            WARN("skipped: this build is without Embree");                                \
            return;                                                                       \
        }                                                                                 \
    } while (false)
