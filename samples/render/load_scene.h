#pragma once

#include <filesystem>

#include "samples/image/fingerprint.h"
#include "samples/render/scene.h"

namespace walr::render {

/// Read a glTF 2.0 file (.gltf or .glb) with everything that it refers to.
/// @param sky  file of an equirectangular sky (see `loadSky`) that replaces the scene's own; may be empty
/// @param contents  takes in the bytes of all files that are read; may be null
///
/// Supported: the default scene's nodes, meshes of triangles (lists, strips and fans; floats and integers of
/// KHR_mesh_quantization, sparse accessors, KHR_draco_mesh_compression and EXT_meshopt_compression if built), vertex
/// colours, base colour, metallic, emissive and normal textures (PNG and JPEG, all texture coordinates,
/// KHR_texture_transform), the diffuse colours and the roughness of KHR_materials_pbrSpecularGlossiness, alpha mode
/// MASK, perspective cameras, LINEAR and STEP animation of translation, rotation and scale (of several animations of
/// the same things, the first), KHR_lights_punctual, KHR_materials_emissive_strength, and a constant sky in
/// `scenes[i].extras.sky_radiance`. Light units are radiometric: directional intensity is irradiance on a plane facing
/// the light, point and spot intensity is radiant intensity, emission is radiance. Tangents that a normal map lacks are
/// derived (`deriveTangents`). A primitive without a material, and one whose material says nothing of colour or
/// emission, is white, rough and no metal; the specification's default would be black without a specular lobe. A
/// material whose emissive texture cannot be read does not emit. A mesh with a skin is shown as it was modelled, where
/// its node is. A scene without a camera gets one
/// (`addFramingCamera`), and one without light a white sky of radiance 1 above and 0.25 below; without a camera,
/// glowing surfaces do not count as light. `Scene::warnings` says so, and lists what the file holds beyond that.
/// @throws SceneError naming the file and the part that is missing, damaged, required but not supported, or
///         beyond a limit (scene_limits.h)
Scene loadScene(const std::filesystem::path& file, const std::filesystem::path& sky = {},
                Fingerprint* contents = nullptr);

}  // namespace walr::render
