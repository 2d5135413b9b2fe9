#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "passes/conventions/light_pattern.h"
#include "samples/image/image.h"
#include "samples/image/pixel_rect.h"

namespace walr {

/// Linear view depth of a pixel whose ray hit nothing, in files and textures; the value that Blender writes.
inline constexpr float kBackgroundDepth = 1e10F;
/// Pixels with at least this linear view depth are sky.
inline constexpr float kSkyDepth = 1e9F;

/// The camera of one frame. See `FrameDescription` (passes/conventions/frame.h) for the conventions.
struct Camera {
  glm::mat4 view{1.0F};          ///< World to view space.
  glm::mat4 previousView{1.0F};  ///< `view` of the frame before.
  glm::mat4 projection{1.0F};    ///< View to clip space, without jitter.
  glm::vec2 jitter{0.0F};        ///< Pixels, y down: sample position minus pixel centre.
  bool cut = false;              ///< This frame follows a camera cut: no history of the frame before is used.
};

/// A light of a frame: the two parts of diffuse light, and specular light.
enum class Light {
  Indirect,  ///< That bounced at least once before it arrived at the surface.
  Direct,    ///< That arrived from lamps and the sky.
  Specular,  ///< `Frame::specular`.
};

/// The light of a frame with many samples per pixel. A pixel with NaN in all components has no reference.
struct Reference {
  Image indirect = {};  ///< 3 components: demodulated diffuse indirect radiance; may be empty if direct light is read.
  Image direct = {};    ///< 3 components: demodulated diffuse direct radiance; may be empty.
  Image indirectHalf = {};  ///< 3 components: the mean of one half of the samples of `indirect`; may be empty.
  Image specular = {};      ///< 3 components: see `Frame::specular`; may be empty.
  Image specularHalf = {};  ///< 3 components: the mean of one half of the samples of `specular`; may be empty.
};

/// The non-finite values in one channel of a file: their number and the first position.
struct NonFiniteChannel {
  std::filesystem::path file;
  std::string channel;
  int firstX = 0;
  int firstY = 0;
  std::size_t count = 0;
};

/// One frame as its renderer wrote it. All images have one size; pixels outside of the file's data window are sky
/// without light. The space of normals and the scale of motion depend on the `Layout`.
struct Frame {
  int number = 0;
  /// 3 components: demodulated diffuse indirect radiance, linear; empty unless requested. Undefined at pixels that
  /// have no sample by `light`.
  Image indirect;
  LightPattern light;                 ///< Which pixels have a sample of the light that is denoised.
  glm::ivec2 lightOffset{0};          ///< See `FrameDescription::lightOffset`.
  glm::ivec2 previousLightOffset{0};  ///< That of the frame before.
  Image direct;                       ///< 3 components: demodulated diffuse direct radiance; empty unless requested.
  Image albedo;                       ///< 3 components: diffuse albedo; 0 where there is no diffuse lobe.
  Image normal;                       ///< 3 components: unit shading normal towards the camera; 0 on sky.
  Image depth;                        ///< 1 component: linear view depth, scene units; `kBackgroundDepth` on sky.
  Image motion;    ///< 3 components: motion to the previous frame; z = previous minus current view depth, if given.
  Image emission;  ///< 3 components: radiance of visible lamps and sky; empty unless requested.
  /// 3 components: radiance of light that is not diffuse (glossy, transmitted, scattered in volumes); empty unless
  /// requested, and if the files hold none.
  Image nonDiffuse;
  /// 3 components: light that the specular lobe reflects, divided by `specularAlbedo`. It and the next three images are
  /// empty unless requested, and if the files hold none. Frames of Cycles may lack distance and roughness.
  Image specular;
  /// 1 component: distance from the surface to the first hit along the specular path, scene units; `kBackgroundDepth`
  /// if it met nothing, 0 where there was no sample.
  Image specularDistance;
  Image roughness;  ///< 1 component: linear (glTF), 0..1.
  Image
      specularAlbedo;  ///< 3 components: directional albedo of the specular lobe, as the renderer defines it; 0 on sky.
  /// 3 components: where the first point that the specular path hit was in the previous frame, minus where it is; world
  /// space, scene units. 0 where it did not move, where the path met nothing, and where there was no sample. Empty
  /// unless specular light is requested, and if the files hold none.
  Image specularMotion;
  Image objectId;  ///< 1 component: number of the object in the pixel, below 0 where there is none; may be empty.
  Camera camera;   ///< Of the images.
  std::optional<ImagePlace> place;  ///< Absent: the images are the whole picture.
  /// Projection and jitter of the frame before; for the first frame, those of this frame.
  glm::mat4 previousProjection{1.0F};
  glm::vec2 previousJitter{0.0F};
  std::optional<glm::ivec2> previousSize;  ///< Of the frame before, pixels, if it differs.
  bool resetHistory = false;               ///< First frame, or a camera cut.
  std::optional<Reference> reference;
  std::vector<NonFiniteChannel> nonFinite;
};

}  // namespace walr
