#include "integration/denoise_graph.h"

#include <stdexcept>
#include <string>

#include "passes/history_length.h"
#include "passes/light_direction.h"
#include "passes/lint_inputs.h"
#include "shaders/constants/frame.h"

namespace walr {

const HostStates kComputeHost{
    .inputs = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL},
    .outputBefore = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_UNDEFINED},
    .outputAfter = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
};

namespace {

/// @throws std::invalid_argument naming a pattern of light that is out of range or that a host cannot have
void checkLight(const LightPattern& light, const HostConventions& host) {
  checkLightPattern(light);
  if (host.rectangle && !light.fullSize()) {
    throw std::invalid_argument(
        "a rectangle of the images is denoised, and texels of light stand for several pixels: only one of the two is "
        "possible; use light of the images' size with a mask");
  }
}

/// The number of channels of an input that are read.
std::uint32_t channelsRead(const HostInput& input, const InputConventions& conventions, const HostConventions& host) {
  const bool flatMotion = conventions.motionDepth != InputConventions::MotionDepth::Given;
  if (input.texture == &DenoiserInputs::lighting && conventions.light.masked) return 4;
  const bool twoChannels = (input.texture == &DenoiserInputs::motion && flatMotion) ||
                           (input.texture == &DenoiserInputs::normal && host.octahedral());
  return twoChannels ? 2 : input.channels;
}

}  // namespace

DenoiserInputs importInputs(fg::Graph& graph, fg::Extent extent, const InputConventions& conventions,
                            const fg::ExternalState& state, std::span<const VkFormat> formats,
                            const HostConventions& host) {
  checkLight(conventions.light, host);
  DenoiserInputs inputs;
  for (std::size_t i = 0; i < kHostInputs.size(); ++i) {
    const HostInput& input = kHostInputs[i];
    const VkFormat usual = input.optional ? VK_FORMAT_UNDEFINED : input.format;
    const VkFormat format = formats.empty() ? usual : formats[i];
    if (input.optional && format == VK_FORMAT_UNDEFINED) continue;
    requireInputFormat(input, format, channelsRead(input, conventions, host));
    const bool isLight = input.texture == &DenoiserInputs::lighting;
    const fg::Extent size = isLight ? conventions.light.lightingExtent(extent) : extent;
    inputs.*input.texture = graph.import(std::string(input.name), {.format = format, .extent = size}, state);
  }
  inputs.frame = graph.upload(std::string(kFrameName), sizeof(FrameConstants));
  inputs.conventions = conventions;
  inputs.scene.resizing = host.rectangle;
  return inputs;
}

void checkOrthographic(const InputConventions& conventions, const HostConventions& host, bool lint) {
  if (!host.orthographic) return;
  if (conventions.motionDepth == InputConventions::MotionDepth::StaticScene) {
    throw std::invalid_argument(
        "an orthographic camera needs the third channel of motion: motion depth of a static scene is computed for "
        "perspective cameras only");
  }
  if (lint) {
    throw std::invalid_argument(
        "the linter checks inputs of perspective cameras only: check them with a perspective camera, and switch lint "
        "off for the orthographic one");
  }
}

DenoiseGraph declareDenoiseGraph(Denoiser& method, fg::Extent extent, const InputConventions& conventions,
                                 const HostStates& states, std::span<const VkFormat> formats,
                                 const HostConventions& host, const InspectionWish& wanted) {
  checkOrthographic(conventions, host, wanted.lint);
  DenoiseGraph declared;
  fg::Graph& graph = declared.graph;
  const fg::TextureDesc result{.format = kOutputFormat, .extent = extent};
  const fg::TextureDesc hostResult{.format = host.result, .extent = extent};
  declared.inputs = importInputs(graph, extent, conventions, states.inputs, formats, host);
  if (host.convertsInputs()) declared.host = graph.upload(std::string(kHostName), sizeof(HostConstants));
  declared.output = graph.import(std::string(kOutputName), hostResult, states.outputBefore);

  const DenoiserInputs inputs = addConvertInputs(graph, declared.inputs, host, declared.host);
  const fg::Texture target = host.convertsResult() ? graph.texture("result to convert", result) : declared.output;
  Inspection& inspection = declared.inspection;
  for (const std::string& view : wanted.views) {
    inspection.want(view,
                    graph.import("view of " + view, {.format = kViewFormat, .extent = extent}, states.outputBefore));
  }
  if (wanted.historyLength) {
    declared.historyLength = graph.import(std::string(kHistoryLengthName),
                                          {.format = kHistoryLengthFormat, .extent = extent}, states.outputBefore);
    inspection.wantHistoryLength(declared.historyLength);
  }
  if (wanted.lightDirection) {
    declared.lightDirection = graph.import(std::string(kLightDirectionName),
                                           {.format = kLightDirectionFormat, .extent = extent}, states.outputBefore);
    inspection.wantLightDirection(declared.lightDirection);
  }
  if (wanted.counters) {
    inspection.wantCounters(graph.import("counters", fg::BufferDesc{kCounterBytes}, states.outputBefore));
  }
  if (wanted.lint) {
    const fg::Buffer counts = graph.import("lint counters", fg::BufferDesc{kCounterBytes}, states.outputBefore);
    declared.lint = addLintInputs(graph, inputs, counts);
    graph.exported(declared.lint, states.outputAfter);
  }
  fg::Texture denoised = method.add({graph, inspection}, inputs, target);
  for (const DebugView& view : inspection.views()) graph.exported(view.texture, states.outputAfter);
  if (wanted.historyLength) graph.exported(inspection.historyLength(), states.outputAfter);
  if (wanted.lightDirection) graph.exported(inspection.lightDirection(), states.outputAfter);
  if (!inspection.counters().empty()) graph.exported(inspection.counterBuffer(), states.outputAfter);
  if (host.convertsResult()) denoised = addConvertResult(graph, denoised, declared.output, declared.host);
  graph.exported(denoised, states.outputAfter);
  return declared;
}

}  // namespace walr
