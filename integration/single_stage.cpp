#include "integration/single_stage.h"

#include <algorithm>
#include <stdexcept>

#include "integration/host_inputs.h"
#include "passes/settings/text.h"
#include "passes/stage/grid_extent.h"

namespace walr {
namespace {

void requireInputs(const std::vector<Port>& ports, const PortFormats& formats) {
  std::vector<std::string> inputs;
  for (const Port& port : ports) {
    if (!port.output && !port.buffer) inputs.push_back(port.name);
  }
  for (const auto& [name, format] : formats) {
    if (std::ranges::find(inputs, name) != inputs.end()) continue;
    throw std::invalid_argument("the stage has no input \"" + name + "\"; with these settings it has: " + join(inputs));
  }
}

}  // namespace

SingleStage declareSingleStage(PassNode& stage, fg::Extent extent, const HostStates& states,
                               const PortFormats& formats) {
  SingleStage declared;
  const std::vector<Port> ports = stage.ports();
  requireInputs(ports, formats);
  for (const Port& port : ports) {
    if (port.buffer) {
      declared.frame = declared.graph.upload(port.name, port.size);
      stage.connect(port.name, declared.frame);
      continue;
    }
    const auto format = formats.find(port.name);
    const bool given = format != formats.end();
    if (port.output ? port.name != kOutputName : port.optional && !given) continue;
    const fg::TextureDesc desc{.format = given ? format->second : port.format, .extent = gridExtent(extent, port.tile)};
    const fg::Texture texture =
        declared.graph.import(port.name, desc, port.output ? states.outputBefore : states.inputs);
    stage.connect(port.name, texture);
    if (!port.output) declared.ports.push_back({port.name, false, texture.resource});
  }
  for (const auto& [name, texture] : stage.add(declared.graph).textures) {
    declared.ports.push_back({name, true, texture.resource});
    const bool written = texture.version > 0;  // False for a previous history, which later stages read.
    if (written) declared.graph.exported(texture, states.outputAfter);
  }
  return declared;
}

}  // namespace walr
