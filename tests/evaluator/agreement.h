#pragma once
// Whether the program places every vertex where the evaluator does.

#include "evaluate.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <filesystem>
#include <span>

namespace gridreel::test {

/// Checks (Catch2) that vertices are within 1e-5 of the diagonal of the frame's bounding box, normals within
/// 1e-3 of unit length, and triangles the same.
void check_frame(const evaluator::Frame& expected, std::span<const glm::vec3> positions,
                 std::span<const glm::vec3> normals, std::span<const glm::uvec3> triangles);

/// Checks one file so, at up to a dozen times of each of these clips: what plays by default, and each
/// animation alone; in each of its scenes.
///
/// The times are before 0, at 0, at keys, between keys, at the last key and past it; in no order, because
/// `anim::deform` writes again only what moves.
///
/// @return times compared
std::size_t check_agreement(const std::filesystem::path& file);

}  // namespace gridreel::test
