#include "anim/trs_matrix.h"

#include "anim/rotation.h"

namespace gridreel::anim {

glm::dmat4 matrix_of(const Trs& trs) {
    const glm::dmat3 rotation = glm::mat3_cast(unit_or_identity(trs.rotation));
    return {glm::dvec4{rotation[0] * trs.scale.x, 0.0}, glm::dvec4{rotation[1] * trs.scale.y, 0.0},
            glm::dvec4{rotation[2] * trs.scale.z, 0.0}, glm::dvec4{trs.translation, 1.0}};
}

}  // namespace gridreel::anim
