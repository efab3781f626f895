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

void* allocate(std::size_t size) noexcept {
    if (counting) ++allocations;
    return std::malloc(size == 0 ? 1 : size);
}

void* allocate_or_throw(std::size_t size) {
    void* memory = allocate(size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

}  // namespace

// The whole family, for sanitizers want memory freed by the partner of what allocated it.
void* operator new(std::size_t size) {
    return allocate_or_throw(size);
}

void* operator new[](std::size_t size) {
    return allocate_or_throw(size);
}

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return allocate(size);
}

void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return allocate(size);
}

void operator delete(void* memory) noexcept {
    std::free(memory);
}

void operator delete[](void* memory) noexcept {
    std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}

void operator delete(void* memory, const std::nothrow_t&) noexcept {
    std::free(memory);
}

void operator delete[](void* memory, const std::nothrow_t&) noexcept {
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
