#pragma once
// A glTF file at one time as world-space triangles, in double precision, from the specification's text alone.
//
// The order is that of `gridreel bake` (CLI.md): nodes of the scene depth first in file order, instances of a
// node in order, primitives in file order, vertices in accessor order. Written to be read beside the
// specification, not to be quick; it shares no code with the program that it checks.

#include "clip.h"
#include "file.h"
#include "node_states.h"
#include "primitives.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace gridreel::evaluator {

struct Frame {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;  ///< one per position: unit length, or zero where the file has none
    std::vector<Triangle> triangles;
};

/// What of a file does not change with time, read once.
struct Model {
    File file;
    std::vector<std::vector<Primitive>> meshes;
    std::vector<std::vector<Matrix>> inverse_bind;  ///< per skin, one per joint
    std::vector<std::vector<Matrix>> instances;     ///< per node; one identity where it has none of its own
};

/// @throws std::exception as `read_file` does, and for compressed meshes
[[nodiscard]] Model read_model(const std::filesystem::path& path);

/// One scene of a model with what plays in it.
class Film {
public:
    /// @param model  outlives the film
    Film(const Model& model, const std::vector<std::size_t>& animations, std::size_t scene);

    /// Nodes that are hidden at that time have vertices, but no triangles; those that the clip never shows
    /// have neither.
    [[nodiscard]] Frame at(double time_s) const;

    [[nodiscard]] const Clip& clip() const { return clip_; }

private:
    const Model& model_;
    Clip clip_;
    std::vector<std::size_t> shown_nodes_;  ///< in order
};

}  // namespace gridreel::evaluator
