#pragma once

#include <span>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "integration/host_inputs.h"
#include "integration/lights.h"
#include "passes/guides/convert_inputs.h"
#include "passes/methods/denoiser.h"
#include "passes/stage/inspection.h"

namespace walr {

/// A light to denoise, and what denoises it.
struct DenoisedLight {
  Denoiser* method;
  bool specular = false;  ///< See `InputConventions::specular`.
};

/// A graph that denoises one light, or several that share their guides, and nothing else. The host owns its textures.
struct DenoiseGraph {
  fg::Graph graph;
  /// Imports with the host's conventions: what all lights read, and the first one's light and confidence; `frame` is an
  /// upload.
  DenoiserInputs inputs;
  fg::Buffer host;                  ///< Upload of `HostConstants`; invalid if no input is converted.
  std::vector<LightImages> lights;  ///< In the order of the methods; at least one.
  std::vector<DebugView> views;     ///< The requested ones of all lights, in imports that receive them.
  Inspection inspection;            ///< Of the first light: its counters, and what it knows.
  fg::Buffer lint;                  ///< Import that receives the linter's counts; invalid unless requested.
};

/// Further outputs of a graph; views, counters and lint are for debugging. Counters are those of the first light, lint
/// those of the first and of specular light.
struct InspectionWish {
  std::span<const std::string> views = {};  ///< Names; those of another light begin with its `LightNames::settings`.
  bool counters = false;
  bool historyLength = false;   ///< Of every pixel and light, in `kHistoryLengthFormat`.
  bool lightDirection = false;  ///< Of every pixel and light, in `kLightDirectionFormat`; of the method walr.
  bool expectedError = false;   ///< Of every pixel and light, in `kExpectedErrorFormat`; of the method walr.
  bool lint = false;            ///< Count likely faults in the inputs: see `InputLinter`.
};

/// States of the host's textures before the graph, and of the result before and after it.
struct HostStates {
  fg::ExternalState inputs;
  fg::ExternalState outputBefore;
  fg::ExternalState outputAfter;
};

/// A host that writes the inputs and samples the result in compute shaders.
extern const HostStates kComputeHost;

/// Declare a host's textures as imports of a graph.
/// @param extent  of the image; the lighting may be smaller (`LightPattern`)
/// @param formats one per entry of `kHostInputs`, VK_FORMAT_UNDEFINED for an optional one that the host does not have;
///                empty: the usual formats, without the optional inputs
/// @param host    determines how many channels are read
/// @throws std::invalid_argument naming an input whose format cannot be used, or a pattern of light that is out of
///         range or that a host with a rectangle cannot have
DenoiserInputs importInputs(fg::Graph& graph, fg::Extent extent, const InputConventions& conventions,
                            const fg::ExternalState& state, std::span<const VkFormat> formats = {},
                            const HostConventions& host = {});

/// @throws std::invalid_argument naming what an orthographic camera does not allow
void checkOrthographic(const InputConventions& conventions, const HostConventions& host, bool lint);

/// Declare methods between the host's textures, one a light. The guides are prepared once for diffuse and once for
/// specular light, because pixels of other surfaces have these lobes. All else is each light's own, and its names begin
/// with those of `kLightNames`. All lights have textures of the same formats.
/// @param lights  1 to `kMostLights`, whose methods have their own settings
/// @param conventions without `specular`, which each light states
/// @param formats see `importInputs`
/// @param host    conventions of the textures; what differs from `DenoiserInputs` is converted first
/// @param wanted  further outputs, in imports with the states of the result
/// @throws std::invalid_argument naming a setting of a method that is out of range, an input whose format cannot be
///         used, or an unknown view, or saying why the lights cannot share guides
DenoiseGraph declareDenoiseGraph(std::span<const DenoisedLight> lights, fg::Extent extent,
                                 const InputConventions& conventions, const HostStates& states,
                                 std::span<const VkFormat> formats = {}, const HostConventions& host = {},
                                 const InspectionWish& wanted = {});
/// The same of one light, whose kind is stated by `conventions`.
DenoiseGraph declareDenoiseGraph(Denoiser& method, fg::Extent extent, const InputConventions& conventions,
                                 const HostStates& states, std::span<const VkFormat> formats = {},
                                 const HostConventions& host = {}, const InspectionWish& wanted = {});

}  // namespace walr
