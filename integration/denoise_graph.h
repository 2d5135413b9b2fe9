#pragma once

#include <span>
#include <string>

#include "framegraph/declare/graph.h"
#include "integration/host_inputs.h"
#include "passes/convert_inputs.h"
#include "passes/denoiser.h"
#include "passes/inspection.h"

namespace walr {

/// A method alone in a graph, with its textures owned by the host.
struct DenoiseGraph {
  fg::Graph graph;
  DenoiserInputs inputs;  ///< Imports, as the host writes them; `frame` is an upload.
  fg::Buffer host;        ///< Upload of `HostConstants`; invalid where the conventions need none.
  fg::Texture output;     ///< Import that receives the result.
  Inspection inspection;  ///< Views and counters asked for, in imports that receive them.
  fg::Buffer lint;        ///< Import that receives the counts of `addLintInputs`, where they were asked for.
};

/// What a host wants to see of a method's inner workings, and of its own inputs.
struct InspectionWish {
  std::span<const std::string> views = {};  ///< Names.
  bool counters = false;
  bool lint = false;  ///< Count what looks wrong in the inputs: see `InputLinter`.
};

/// States in which the host hands its textures over and takes the result back.
struct HostStates {
  fg::ExternalState inputs;
  fg::ExternalState outputBefore;
  fg::ExternalState outputAfter;
};

/// As a frame graph that computes the inputs and samples the result, all in compute shaders.
extern const HostStates kComputeHost;

/// Declare a host's textures as imports of a graph.
/// @param formats one per entry of `kHostInputs`, VK_FORMAT_UNDEFINED for an optional one that the host does not have;
///                empty for the usual ones of all that are not optional
/// @param host    says how many channels are read
/// @throws std::invalid_argument naming an input of a format that will not do
DenoiserInputs importInputs(fg::Graph& graph, fg::Extent extent, const InputConventions& conventions,
                            const fg::ExternalState& state, std::span<const VkFormat> formats = {},
                            const HostConventions& host = {});

/// @param formats as `importInputs` takes them
/// @param host    how the textures are written; what differs from `DenoiserInputs` is converted first
/// @param wanted  what to write of the method's inner workings as well, into imports that go the output's way
/// @throws std::invalid_argument naming a setting of the method that is out of range, an input of a format that will
///         not do, or a view that there is not
DenoiseGraph declareDenoiseGraph(Denoiser& method, fg::Extent extent, const InputConventions& conventions,
                                 const HostStates& states, std::span<const VkFormat> formats = {},
                                 const HostConventions& host = {}, const InspectionWish& wanted = {});

}  // namespace walr
