#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "integration/denoise_graph.h"
#include "integration/registry.h"

namespace walr {

/// A port of a stage and the resource behind it.
struct StagePort {
  std::string name;
  bool output = false;
  std::uint32_t resource = fg::kNone;
};

/// A single stage alone in a graph. Its inputs are imports that go by the ports' names, as is the result `kOutputName`;
/// its other outputs are textures and histories of its own, which are exported.
struct SingleStage {
  fg::Graph graph;
  fg::Buffer frame;  ///< Upload of `FrameConstants`; invalid where the stage reads none.
  std::vector<StagePort> ports;
};

/// Formats of what is connected, by port.
using PortFormats = std::map<std::string, VkFormat, std::less<>>;

/// @param stage   settings and conventions as they are to be; nothing connected
/// @param extent  of all textures between stages
/// @param formats of inputs that are not of their port's usual format; optional inputs that are not named here are left
///                unconnected
/// @throws std::invalid_argument naming a port that is no input of the stage and those that are, a format that a port
///         does not take, or a setting that is out of range
SingleStage declareSingleStage(PassNode& stage, fg::Extent extent, const HostStates& states,
                               const PortFormats& formats);

}  // namespace walr
