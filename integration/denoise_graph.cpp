#include "integration/denoise_graph.h"

#include <stdexcept>
#include <string>

#include "passes/conventions/light_direction.h"
#include "passes/guides/shared_guides.h"
#include "passes/lint/lint_inputs.h"
#include "passes/stage/history_length.h"
#include "shaders/conventions/frame.h"

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
  if (input.texture == &DenoiserInputs::lighting && conventions.light.hasAlpha()) return 4;
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

namespace {

/// A texture of the host that receives a result.
fg::Texture importResult(fg::Graph& graph, std::string_view name, VkFormat format, fg::Extent extent,
                         const HostStates& states) {
  return graph.import(std::string(name), {.format = format, .extent = extent}, states.outputBefore);
}

SecondLight importSecond(fg::Graph& graph, const DenoiserInputs& first, fg::Texture firstOutput,
                         const HostStates& states, const SecondMethod& wanted) {
  const fg::TextureDesc result = graph.textureDesc(firstOutput);
  SecondLight second;
  second.lighting = graph.import(std::string(kSecondLightingName), graph.textureDesc(first.lighting), states.inputs);
  if (first.confidence.valid()) {
    second.confidence =
        graph.import(std::string(kSecondConfidenceName), graph.textureDesc(first.confidence), states.inputs);
  }
  second.output = importResult(graph, kSecondOutputName, result.format, result.extent, states);
  if (wanted.historyLength) {
    second.historyLength = importResult(graph, kSecondHistoryLengthName, kHistoryLengthFormat, result.extent, states);
  }
  if (wanted.lightDirection) {
    second.lightDirection =
        importResult(graph, kSecondLightDirectionName, kLightDirectionFormat, result.extent, states);
  }
  return second;
}

/// What `addLight` works on beside the light.
struct LightTarget {
  fg::Texture output;
  fg::Texture historyLength;   ///< Invalid unless requested.
  fg::Texture lightDirection;  ///< Invalid unless requested.
};

/// Add the passes of a light from its converted inputs to the host's results.
void addLight(DenoiseGraph& declared, Denoiser& method, const DenoiserInputs& inputs, const LightTarget& to,
              Inspection& inspection, const SharedLight& light, const HostStates& states, const HostConventions& host) {
  fg::Graph& graph = declared.graph;
  const fg::TextureDesc result{.format = kOutputFormat, .extent = graph.textureDesc(to.output).extent};
  const StageGraph stages(graph, inspection, light);
  const fg::Texture target = host.convertsResult() ? stages.texture("result to convert", result) : to.output;
  if (to.historyLength.valid()) inspection.wantHistoryLength(to.historyLength);
  if (to.lightDirection.valid()) inspection.wantLightDirection(to.lightDirection);
  fg::Texture denoised = method.add(stages, inputs, target);
  if (to.historyLength.valid()) graph.exported(inspection.historyLength(), states.outputAfter);
  if (to.lightDirection.valid()) graph.exported(inspection.lightDirection(), states.outputAfter);
  if (host.convertsResult()) denoised = addConvertResult(stages, denoised, to.output, declared.host);
  graph.exported(denoised, states.outputAfter);
}

}  // namespace

DenoiseGraph declareDenoiseGraph(Denoiser& method, fg::Extent extent, const InputConventions& conventions,
                                 const HostStates& states, std::span<const VkFormat> formats,
                                 const HostConventions& host, const InspectionWish& wanted,
                                 const SecondMethod& second) {
  checkOrthographic(conventions, host, wanted.lint);
  DenoiseGraph declared;
  fg::Graph& graph = declared.graph;
  declared.inputs = importInputs(graph, extent, conventions, states.inputs, formats, host);
  if (host.differs()) declared.host = graph.upload(std::string(kHostName), sizeof(HostConstants));
  declared.output = importResult(graph, kOutputName, host.result, extent, states);
  const DenoiserInputs inputs = addConvertInputs(graph, declared.inputs, host, declared.host);

  Inspection& inspection = declared.inspection;
  for (const std::string& view : wanted.views) {
    inspection.want(view, importResult(graph, "view of " + view, kViewFormat, extent, states));
  }
  if (wanted.historyLength) {
    declared.historyLength = importResult(graph, kHistoryLengthName, kHistoryLengthFormat, extent, states);
  }
  if (wanted.lightDirection) {
    declared.lightDirection = importResult(graph, kLightDirectionName, kLightDirectionFormat, extent, states);
  }
  if (wanted.counters) {
    inspection.wantCounters(graph.import("counters", fg::BufferDesc{kCounterBytes}, states.outputBefore));
  }
  if (wanted.lint) {
    const fg::Buffer counts = graph.import("lint counters", fg::BufferDesc{kCounterBytes}, states.outputBefore);
    declared.lint = addLintInputs(graph, inputs, counts);
    graph.exported(declared.lint, states.outputAfter);
  }

  SharedGuides guides;
  addLight(declared, method, inputs, {declared.output, declared.historyLength, declared.lightDirection}, inspection,
           {.guides = second.method != nullptr ? &guides : nullptr}, states, host);
  for (const DebugView& view : inspection.views()) graph.exported(view.texture, states.outputAfter);
  if (!inspection.counters().empty()) graph.exported(inspection.counterBuffer(), states.outputAfter);
  if (second.method == nullptr) return declared;

  declared.second = importSecond(graph, declared.inputs, declared.output, states, second);
  Inspection secondInspection;
  const SharedLight light{.guides = &guides, .prefix = kSecondPrefix};
  DenoiserInputs secondInputs = inputs;
  secondInputs.lighting = declared.second.lighting;
  secondInputs.confidence = declared.second.confidence;
  secondInputs = addConvertLight({graph, secondInspection, light}, secondInputs, host, declared.host);
  addLight(declared, *second.method, secondInputs,
           {declared.second.output, declared.second.historyLength, declared.second.lightDirection}, secondInspection,
           light, states, host);
  return declared;
}

}  // namespace walr
