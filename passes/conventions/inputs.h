#pragma once

#include "framegraph/declare/graph.h"
#include "passes/conventions/light_pattern.h"
#include "passes/conventions/scene_description.h"

namespace walr {

/// How a host's inputs differ from the project's conventions. These are: normals in view space, where the camera looks
/// down -Z and y is up; motion between jittered images whose y is down, with the change of view depth as its third
/// channel. The first stage converts.
struct InputConventions {
  enum class Space { View, World };
  /// Where motion.z (previous minus current view depth, scene units) comes from.
  enum class MotionDepth {
    Given,        ///< The motion texture's third channel.
    StaticScene,  ///< Computed from depth and the two view matrices; right where only the camera moves.
    /// Found among the history pixels that motion.xy leads to: the depth nearest to that of a still surface, if it is
    /// near enough (reprojection.glsl). Only for methods that test history (`HistoryRejection`).
    Found,
  };
  Space normal = Space::View;
  MotionDepth motionDepth = MotionDepth::Given;
  /// Whether motion.xy is between the jittered images, from pixel centre to pixel centre. If not, it is the motion that
  /// cameras without jitter would show.
  bool motionJittered = true;
  /// The light is specular: see `DenoiserInputs::specularAlbedo`.
  bool specular = false;
  LightPattern light = {};
  /// The camera stands in for an orthographic one: no motion can be computed from it.
  bool orthographic = false;

  /// Which pixels have a sample: as `light` says, and of specular light only those with a distance.
  [[nodiscard]] LightPattern samples() const {
    LightPattern pattern = light;
    pattern.masked = light.masked || specular;
    return pattern;
  }
};

/// The textures that denoisers take, `albedo` for diffuse light only. `objectId`, `confidence` and `specularMotion` may
/// be left out. All have the extent of the image, but see `LightPattern` for that of the lighting.
struct DenoiserInputs {
  fg::Texture lighting;  ///< RGBA16F: demodulated diffuse indirect radiance, linear, 1 sample per texel. Alpha: see
                         ///< `LightPattern::masked`.
  fg::Texture depth;     ///< R32F: linear view depth (-z of view space), scene units; sky at or beyond `skyDepth`.
  fg::Texture normal;    ///< RGBA16F: unit shading normal; zero on sky.
  fg::Texture motion;    ///< RGBA16F: motion to the previous frame; see `FrameDescription::motionScale`.
  fg::Texture albedo;    ///< RGBA16F: diffuse albedo; where all channels are below `guides.albedo-threshold`,
                         ///< a pixel has no diffuse lobe.
  /// R32_UINT, or another format of unsigned integers: id of the object that the pixel shows, constant from frame to
  /// frame; 0xffffffff: none. `joint_bilateral` rejects history of other objects by it,
  /// and so does anti-aliasing with `antialiasing.object-ids`.
  fg::Texture objectId = {};
  /// R8_UNORM, or another format of floats: how much of its history a pixel may use, 0 to 1. If present, it scales the
  /// longest history of light; NaN counts as 1.
  fg::Texture confidence = {};
  /// The next three are of specular light only (`InputConventions::specular`). The lighting is then the light that the
  /// specular lobe reflects, over the lobe's directional albedo, and its alpha is the distance from the surface to what
  /// it reflects, scene units, 0 where there is no sample.
  fg::Texture specularAlbedo = {};  ///< RGBA16F: directional albedo of the specular lobe, in the place of `albedo`.
  fg::Texture roughness = {};       ///< R8_UNORM, or another format of floats: linear roughness (glTF).
  /// RGBA16F: where the point that specular light comes from (at the distance in the alpha of the lighting) was in the
  /// previous frame, minus where it is; world space, scene units. If not present, or where it is not finite, that point
  /// counts as still.
  fg::Texture specularMotion = {};
  fg::Buffer frame;  ///< Upload of `FrameConstants` (passes/conventions/frame.h).
  InputConventions conventions;
  SceneDescription scene = {};

  /// Albedo of the lobe that the light belongs to.
  [[nodiscard]] fg::Texture lobeAlbedo() const { return conventions.specular ? specularAlbedo : albedo; }
  /// Extent of the image.
  [[nodiscard]] fg::Extent extent(const fg::Graph& graph) const {
    return graph.textureDesc(conventions.light.fullSize() ? lighting : depth).extent;
  }
};

}  // namespace walr
