#include "tools/gallery/morph_surface.h"

#include "tools/gallery/mesh_shapes.h"
#include "tools/gallery/packing.h"

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gridreel::gallery {

namespace {

/// Vertices of the grid: the surface's own, then one set of displacements per target.
struct Samples {
    std::vector<std::vector<glm::vec3>> positions, normals;
    std::vector<glm::u8vec4> colors;
};

Samples sample(const MorphSurface& surface, std::uint32_t columns, std::uint32_t rows, double du, double dv) {
    const std::size_t layers = 1 + surface.target_count;
    const std::size_t vertex_count = std::size_t{columns} * rows;
    Samples samples{.positions = {layers, std::vector<glm::vec3>(vertex_count)},
                    .normals = {layers, std::vector<glm::vec3>(vertex_count)},
                    .colors = std::vector<glm::u8vec4>(vertex_count)};

    tbb::parallel_for(std::uint32_t{0}, rows, [&](std::uint32_t row) {
        std::vector<glm::dvec3> here(layers), left(layers), right(layers), below(layers), above(layers);
        for (std::uint32_t column = 0; column < columns; ++column) {
            const double u = du * double(column), v = dv * double(row);
            constexpr double step = 1e-5;
            surface.at(u, v, here);
            surface.at(u - step, v, left);
            surface.at(u + step, v, right);
            surface.at(u, v - step, below);
            surface.at(u, v + step, above);

            const std::size_t vertex = std::size_t{row} * columns + column;
            const glm::dvec3 along_u = right[0] - left[0], along_v = above[0] - below[0];
            const glm::dvec3 across = glm::cross(along_u, along_v);
            const double area = glm::length(across);
            for (std::size_t layer = 0; layer < layers; ++layer) {
                // The derivative of the cross product, divided by its length.
                const glm::dvec3 change = layer == 0 ? across
                                                     : glm::cross(right[layer] - left[layer], along_v) +
                                                           glm::cross(along_u, above[layer] - below[layer]);
                samples.positions[layer][vertex] = here[layer];
                samples.normals[layer][vertex] = change / area;
            }
            samples.colors[vertex] = color_bytes(surface.color(u, v));
        }
    });
    return samples;
}

std::vector<glm::uvec3> grid_triangles(const GridSize& size, std::uint32_t vertex_columns,
                                       std::uint32_t vertex_rows) {
    std::vector<glm::uvec3> triangles;
    triangles.reserve(std::size_t{2} * size.columns * size.rows);
    for (std::uint32_t row = 0; row < size.rows; ++row)
        for (std::uint32_t column = 0; column < size.columns; ++column) {
            const std::uint32_t right = (column + 1) % vertex_columns, above = (row + 1) % vertex_rows;
            const std::uint32_t a = row * vertex_columns + column, b = row * vertex_columns + right;
            const std::uint32_t c = above * vertex_columns + right, d = above * vertex_columns + column;
            // Diagonals alternate, so that shading has no grain.
            if ((row + column) % 2 == 0) {
                triangles.emplace_back(a, b, c);
                triangles.emplace_back(a, c, d);
            } else {
                triangles.emplace_back(a, b, d);
                triangles.emplace_back(b, c, d);
            }
        }
    return triangles;
}

}  // namespace

GridSize choose_grid(std::size_t triangles, double aspect, std::uint32_t least) {
    const double quads = std::max(1.0, double(triangles) / 2.0);
    const double ideal_rows = std::sqrt(quads / aspect);

    // Among row counts near the ideal one, the best fit of columns * rows.
    GridSize best;
    double best_error = INFINITY;
    const double low = std::max(double(least), std::floor(0.95 * ideal_rows));
    const double high = std::max(low, std::ceil(1.05 * ideal_rows));
    for (double rows = low; rows <= high; ++rows) {
        const double columns = std::max(double(least), std::floor(quads / rows + 0.5));
        const double error = std::abs(columns * rows - quads);
        if (error < best_error) {
            best_error = error;
            best = {static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows)};
        }
    }
    return best;
}

Id add_morph_mesh(Document& document, std::string name, const MorphSurface& surface, const GridSize& size,
                  Id material) {
    const std::uint32_t extra = surface.wraps ? 0 : 1;
    const std::uint32_t columns = size.columns + extra, rows = size.rows + extra;
    Samples samples = sample(surface, columns, rows, 1.0 / size.columns, 1.0 / size.rows);

    // Each layer's memory is given back as soon as its bytes are in the document.
    Mesh mesh{.name = std::move(name), .material = material};
    for (std::size_t layer = 0; layer <= surface.target_count; ++layer) {
        const Attributes attributes{
            {"POSITION", add_positions(document, std::exchange(samples.positions[layer], {}))},
            {"NORMAL", add_normals(document, std::exchange(samples.normals[layer], {}))}};
        if (layer == 0)
            mesh.attributes = attributes;
        else
            mesh.targets.push_back(attributes);
    }
    mesh.attributes.emplace_back("COLOR_0", add_colors(document, samples.colors));
    mesh.indices = add_indices(document, grid_triangles(size, columns, rows), samples.colors.size());
    return append(document.meshes, std::move(mesh));
}

}  // namespace gridreel::gallery
