#include "anim/load.h"

#include "anim/gltf/describe_scene.h"
#include "anim/gltf/document.h"
#include "anim/gltf/draco_primitives.h"
#include "anim/gltf/extensions.h"
#include "anim/gltf/influences.h"
#include "anim/gltf/missing_texcoords.h"
#include "anim/gltf/read_animations.h"
#include "anim/gltf/read_images.h"
#include "anim/gltf/read_materials.h"
#include "anim/gltf/read_meshes.h"
#include "anim/gltf/read_node_extensions.h"
#include "anim/gltf/read_textures.h"
#include "anim/gltf/undrawn_looks.h"
#include "anim/gltf/validate.h"
#include "anim/gltf/version.h"

#include <utility>

namespace gridreel::anim {
namespace {

using namespace gltf;

void validate(Document& document) {
    const Place root = document.root();
    check_version(root);
    check_extensions(document);
    validate_shape(root);
    document.read_buffers();
    validate_nodes(root, document.accessors());
    validate_instances(root, document.accessors());
    validate_meshes(root, document.accessors());
    validate_animations(root, document.accessors());
    validate_cameras_and_lights(root);
}

}  // namespace

Scene load_bytes(std::span<const std::byte> bytes, const std::filesystem::path& file,
                 const std::filesystem::path& asset_root) {
    Document document(bytes, file, asset_root);
    validate(document);
    decompress_primitives(document);

    Scene scene = describe_scene(document);
    read_node_extensions(document, scene);
    scene.materials = read_materials(document);
    scene.textures = read_textures(document, scene.materials);
    scene.name = file.stem().string();
    scene.meshes = read_meshes(document);
    pay_for_morph_weights(document, scene);
    warn_of_missing_texcoords(document, scene);
    scene.animations = read_animations(document);
    warn_of_undrawn_looks(document, scene);
    scene.images = read_images(document, scene.textures);
    check_joints_exist(document, scene);
    scene.warnings = document.merged_warnings();
    return scene;
}

Scene load(const std::filesystem::path& file, const std::filesystem::path& asset_root) {
    return load_bytes(read_whole_file(file), file, asset_root);
}

}  // namespace gridreel::anim
