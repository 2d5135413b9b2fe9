#include "passes/ambient_occlusion.h"

#include <algorithm>

#include "shaders/constants/ambient_occlusion.h"
#include "shaders/shaders.h"

namespace walr {

fg::Texture addAmbientOcclusion(fg::Graph& graph, fg::Buffer frame, const Guides& guides,
                                const AmbientOcclusionSettings& settings, const TileLists* tiles) {
  const fg::Extent extent = graph.textureDesc(guides.depth).extent;
  const float radius = std::max(settings.radius * static_cast<float>(extent.height), 1.0F);

  fg::PassBuilder pass = graph.compute("ambient occlusion",
                                       tiles != nullptr ? shaders::ambientOcclusionListed : shaders::ambientOcclusion);
  pass.uniform("frameConstants", frame)
      .sample("depth", guides.depth)
      .sample("shadingNormal", guides.shadingNormal)
      .specialize("kSteps", settings.steps)
      .constants(AmbientOcclusionConstants{radius});
  if (tiles != nullptr) {
    dispatchTiles(pass, tiles->surfaces);
  } else {
    pass.dispatch(extent);
  }
  return pass.store("outOcclusion", graph.texture("occlusion", {VK_FORMAT_R8_UNORM, extent}));
}

}  // namespace walr
