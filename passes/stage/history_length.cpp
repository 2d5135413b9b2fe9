#include "passes/stage/history_length.h"

#include "shaders/shaders.h"

namespace walr {

fg::Texture addHistoryLength(StageGraph graph, fg::Texture accumulated, std::uint32_t channel, fg::Texture target,
                             const LightPattern& groups) {
  const bool packed = graph.textureDesc(accumulated).format == VK_FORMAT_R32_UINT;
  fg::PassBuilder pass = graph.compute("history length", shaders::historyLength({.packed = packed}));
  pass.sample("accumulated", accumulated)
      .specialize("kColumns", groups.columns)
      .specialize("kRows", groups.rows)
      .dispatch(graph.textureDesc(target).extent);
  if (!packed) pass.specialize("kChannel", channel);
  return pass.store("historyLength", target);
}

}  // namespace walr
