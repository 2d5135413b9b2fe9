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

/// A graph that holds one stage. Its inputs and the result `kOutputName` are imports with the names of the ports. Its
/// other outputs are the graph's own textures and histories, which are exported.
struct SingleStage {
  fg::Graph graph;
  fg::Buffer frame;  ///< Upload of `FrameConstants`; invalid if the stage does not read it.
  std::vector<StagePort> ports;
};

/// Formats of the connected textures, by port.
using PortFormats = std::map<std::string, VkFormat, std::less<>>;

/// Declare one stage.
/// @param stage   with its settings and conventions set and nothing connected
/// @param extent  size of all textures between stages
/// @param formats formats that differ from the port's usual one; optional inputs that are not listed stay unconnected
/// @throws std::invalid_argument naming a port that is not an input of the stage, and the inputs it has; a format that
///         a port does not accept; or a setting that is out of range
SingleStage declareSingleStage(PassNode& stage, fg::Extent extent, const HostStates& states,
                               const PortFormats& formats);

}  // namespace walr
