#pragma once

#include <span>
#include <string>

#include "framegraph/declare/graph.h"
#include "integration/host_inputs.h"
#include "passes/guides/convert_inputs.h"
#include "passes/methods/denoiser.h"
#include "passes/stage/inspection.h"

namespace walr {

/// Imports of the second of two lights. They correspond to those of the first.
struct SecondLight {
  fg::Texture lighting;
  fg::Texture confidence;  ///< Invalid if the host has none.
  fg::Texture output;
  fg::Texture historyLength;   ///< Invalid unless requested.
  fg::Texture lightDirection;  ///< Invalid unless requested.
};

/// What the names of the second light's passes and textures begin with.
inline constexpr std::string_view kSecondPrefix = "second light: ";

/// A graph that denoises one light, or two that share their guides, and nothing else. The host owns its textures.
struct DenoiseGraph {
  fg::Graph graph;
  DenoiserInputs inputs;       ///< Imports with the host's conventions; `frame` is an upload.
  fg::Buffer host;             ///< Upload of `HostConstants`; invalid if no input is converted.
  fg::Texture output;          ///< Import that receives the result.
  Inspection inspection;       ///< The requested views and counters, in imports that receive them.
  fg::Texture historyLength;   ///< Import that receives history lengths; invalid unless requested.
  fg::Texture lightDirection;  ///< Import that receives slopes of the light over the normal; invalid unless requested.
  fg::Buffer lint;             ///< Import that receives the counts of `addLintInputs`; invalid unless requested.
  SecondLight second;          ///< All invalid if there is one light.
};

/// Further outputs of a graph; views, counters and lint are for debugging. Of two lights, all are those of the first.
struct InspectionWish {
  std::span<const std::string> views = {};  ///< Names of views.
  bool counters = false;
  bool historyLength = false;   ///< Of every pixel, in `kHistoryLengthFormat`.
  bool lightDirection = false;  ///< Of every pixel, in `kLightDirectionFormat`; of the method walr.
  bool lint = false;            ///< Count likely faults in the inputs: see `InputLinter`.
};

/// The second of two lights of a view, which share their guides.
struct SecondMethod {
  Denoiser* method = nullptr;   ///< With its own settings; null if there is one light.
  bool historyLength = false;   ///< As `InspectionWish::historyLength`.
  bool lightDirection = false;  ///< As `InspectionWish::lightDirection`.
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

/// Declare a method between the host's textures.
/// @param formats see `importInputs`
/// @param host    conventions of the textures; what differs from `DenoiserInputs` is converted first
/// @param wanted  further outputs, in imports with the states of the result
/// @param second  of two lights. The guides are prepared once. All else is the second light's own, and its names begin
///                with `kSecondPrefix`. Its textures have the formats of the first one's
/// @throws std::invalid_argument naming a setting of the method that is out of range, an input whose format cannot be
///         used, or an unknown view, or saying why the lights cannot share guides
DenoiseGraph declareDenoiseGraph(Denoiser& method, fg::Extent extent, const InputConventions& conventions,
                                 const HostStates& states, std::span<const VkFormat> formats = {},
                                 const HostConventions& host = {}, const InspectionWish& wanted = {},
                                 const SecondMethod& second = {});

}  // namespace walr
