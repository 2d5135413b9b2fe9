#include "passes/guides/object_ids.h"

#include "shaders/shaders.h"

namespace walr {

ObjectIds addObjectIds(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides) {
  const fg::Extent extent = graph.textureDesc(inputs.objectId).extent;
  const fg::History objects = graph.history("objects", {VK_FORMAT_R32_UINT, extent});
  fg::PassBuilder pass = graph.compute("keep object ids", shaders::objectIds);
  pass.sample("depth", guides.depth).sample("objectId", inputs.objectId).texels(extent).dispatch(extent);
  return {.current = pass.store("outObjects", objects.current), .previous = objects.previous};
}

}  // namespace walr
