#include "integration/denoise_graph.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "passes/conventions/light_direction.h"
#include "passes/guides/shared_guides.h"
#include "passes/lint/lint_inputs.h"
#include "passes/lint/lint_specular.h"
#include "passes/stage/expected_error.h"
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

/// Whether a graph with these kinds of light has the input.
bool reads(LightKinds kinds, const HostInput& input) {
  if (input.of == HostInput::Of::EveryLight) return true;
  return input.of == HostInput::Of::DiffuseLight ? kinds.diffuse : kinds.specular;
}

/// The number of channels of an input that are read.
std::uint32_t channelsRead(const HostInput& input, const InputConventions& conventions, const HostConventions& host) {
  const bool flatMotion = conventions.motionDepth != InputConventions::MotionDepth::Given;
  const bool twoChannels = (input.texture == &DenoiserInputs::motion && flatMotion) ||
                           (input.texture == &DenoiserInputs::normal && host.octahedral());
  return twoChannels ? 2 : input.channels;
}

/// `importInputs` for several lights.
DenoiserInputs importAll(fg::Graph& graph, fg::Extent extent, const InputConventions& conventions, LightKinds kinds,
                         const fg::ExternalState& state, std::span<const VkFormat> formats,
                         const HostConventions& host) {
  checkLight(conventions.light, host);
  DenoiserInputs inputs;
  for (std::size_t i = 0; i < kHostInputs.size(); ++i) {
    const HostInput& input = kHostInputs[i];
    if (!reads(kinds, input)) continue;
    const VkFormat usual = input.optional ? VK_FORMAT_UNDEFINED : input.format;
    const VkFormat format = formats.empty() ? usual : formats[i];
    if (input.optional && format == VK_FORMAT_UNDEFINED) continue;
    const bool isLight = input.texture == &DenoiserInputs::lighting;
    if (isLight) {
      requireLightFormat(input, format, conventions.light, kinds.specular);
    } else {
      requireInputFormat(input, format, channelsRead(input, conventions, host));
    }
    const fg::Extent size = isLight ? conventions.light.lightingExtent(extent) : extent;
    inputs.*input.texture = graph.import(std::string(input.name), {.format = format, .extent = size}, state);
  }
  inputs.frame = graph.upload(std::string(kFrameName), sizeof(FrameConstants));
  inputs.conventions = conventions;
  inputs.scene.resizing = host.rectangle;
  return inputs;
}

}  // namespace

DenoiserInputs importInputs(fg::Graph& graph, fg::Extent extent, const InputConventions& conventions,
                            const fg::ExternalState& state, std::span<const VkFormat> formats,
                            const HostConventions& host) {
  const LightKinds kinds{.diffuse = !conventions.specular, .specular = conventions.specular};
  return importAll(graph, extent, conventions, kinds, state, formats, host);
}

void checkOrthographic(const InputConventions& conventions, const HostConventions& host, bool lint) {
  if (!host.orthographic) return;
  if (conventions.specular) {
    throw std::invalid_argument(
        "specular light needs a perspective camera: its mirror images are computed from the eye");
  }
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

/// What all lights of a graph have in common.
struct Declaring {
  const HostStates& states;
  const HostConventions& host;
  const InspectionWish& wanted;
};

/// A texture of the host that receives a result.
fg::Texture importResult(fg::Graph& graph, const std::string& name, VkFormat format, fg::Extent extent,
                         const HostStates& states) {
  return graph.import(name, {.format = format, .extent = extent}, states.outputBefore);
}

/// Import the textures of the host that receive the results of a light.
void importResults(fg::Graph& graph, LightImages& light, const LightNames& names, fg::Extent extent,
                   const Declaring& all) {
  const auto import = [&](std::string_view name, VkFormat format) {
    return importResult(graph, std::string(names.images).append(name), format, extent, all.states);
  };
  light.output = import(kOutputName, all.host.result);
  if (all.wanted.historyLength) light.historyLength = import(kHistoryLengthName, kHistoryLengthFormat);
  if (all.wanted.lightDirection) light.lightDirection = import(kLightDirectionName, kLightDirectionFormat);
  if (all.wanted.expectedError) light.expectedError = import(kExpectedErrorName, kExpectedErrorFormat);
}

/// The images of a light after the first, which have the formats of the first one's.
LightImages importLight(fg::Graph& graph, const LightImages& first, const LightNames& names, fg::Extent extent,
                        const Declaring& all) {
  const auto import = [&](std::string_view name, fg::Texture alike) {
    return graph.import(std::string(names.images).append(name), graph.textureDesc(alike), all.states.inputs);
  };
  LightImages light;
  light.lighting = import(kLightingName, first.lighting);
  if (first.confidence.valid()) light.confidence = import(kConfidenceName, first.confidence);
  importResults(graph, light, names, extent, all);
  return light;
}

/// Add the passes of a light from its converted inputs to the host's results.
void addLight(DenoiseGraph& declared, Denoiser& method, const DenoiserInputs& inputs, const LightImages& to,
              Inspection& inspection, const SharedLight& light, const Declaring& all) {
  fg::Graph& graph = declared.graph;
  const fg::TextureDesc result{.format = kOutputFormat, .extent = graph.textureDesc(to.output).extent};
  const StageGraph stages(graph, inspection, light);
  const fg::Texture target = all.host.convertsResult() ? stages.texture("result to convert", result) : to.output;
  if (to.historyLength.valid()) inspection.wantHistoryLength(to.historyLength);
  if (to.lightDirection.valid()) inspection.wantLightDirection(to.lightDirection);
  if (to.expectedError.valid()) inspection.wantExpectedError(to.expectedError);
  fg::Texture denoised = method.add(stages, inputs, target);
  if (to.historyLength.valid()) graph.exported(inspection.historyLength(), all.states.outputAfter);
  if (to.lightDirection.valid()) graph.exported(inspection.lightDirection(), all.states.outputAfter);
  if (to.expectedError.valid()) graph.exported(inspection.expectedError(), all.states.outputAfter);
  if (all.host.convertsResult()) denoised = addConvertResult(stages, denoised, to.output, declared.host);
  graph.exported(denoised, all.states.outputAfter);
}

/// Import what receives the views of a light.
/// @param lights how many there are
void wantViews(fg::Graph& graph, Inspection& inspection, std::size_t light, std::size_t lights, fg::Extent extent,
               const Declaring& all) {
  for (const std::string& view : all.wanted.views) {
    const OwnName own = withoutLight(view, lights);
    if (own.light.value_or(0) != light) continue;
    inspection.want(std::string(own.name), importResult(graph, "view of " + view, kViewFormat, extent, all.states));
  }
}

/// Export the views of a light.
void keepViews(DenoiseGraph& declared, const Inspection& inspection, const LightNames& names, const Declaring& all) {
  for (DebugView view : inspection.views()) {
    declared.graph.exported(view.texture, all.states.outputAfter);
    view.name.insert(0, names.settings);
    declared.views.push_back(std::move(view));
  }
}

/// Import what receives counters and the linter's counts, and add the linter's passes.
void declareCounts(DenoiseGraph& declared, const DenoiserInputs& inputs, const Declaring& all) {
  fg::Graph& graph = declared.graph;
  if (all.wanted.counters) {
    declared.inspection.wantCounters(graph.import("counters", fg::BufferDesc{kCounterBytes}, all.states.outputBefore));
  }
  if (all.wanted.lint) {
    const fg::Buffer counts = graph.import("lint counters", fg::BufferDesc{kLintBytes}, all.states.outputBefore);
    declared.lint = addLintInputs(graph, inputs, counts);
  }
}

/// Add the linter's pass for specular light, if there is any.
/// @param own the converted inputs of each light
void lintSpecular(DenoiseGraph& declared, std::span<const DenoiserInputs> own) {
  const auto isSpecular = [](const DenoiserInputs& inputs) { return inputs.conventions.specular; };
  const auto specular = std::ranges::find_if(own, isSpecular);
  if (specular == own.end()) return;
  const auto diffuse = std::ranges::find_if_not(own, isSpecular);
  const bool compared = diffuse != own.end() && diffuse->conventions.light.fullSize();
  declared.lint = addLintSpecular(
      declared.graph, {.inputs = *specular, .diffuse = compared ? diffuse->lighting : fg::Texture{}}, declared.lint);
}

}  // namespace

DenoiseGraph declareDenoiseGraph(std::span<const DenoisedLight> lights, fg::Extent extent,
                                 const InputConventions& conventions, const HostStates& states,
                                 std::span<const VkFormat> formats, const HostConventions& host,
                                 const InspectionWish& wanted) {
  if (lights.empty() || lights.size() > kMostLights) {
    throw std::invalid_argument("a graph of " + std::to_string(lights.size()) + " lights: it takes 1 to " +
                                std::to_string(kMostLights));
  }
  const auto specular = static_cast<std::size_t>(std::ranges::count(lights, true, &DenoisedLight::specular));
  const LightKinds kinds{.diffuse = (specular < lights.size()), .specular = (specular > 0)};
  InputConventions stated = conventions;
  stated.specular = kinds.specular;
  checkOrthographic(stated, host, wanted.lint);
  stated.specular = lights.front().specular;
  stated.orthographic = host.orthographic;
  const Declaring all{states, host, wanted};
  DenoiseGraph declared;
  fg::Graph& graph = declared.graph;
  declared.inputs = importAll(graph, extent, stated, kinds, states.inputs, formats, host);
  if (host.differs()) declared.host = graph.upload(std::string(kHostName), sizeof(HostConstants));
  LightImages& first = declared.lights.emplace_back();
  first.lighting = declared.inputs.lighting;
  first.confidence = declared.inputs.confidence;
  importResults(graph, first, kLightNames.front(), extent, all);
  const DenoiserInputs inputs = addConvertInputs(graph, declared.inputs, host, declared.host);
  wantViews(graph, declared.inspection, 0, lights.size(), extent, all);
  declareCounts(declared, inputs, all);

  std::array<SharedGuides, 2> guides;  // Of diffuse and of specular light.
  const auto sharedBy = [&](const DenoisedLight& light, std::string_view prefix) {
    const bool alone = std::ranges::count(lights, light.specular, &DenoisedLight::specular) == 1;
    return SharedLight{.guides = alone ? nullptr : &guides.at(light.specular ? 1 : 0), .prefix = prefix};
  };
  addLight(declared, *lights.front().method, inputs, first, declared.inspection, sharedBy(lights.front(), {}), all);
  keepViews(declared, declared.inspection, kLightNames.front(), all);
  if (!declared.inspection.counters().empty()) {
    graph.exported(declared.inspection.counterBuffer(), states.outputAfter);
  }
  std::vector<DenoiserInputs> converted{inputs};
  for (std::size_t i = 1; i < lights.size(); ++i) {
    const LightNames& names = kLightNames.at(i);
    const LightImages light = importLight(graph, declared.lights.front(), names, extent, all);
    const SharedLight shared = sharedBy(lights[i], names.passes);
    Inspection inspection;
    wantViews(graph, inspection, i, lights.size(), extent, all);
    DenoiserInputs own = inputs;
    own.lighting = light.lighting;
    own.confidence = light.confidence;
    own.conventions.specular = lights[i].specular;
    own = addConvertLight({graph, inspection, shared}, own, host, declared.host);
    converted.push_back(own);
    addLight(declared, *lights[i].method, own, light, inspection, shared, all);
    keepViews(declared, inspection, names, all);
    declared.lights.push_back(light);
  }
  if (wanted.lint) {
    lintSpecular(declared, converted);
    graph.exported(declared.lint, states.outputAfter);
  }
  return declared;
}

DenoiseGraph declareDenoiseGraph(Denoiser& method, fg::Extent extent, const InputConventions& conventions,
                                 const HostStates& states, std::span<const VkFormat> formats,
                                 const HostConventions& host, const InspectionWish& wanted) {
  const DenoisedLight lights[] = {{&method, conventions.specular}};
  return declareDenoiseGraph(lights, extent, conventions, states, formats, host, wanted);
}

}  // namespace walr
