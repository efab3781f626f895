#pragma once
// What a picture will not show as the file says it, and what was decided for it.

#include "anim/frame_geometry.h"
#include "anim/scene.h"
#include "engine/shot.h"
#include "engine/textures.h"

#include <string>
#include <vector>

namespace gridreel::engine {

/// A sentence for each thing that is drawn otherwise than the file asks (missing images, blended materials)
/// and for each that was decided without being asked, the shot's. Only materials that some part uses count.
[[nodiscard]] std::vector<std::string> notes_on(const anim::Scene& scene, const anim::FrameGeometry& geometry,
                                                const Textures& textures, const Shot& shot);

/// Whether some part has a material with cut-outs (alpha mode MASK).
[[nodiscard]] bool has_cut_outs(const anim::Scene& scene, const anim::FrameGeometry& geometry);

}  // namespace gridreel::engine
