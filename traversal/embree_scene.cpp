#include "traversal/embree_scene.h"

#include "traversal/embree_api-inl.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <sys/types.h>

namespace gridreel::traversal {
namespace {

/// Embree loads every vertex by 16 bytes: of the last one, 4 bytes beyond its end, which it ignores. They can
/// be read without harm unless a page ends there.
bool can_be_read_on(std::span<const glm::vec3> positions) {
    constexpr std::uintptr_t smallest_page = 4096;
    return reinterpret_cast<std::uintptr_t>(positions.data() + positions.size()) % smallest_page != 0;
}

template <class T>
bool same_memory(std::span<const T> a, std::span<const T> b) {
    return a.data() == b.data() && a.size() == b.size();
}

bool same_values(std::span<const glm::uvec3> a, std::span<const glm::uvec3> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

RTCBuildQuality mesh_quality(EmbreeQuality quality) {
    switch (quality) {
        case EmbreeQuality::low:
            return RTC_BUILD_QUALITY_LOW;
        case EmbreeQuality::medium:
            return RTC_BUILD_QUALITY_MEDIUM;
        case EmbreeQuality::refit:
            return RTC_BUILD_QUALITY_REFIT;
    }
    return RTC_BUILD_QUALITY_LOW;
}

bool count_memory(void* bytes, ssize_t change, bool) {
    static_cast<std::atomic<std::int64_t>*>(bytes)->fetch_add(change, std::memory_order_relaxed);
    return true;
}

}  // namespace

EmbreeScene::EmbreeScene(EmbreeQuality quality) : quality_(quality) {
    device_ = rtcNewDevice(nullptr);
    if (device_ == nullptr) throw std::runtime_error("Embree does not start on this machine");
    rtcSetDeviceMemoryMonitorFunction(device_, count_memory, &bytes_);

    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    // Trees of single meshes, and with them refitting, exist only in scenes of low quality.
    rtcSetSceneBuildQuality(
        scene_, quality == EmbreeQuality::medium ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_LOW);
    mesh_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(mesh_, mesh_quality(quality));
    rtcAttachGeometry(scene_, mesh_);
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseGeometry(mesh_);
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

rebuild::BuildReport EmbreeScene::build(const rebuild::TriangleView& triangles) {
    empty_ = triangles.triangles.empty();
    if (empty_) return {};

    // Copies are not charged: they make up for how the triangles happen to lie.
    rebuild::TriangleView view = triangles;
    if (!can_be_read_on(view.positions)) {
        safe_positions_.reserve(view.positions.size() + 1);
        safe_positions_.assign(view.positions.begin(), view.positions.end());
        view.positions = safe_positions_;
    }
    const bool new_topology =
        quality_ == EmbreeQuality::refit && !same_values(refitted_topology_, view.triangles);
    if (new_topology) refitted_topology_.assign(view.triangles.begin(), view.triangles.end());

    const auto start = std::chrono::steady_clock::now();
    share(view);
    rtcUpdateGeometryBuffer(mesh_, RTC_BUFFER_TYPE_VERTEX, 0);
    if (new_topology) rtcUpdateGeometryBuffer(mesh_, RTC_BUFFER_TYPE_INDEX, 0);
    commit();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    return {.total_ms = elapsed.count(),
            .bytes = static_cast<std::size_t>(std::max<std::int64_t>(0, bytes_))};
}

void EmbreeScene::allow_filters() {
    if (filters_) return;
    filters_ = true;
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC | embree::filter_in_query);
    if (!empty_) commit();
}

/// Setting a buffer looks like a new topology to Embree, so it is done only when it must be.
void EmbreeScene::share(const rebuild::TriangleView& triangles) {
    if (!same_memory(shared_.positions, triangles.positions)) {
        rtcSetSharedGeometryBuffer(mesh_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   triangles.positions.data(), 0, sizeof(glm::vec3),
                                   triangles.positions.size());
    }
    if (!same_memory(shared_.triangles, triangles.triangles)) {
        rtcSetSharedGeometryBuffer(mesh_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   triangles.triangles.data(), 0, sizeof(glm::uvec3),
                                   triangles.triangles.size());
    }
    shared_ = triangles;
}

void EmbreeScene::commit() {
    rtcCommitGeometry(mesh_);
    rtcCommitScene(scene_);
    check();
}

void EmbreeScene::check() const {
    const RTCError error = rtcGetDeviceError(device_);
    if (error == RTC_ERROR_NONE) return;
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error("Embree reports error " + std::to_string(int(error)));
}

}  // namespace gridreel::traversal
