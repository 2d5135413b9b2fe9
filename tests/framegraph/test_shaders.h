#pragma once

#include "framegraph/declare/graph.h"

namespace fg::test {

/// States in which hosts usually import and export images.
inline constexpr ExternalState kSampled = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                           VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
inline constexpr ExternalState kTransferSource = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                                                  VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};

inline constexpr TextureDesc kColor = {VK_FORMAT_R16G16B16A16_SFLOAT, {64, 32}};

inline void recordNothing(const RecordContext& /*context*/) {}

}  // namespace fg::test
