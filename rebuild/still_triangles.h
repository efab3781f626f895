#pragma once
// Which triangles of an animation never move.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gridreel::rebuild {

/// Triangles `begin` to `end - 1`.
struct TriangleRun {
    std::size_t begin = 0, end = 0;

    friend bool operator==(const TriangleRun&, const TriangleRun&) = default;
};

/// A promise of whoever animates triangles: those of its runs have the same corners in every frame.
///
/// Made once for each animation, and shared by its frames (`TriangleView::still`): whoever is shown the same
/// object again knows that it is the same animation. Never changes.
class StillTriangles {
public:
    /// @param count  triangles of the animation, moving ones too
    /// @param runs   of those that are still: ascending, and no two have a triangle in common
    /// @throws std::invalid_argument for other runs, or such as reach beyond `count`
    StillTriangles(std::size_t count, std::vector<TriangleRun> runs);

    [[nodiscard]] std::size_t count() const { return is_still_.size(); }
    [[nodiscard]] bool is_still(std::uint32_t triangle) const { return is_still_[triangle]; }
    [[nodiscard]] std::span<const TriangleRun> runs() const { return runs_; }

    /// Whether most are still. Otherwise finding all cells anew costs little more than sorting out which of
    /// them are known.
    [[nodiscard]] bool few_move() const { return few_move_; }

    /// The triangles that move, ascending, if they are few; otherwise none.
    [[nodiscard]] std::span<const std::uint32_t> few_moving() const { return few_moving_; }

    [[nodiscard]] std::size_t bytes() const;

private:
    std::vector<TriangleRun> runs_;
    std::vector<bool> is_still_;
    bool few_move_ = false;
    std::vector<std::uint32_t> few_moving_;
};

}  // namespace gridreel::rebuild
