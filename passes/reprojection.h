#pragma once

#include <cstdint>

#include "framegraph/declare/graph.h"
#include "passes/history_tests.h"
#include "passes/inputs.h"
#include "passes/object_ids.h"
#include "passes/prepare_guides.h"

namespace walr {

/// Where the way of a surface between two frames comes from.
enum class MotionSource : std::uint8_t {
  Texture,  ///< The host's motion texture.
  Camera,   ///< Depth and the two cameras: nothing else moves.
  None,     ///< Nothing moves, nor does the camera: every pixel shows what it showed before.
};

/// How a pass finds its history.
struct ReprojectionSettings {
  MotionSource motion = MotionSource::Texture;
  HistoryRejection rejection = HistoryRejection::Plane;
  bool dilateMotion = false;  ///< Follow the nearest surface of the 3x3 neighbourhood (Meunier & Harada 2022, 4.2).
};

/// @param still whether a scene in which nothing moves is treated as such; else its motion comes from the camera
ReprojectionSettings reprojectionOf(const SceneDescription& scene, bool still, HistoryRejection rejection,
                                    bool dilateMotion);

/// Textures that a pass samples anyhow. They are bound in place of those that it leaves unread
/// (`fg::PassBuilder::unread`).
struct StandIns {
  /// For `texture2D`. Not valid where the pass samples none: the noisy light is then read instead.
  fg::Texture colour;
  fg::Texture number;  ///< For `utexture2D`.
};

/// Declare what a pass that includes reprojection.glsl reads for it, but for `frameConstants` and `depth`, which the
/// pass declares itself, and specialize the shader accordingly.
void readReprojection(fg::PassBuilder& pass, const DenoiserInputs& inputs, const Guides& guides,
                      const ReprojectionSettings& settings, const StandIns& standIns);

/// Declare what a shader with OBJECTS reads besides.
/// @param objects not valid where objects are not told apart
void readObjectIds(fg::PassBuilder& pass, const ObjectIds& objects, const StandIns& standIns);

}  // namespace walr
