#pragma once

#include "framegraph/graph.h"
#include "passes/denoiser.h"

namespace walr {

/// A method alone in a graph, with its textures owned by the host.
struct DenoiseGraph {
  fg::Graph graph;
  DenoiserInputs inputs;  ///< Imports; `frame` is an upload.
  fg::Texture output;     ///< Import that receives the result.
};

/// States in which the host hands its textures over and takes the result back.
struct HostStates {
  fg::ExternalState inputs;
  fg::ExternalState outputBefore;
  fg::ExternalState outputAfter;
};

/// As a frame graph that computes the inputs and samples the result, all in compute shaders.
extern const HostStates kComputeHost;

/// @throws std::invalid_argument naming a setting of the method that is out of range
DenoiseGraph declareDenoiseGraph(Denoiser& method, fg::Extent extent, const InputConventions& conventions,
                                 const HostStates& states);

}  // namespace walr
