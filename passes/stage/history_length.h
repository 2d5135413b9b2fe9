#pragma once

#include <cstdint>

#include "framegraph/declare/graph.h"
#include "passes/conventions/light_pattern.h"
#include "passes/stage/stage_graph.h"

namespace walr {

/// Format of a texture that receives history lengths: frames, or samples with counted light, rounded to a half.
inline constexpr VkFormat kHistoryLengthFormat = VK_FORMAT_R16_SFLOAT;

/// Add a pass that writes the history length of every pixel.
/// @param accumulated a mean over time with its history length: RGBA16F, or packed light (R32_UINT) of accumulation
/// @param channel     of RGBA16F: the one that holds the length
/// @param target      of `kHistoryLengthFormat` and the extent of the image
/// @param groups      of pixels that share a texel of `accumulated`
/// @returns the target's new version
fg::Texture addHistoryLength(StageGraph graph, fg::Texture accumulated, std::uint32_t channel, fg::Texture target,
                             const LightPattern& groups = {});

}  // namespace walr
