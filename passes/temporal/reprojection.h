#pragma once

#include <cstdint>

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/guides/history_tests.h"
#include "passes/guides/object_ids.h"
#include "passes/guides/prepare_guides.h"

namespace walr {

/// The source of the motion of surfaces between two frames.
enum class MotionSource : std::uint8_t {
  Texture,  ///< The host's motion texture.
  Camera,   ///< Depth and the two cameras: nothing moves but the camera.
  None,     ///< None: neither camera nor objects move, so that the history of a pixel is the pixel itself.
};

/// How a pass finds its history.
struct ReprojectionSettings {
  MotionSource motion = MotionSource::Texture;
  HistoryRejection rejection = HistoryRejection::Plane;
  bool dilateMotion = false;  ///< Follow the nearest surface of the 3x3 neighbourhood (Meunier & Harada 2022, 4.2).
  /// The pass prepares the guides of its frame itself (GUIDES in reprojection.glsl), and does not dilate motion.
  bool preparesGuides = false;
  bool testsNormals = true;  ///< The shader calls `historyTaps`, which may test geometric normals.
};

/// The reprojection for a scene.
/// @param still whether to skip reprojection if nothing moves; otherwise motion then comes from the camera
ReprojectionSettings reprojectionOf(const SceneDescription& scene, bool still, HistoryRejection rejection,
                                    bool dilateMotion);

/// Textures that a pass samples anyway. They are bound in place of textures that it leaves unread
/// (`fg::PassBuilder::unread`).
struct StandIns {
  /// For `texture2D`. Not valid if the pass samples none; the noisy light is then read instead.
  fg::Texture colour;
  fg::Texture number;  ///< For `utexture2D`.
};

/// Declare what a pass reads for reprojection.glsl, and specialize its shader. The pass itself declares
/// `frameConstants` and, unless it prepares the guides, `depth`.
void readReprojection(fg::PassBuilder& pass, const DenoiserInputs& inputs, const Guides& guides,
                      const ReprojectionSettings& settings, const StandIns& standIns);

/// Declare what a shader with confidence.glsl reads.
/// @param confidence not valid if the host has none, or the pass leaves it unread
void readConfidence(fg::PassBuilder& pass, fg::Texture confidence, const DenoiserInputs& inputs,
                    const StandIns& standIns);

/// Declare what a shader with OBJECTS reads in addition.
/// @param objects not valid if objects are not told apart
void readObjectIds(fg::PassBuilder& pass, const ObjectIds& objects, const StandIns& standIns);

}  // namespace walr
