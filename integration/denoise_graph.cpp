#include "integration/denoise_graph.h"

#include <string>

#include "shaders/constants/frame.h"

namespace walr {

const HostStates kComputeHost{
    .inputs = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL},
    .outputBefore = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_UNDEFINED},
    .outputAfter = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
};

DenoiserInputs importInputs(fg::Graph& graph, fg::Extent extent, const InputConventions& conventions,
                            const fg::ExternalState& state, std::span<const VkFormat> formats) {
  DenoiserInputs inputs;
  for (std::size_t i = 0; i < kHostInputs.size(); ++i) {
    const HostInput& input = kHostInputs[i];
    const VkFormat format = formats.empty() ? input.format : formats[i];
    requireInputFormat(input, format);
    inputs.*input.texture = graph.import(std::string(input.name), {.format = format, .extent = extent}, state);
  }
  inputs.frame = graph.upload(std::string(kFrameName), sizeof(FrameConstants));
  inputs.conventions = conventions;
  return inputs;
}

DenoiseGraph declareDenoiseGraph(Denoiser& method, fg::Extent extent, const InputConventions& conventions,
                                 const HostStates& states, std::span<const VkFormat> formats) {
  DenoiseGraph declared;
  fg::Graph& graph = declared.graph;
  declared.inputs = importInputs(graph, extent, conventions, states.inputs, formats);
  declared.output =
      graph.import(std::string(kOutputName), {.format = kOutputFormat, .extent = extent}, states.outputBefore);
  graph.exported(method.add(graph, declared.inputs, declared.output), states.outputAfter);
  return declared;
}

}  // namespace walr
