#include "engine/notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace gridreel::engine {
namespace {

std::set<anim::Index> used_materials(const anim::FrameGeometry& geometry) {
    std::set<anim::Index> used;
    for (const anim::Part& part : geometry.parts) {
        if (part.material) used.insert(*part.material);
    }
    return used;
}

}  // namespace

std::vector<std::string> notes_on(const anim::Scene& scene, const anim::FrameGeometry& geometry,
                                  const Textures& textures, const Shot& shot) {
    std::vector<std::string> notes;
    for (const std::string& problem : textures.problems()) {
        notes.push_back(fmt::format("drawn white: {}", problem));
    }
    for (const anim::Index material : used_materials(geometry)) {
        if (scene.materials[material].alpha_mode != anim::AlphaMode::blend) continue;
        notes.push_back(fmt::format("material {} \"{}\" has alpha mode BLEND: drawn opaque", material,
                                    scene.materials[material].name));
    }
    notes.insert(notes.end(), shot.notes().begin(), shot.notes().end());
    return notes;
}

bool has_cut_outs(const anim::Scene& scene, const anim::FrameGeometry& geometry) {
    return std::ranges::any_of(used_materials(geometry), [&](anim::Index material) {
        return scene.materials[material].alpha_mode == anim::AlphaMode::mask;
    });
}

}  // namespace gridreel::engine
