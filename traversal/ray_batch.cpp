#include "traversal/ray_batch.h"

#include <cassert>

namespace gridreel::traversal {

void RayBatch::resize(std::size_t count, std::optional<glm::vec3> shared_origin, RayOrder ray_order) {
    common_origin = shared_origin;
    common_direction = std::nullopt;
    order = ray_order;
    resize_arrays(count);
}

void RayBatch::resize_parallel(std::size_t count, const glm::vec3& shared_direction, RayOrder ray_order) {
    common_origin = std::nullopt;
    common_direction = shared_direction;
    order = ray_order;
    resize_arrays(count);
}

void RayBatch::resize_arrays(std::size_t count) {
    for (auto& axis : origin) axis.resize(common_origin ? 0 : count);
    for (auto& axis : direction) axis.resize(common_direction ? 0 : count);
    t_min.resize(count);
    t_max.resize(count);
    after_triangle.resize(0);
}

glm::vec3 RayBatch::origin_of(std::size_t ray) const {
    return common_origin ? *common_origin : glm::vec3{origin[0][ray], origin[1][ray], origin[2][ray]};
}

glm::vec3 RayBatch::direction_of(std::size_t ray) const {
    return common_direction ? *common_direction
                            : glm::vec3{direction[0][ray], direction[1][ray], direction[2][ray]};
}

void RayBatch::set_origin(std::size_t ray, const glm::vec3& value) {
    assert(!common_origin);
    for (int axis = 0; axis < 3; ++axis) origin[std::size_t(axis)][ray] = value[axis];
}

void RayBatch::set_direction(std::size_t ray, const glm::vec3& value) {
    assert(!common_direction);
    for (int axis = 0; axis < 3; ++axis) direction[std::size_t(axis)][ray] = value[axis];
}

void HitBatch::resize(std::size_t count) {
    t.resize(count);
    triangle.resize(count);
}

}  // namespace gridreel::traversal
