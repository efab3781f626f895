// A frame's buffers are reused: once warm, `deform` asks for no memory.

#include "anim/frame_geometry.h"

#include "random_scene.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<bool> counting = false;
std::atomic<int> allocations = 0;

void* allocate(std::size_t size) {
    if (counting) ++allocations;
    void* memory = std::malloc(size == 0 ? 1 : size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

}  // namespace

void* operator new(std::size_t size) {
    return allocate(size);
}

void* operator new[](std::size_t size) {
    return allocate(size);
}

void operator delete(void* memory) noexcept {
    std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

void operator delete[](void* memory) noexcept {
    std::free(memory);
}

void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace gridreel::anim {
namespace {

TEST_CASE("deform allocates nothing once warm", "[anim]") {
    const Scene scene = testing::random_scene(3, {.vertices_per_part = 5'000});
    const Clip clip = choose_clip(scene, "all");
    FrameGeometry frame = lay_out(scene, clip);
    REQUIRE(frame.moving_triangles() > 0);
    deform(scene, pose(scene, clip, 0.5), frame);

    const Pose later = pose(scene, clip, 1.0);
    allocations = 0;
    counting = true;
    deform(scene, later, frame);
    counting = false;
    CHECK(allocations == 0);

    // The counter does count.
    counting = true;
    const Pose again = pose(scene, clip, 1.0);
    counting = false;
    CHECK(allocations > 0);
    CHECK(again.world == later.world);
}

}  // namespace
}  // namespace gridreel::anim
