#pragma once
// Triangles in Embree's hierarchy.

#include "rebuild/build_report.h"
#include "rebuild/triangle_view.h"
#include "traversal/tracer.h"

#include <glm/vec3.hpp>

#include <atomic>
#include <cstdint>
#include <vector>

struct RTCDeviceTy;
struct RTCSceneTy;
struct RTCGeometryTy;

namespace gridreel::traversal {

/// One Embree scene holding one mesh, whose buffers it shares with whoever owns the triangles.
class EmbreeScene {
public:
    /// @throws std::runtime_error when Embree refuses to work on this machine
    explicit EmbreeScene(EmbreeQuality quality);
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;
    ~EmbreeScene();

    /// Builds the hierarchy by the quality's rule, in the calling thread's arena.
    ///
    /// @param triangles  stay alive and unchanged until the next build
    /// @return `total_ms` covers handing over the buffers and building, `bytes` all that Embree holds
    /// @throws std::bad_alloc, std::runtime_error
    rebuild::BuildReport build(const rebuild::TriangleView& triangles);

    /// From now on queries may bring a filter, which makes all of them a little slower.
    void allow_filters();

    [[nodiscard]] bool empty() const { return empty_; }
    [[nodiscard]] RTCSceneTy* handle() const { return scene_; }

private:
    void share(const rebuild::TriangleView& triangles);
    void commit();
    void check() const;

    EmbreeQuality quality_;
    RTCDeviceTy* device_ = nullptr;
    RTCSceneTy* scene_ = nullptr;
    RTCGeometryTy* mesh_ = nullptr;
    bool empty_ = true;
    bool filters_ = false;
    rebuild::TriangleView shared_;               ///< what the buffers were set to
    std::vector<glm::vec3> safe_positions_;      ///< a copy, where the original cannot be shared
    std::vector<glm::uvec3> refitted_topology_;  ///< what the tree was built for, when it is refitted
    std::atomic<std::int64_t> bytes_{0};
};

}  // namespace gridreel::traversal
