#pragma once
// Memory that is kept from frame to frame: grows, never shrinks, never initialises.

#include "rebuild/huge_pages.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

namespace gridreel::rebuild {

/// An array of plain values for scratch and results that are rebuilt every frame.
/// `resize` allocates only beyond the largest size so far and leaves the contents unspecified.
/// Unless it never held a value, `padding` more have room behind the last, so that kernels may read and write
/// whole SIMD registers.
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    static constexpr std::size_t padding = 16;  ///< values that may be read and written behind the last

    void resize(std::size_t size) {
        if (size > capacity_) {
            // Let go before asking for more; and if there is no more, be empty rather than wrong.
            data_.reset();
            size_ = capacity_ = 0;
            const std::size_t room = size + size / spare_part;
            data_.reset(static_cast<T*>(::operator new[]((room + padding) * sizeof(T), alignment)));
            capacity_ = room;
            ask_for_huge_pages(data_.get(), bytes());
        }
        size_ = size;
        most_ = std::max(most_, size);
    }

    /// Empties it, and begins to measure anew what is needed.
    void begin_frame() { size_ = most_ = 0; }

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] std::size_t bytes() const { return capacity_ * sizeof(T); }
    /// Of those, what was needed at most since `begin_frame`.
    [[nodiscard]] std::size_t used_bytes() const { return most_ * sizeof(T); }
    [[nodiscard]] T* data() { return data_.get(); }
    [[nodiscard]] const T* data() const { return data_.get(); }
    [[nodiscard]] T& operator[](std::size_t i) { return data_.get()[i]; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return data_.get()[i]; }
    [[nodiscard]] T* begin() { return data(); }
    [[nodiscard]] T* end() { return data() + size_; }
    [[nodiscard]] const T* begin() const { return data(); }
    [[nodiscard]] const T* end() const { return data() + size_; }
    [[nodiscard]] std::span<T> span() { return {data(), size_}; }
    [[nodiscard]] std::span<const T> span() const { return {data(), size_}; }

private:
    static constexpr std::align_val_t alignment{64};
    /// One part in so many of what is asked for is added to it: the next frame may need a little more.
    static constexpr std::size_t spare_part = 8;
    struct Free {
        void operator()(T* p) const { ::operator delete[](p, alignment); }
    };
    std::unique_ptr<T, Free> data_;
    std::size_t size_ = 0;
    std::size_t capacity_ = 0;
    std::size_t most_ = 0;  ///< largest size since `begin_frame`
};

}  // namespace gridreel::rebuild
