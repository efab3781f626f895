#include "sequences/scene_info.h"

#include "anim/frame_geometry.h"
#include "anim/pose.h"
#include "engine/notes.h"
#include "engine/shot.h"
#include "engine/textures.h"
#include "sequences/fingerprint.h"
#include "sequences/thread_count.h"

#include <algorithm>

namespace gridreel::sequences {
namespace {

const char* kind_of(const anim::Camera& camera) {
    return camera.kind == anim::Camera::Kind::perspective ? "perspective" : "orthographic";
}

const char* kind_of(const anim::Light& light) {
    switch (light.kind) {
        case anim::Light::Kind::directional:
            return "directional";
        case anim::Light::Kind::point:
            return "point";
        case anim::Light::Kind::spot:
            return "spot";
    }
    return "";
}

double duration_of(const anim::Animation& animation) {
    double last_s = 0.0;
    for (const anim::Channel& channel : animation.channels) {
        last_s = std::max(last_s, double(animation.samplers[channel.sampler].times_s.back()));
    }
    return last_s;
}

void count_triangles(const anim::FrameGeometry& geometry, SceneInfo& info) {
    info.vertices = geometry.positions.size();
    info.moving_triangles = geometry.moving_triangles();
    info.still_triangles = geometry.triangles.size() - info.moving_triangles;
}

void list_nodes(const anim::Scene& scene, const anim::Clip& clip, SceneInfo& info) {
    for (const anim::Index index : anim::nodes_in_order(scene, clip)) {
        const anim::Node& node = scene.nodes[index];
        if (node.camera) {
            const anim::Camera& camera = scene.cameras[*node.camera];
            info.cameras.push_back({.node = node.name, .name = camera.name, .kind = kind_of(camera)});
        }
        if (node.light) {
            const anim::Light& light = scene.lights[*node.light];
            info.lights.push_back({.node = node.name, .name = light.name, .kind = kind_of(light)});
        }
    }
}

/// What a render would say, or refuse, at its first frame.
std::vector<std::string> notes_of(const anim::Scene& scene, const anim::Clip& clip,
                                  const anim::FrameGeometry& geometry,
                                  const engine::RenderSettings& settings) {
    const engine::Shot shot(scene, clip, settings);
    (void)shot.camera().view(anim::pose(scene, clip, 0.0));
    return engine::notes_on(scene, geometry, engine::Textures(scene), shot);
}

}  // namespace

SceneInfo inspect(const Take& take) {
    const LoadedScene loaded = load_scene(take);
    const anim::Scene& scene = loaded.scene;
    const anim::Clip clip = choose_clip(scene, take);

    SceneInfo info;
    info.file = take.scene_file;
    info.sha256 = scene_sha256(take.scene_file, take.asset_root);
    info.rate = take.rate;
    info.scenes = scene.scenes.size();
    info.scene = clip.scene;
    info.duration_s = clip.duration_s;
    info.last_frame = last_frame(clip.duration_s, take.rate);
    info.bounds = anim::clip_bounds(scene, clip);
    info.nodes = scene.nodes.size();
    info.meshes = scene.meshes.size();
    info.skins = scene.skins.size();
    info.variants = scene.variants;
    info.variant = loaded.variant;
    info.textures = scene.textures.size();
    info.images = scene.images.size();
    info.extensions_used = scene.extensions_used;
    info.extensions_required = scene.extensions_required;
    info.extensions_supported = scene.extensions_supported;
    info.warnings = scene.warnings;
    for (anim::Index i = 0; i < scene.animations.size(); ++i) {
        const double duration_s = duration_of(scene.animations[i]);
        info.animations.push_back(
            {.name = scene.animations[i].name,
             .duration_s = duration_s,
             .last_frame = last_frame(duration_s, take.rate),
             .plays = std::count(clip.animations.begin(), clip.animations.end(), i) > 0});
    }
    for (const anim::Mesh& mesh : scene.meshes) info.morph_targets += mesh.weights.size();
    for (const anim::Material& material : scene.materials) info.materials.push_back(material.name);
    list_nodes(scene, clip, info);
    const anim::FrameGeometry geometry = anim::lay_out(scene, clip);
    count_triangles(geometry, info);
    info.notes = notes_of(scene, clip, geometry, info.settings);
    info.threads = allowed_threads();
    info.memory = estimate_memory(scene, geometry, info.bounds, info.settings, info.threads);
    return info;
}

}  // namespace gridreel::sequences
