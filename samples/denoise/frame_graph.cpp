#include "samples/denoise/frame_graph.h"

#include "shaders/constants/frame.h"

namespace walr {
namespace {

constexpr VkFormat kColourFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat kDepthFormat = VK_FORMAT_R32_SFLOAT;

}  // namespace

const HostStates kComputeHost{
    .inputs = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL},
    .outputBefore = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_UNDEFINED},
    .outputAfter = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
};

DenoiseGraph declareDenoiseGraph(Denoiser& method, fg::Extent extent, const InputConventions& conventions,
                                 const HostStates& states) {
  DenoiseGraph declared;
  fg::Graph& graph = declared.graph;
  const auto import = [&](const char* name, VkFormat format, const fg::ExternalState& state) {
    return graph.import(name, fg::TextureDesc{.format = format, .extent = extent}, state);
  };
  declared.inputs = {.lighting = import("lighting", kColourFormat, states.inputs),
                     .depth = import("depth", kDepthFormat, states.inputs),
                     .normal = import("normal", kColourFormat, states.inputs),
                     .motion = import("motion", kColourFormat, states.inputs),
                     .albedo = import("albedo", kColourFormat, states.inputs),
                     .frame = graph.upload("frame constants", sizeof(FrameConstants)),
                     .conventions = conventions};
  declared.output = import("denoised", kColourFormat, states.outputBefore);
  graph.exported(method.add(graph, declared.inputs, declared.output), states.outputAfter);
  return declared;
}

}  // namespace walr
