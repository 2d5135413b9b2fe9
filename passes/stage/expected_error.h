#pragma once

#include "framegraph/declare/graph.h"
#include "passes/stage/stage_graph.h"

namespace walr {

/// Format of a texture that receives expected errors: root mean square error after the tone map x / (1 + x).
inline constexpr VkFormat kExpectedErrorFormat = VK_FORMAT_R16_SFLOAT;

/// Offer the expected error of a result (passes/EXPECTED_ERROR.md), and its view.
/// @param accumulated the mean over time of the light with its history length: packed light (R32_UINT) of accumulation
/// @param result      RGBA16F: the denoised light, of the same extent
void offerExpectedError(StageGraph graph, fg::Texture accumulated, fg::Texture result);

}  // namespace walr
