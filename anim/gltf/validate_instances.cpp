#include "anim/gltf/validate.h"

#include <fmt/format.h>

#include <optional>

namespace gridreel::anim::gltf {
namespace {

void check_type(const Place& place, std::string_view element, bool may_be_normalized,
                const Accessor& accessor) {
    const bool is_normalized = accessor.normalized && (accessor.component == ComponentType::int8 ||
                                                       accessor.component == ComponentType::int16);
    if (accessor.is(element) && (accessor.is_float() || (may_be_normalized && is_normalized))) return;
    place.refuse(fmt::format("this is {} of {}; it must be {} of FLOAT{}", accessor.element.name,
                             name_of(accessor.component), element,
                             may_be_normalized ? ", or of normalized BYTE or SHORT" : ""));
}

void check_attributes(const Place& attributes, std::span<const Accessor> accessors) {
    std::optional<Place> first;
    for (const std::string_view name : {"TRANSLATION", "ROTATION", "SCALE"}) {
        const auto place = attributes.find(name);
        if (!place) continue;
        const Accessor& accessor = accessors[place->index()];
        check_type(*place, name == "ROTATION" ? "VEC4" : "VEC3", name == "ROTATION", accessor);
        if (!first) first = place;
        const std::size_t count = accessors[first->index()].count;
        if (accessor.count != count)
            place->refuse(fmt::format("there are {} elements; {} has {}, and instances need all",
                                      accessor.count, first->pointer(), count));
    }
}

}  // namespace

void validate_instances(const Place& root, std::span<const Accessor> accessors) {
    const auto nodes = root.find("nodes");
    for (std::size_t i = 0; nodes && i < nodes->size(); ++i) {
        const auto instancing = (*nodes)[i].find_extension("EXT_mesh_gpu_instancing");
        const auto attributes = instancing ? instancing->find("attributes") : std::optional<Place>{};
        if (attributes) check_attributes(*attributes, accessors);
    }
}

}  // namespace gridreel::anim::gltf
