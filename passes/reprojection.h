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
};
MotionSource motionSource(const SceneDescription& scene);

/// Declare what a pass that includes reprojection.glsl reads.
/// @param rejection    the one that the pass's shader is made for
/// @param motion       the same of the motion's source
/// @param dilateMotion follow the nearest surface of the 3x3 neighbourhood (Meunier & Harada 2022, 4.2)
void readReprojection(fg::PassBuilder& pass, const DenoiserInputs& inputs, const Guides& guides,
                      HistoryRejection rejection, MotionSource motion, bool dilateMotion = false);

/// Declare what REJECT_BY_OBJECT reads besides.
void readObjectIds(fg::PassBuilder& pass, const ObjectIds& objects);

}  // namespace walr
