#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "samples/image/image.h"

namespace walr {

/// Linear view depth that stands for "nothing was hit" in files and textures, as Blender writes it.
inline constexpr float kBackgroundDepth = 1e10F;
/// Linear view depth from which on a pixel is sky.
inline constexpr float kSkyDepth = 1e9F;

/// The camera of one frame. See `FrameDescription` (passes/frame.h) for the conventions.
struct Camera {
  glm::mat4 view{1.0F};          ///< World to view space.
  glm::mat4 previousView{1.0F};  ///< `view` of the frame before.
  glm::mat4 projection{1.0F};    ///< View to clip space, without jitter.
  glm::vec2 jitter{0.0F};        ///< Pixels, y down: sample position minus pixel centre.
  bool cut = false;              ///< This frame follows a camera cut: nothing is carried over from the frame before.
};

/// The noise-free picture of a frame. A pixel of which no component is a number is one without a reference.
struct Reference {
  Image indirect = {};      ///< 3 components: demodulated diffuse indirect radiance.
  Image direct = {};        ///< 3 components: demodulated diffuse direct radiance; may be empty.
  Image indirectHalf = {};  ///< 3 components: the mean of one half of the paths of `indirect`; may be empty.
};

/// Values in one channel of a file that are not finite.
struct NonFiniteChannel {
  std::filesystem::path file;
  std::string channel;
  int firstX = 0;
  int firstY = 0;
  std::size_t count = 0;
};

/// One frame as its renderer wrote it. All images have one size; spaces and scales are those of its layout.
struct Frame {
  int number = 0;
  Image indirect;  ///< 3 components: demodulated diffuse indirect radiance, linear, 1 sample per pixel.
  Image direct;    ///< 3 components: demodulated diffuse direct radiance; empty unless asked for.
  Image albedo;    ///< 3 components: diffuse albedo; 0 where there is no diffuse lobe.
  Image normal;    ///< 3 components: unit shading normal towards the camera; 0 on sky.
  Image depth;     ///< 1 component: linear view depth, scene units; `kBackgroundDepth` on sky.
  Image motion;    ///< 3 components: motion to the previous frame; z = previous minus current view depth, if given.
  Image emission;  ///< 3 components: radiance of visible lamps and sky; empty unless asked for.
  Image objectId;  ///< 1 component: number of the object in the pixel, below 0 where there is none; may be empty.
  Camera camera;
  /// Camera of the frame before; the own one where there is none.
  glm::mat4 previousProjection{1.0F};
  glm::vec2 previousJitter{0.0F};
  bool resetHistory = false;  ///< First frame, or a camera cut.
  std::optional<Reference> reference;
  std::vector<NonFiniteChannel> nonFinite;
};

}  // namespace walr
