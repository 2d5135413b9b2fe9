#include "passes/lint/lint_inputs.h"

#include "passes/stage/inspection.h"
#include "shaders/shaders.h"

namespace walr {

static_assert(kLintWords <= kCounterWords);

fg::Buffer addLintInputs(fg::Graph& graph, const DenoiserInputs& inputs, fg::Buffer counters) {
  fg::PassBuilder clear = graph.compute("clear lint counters", shaders::countClear);
  clear.dispatch({1, 1});
  counters = clear.store("counters", counters);
  const fg::Extent extent = graph.textureDesc(inputs.depth).extent;
  fg::PassBuilder pass = graph.compute("lint inputs", shaders::lintInputs);
  pass.uniform("frameConstants", inputs.frame)
      .sample("lighting", inputs.lighting)
      .sample("depth", inputs.depth)
      .sample("normal", inputs.normal)
      .sample("motion", inputs.motion)
      .sample("albedo", inputs.albedo)
      .specialize("kNormalsInWorldSpace", inputs.conventions.normal == InputConventions::Space::World)
      .specialize("kMotionDepthGiven", inputs.conventions.motionDepth == InputConventions::MotionDepth::Given)
      .specialize("kMotionJittered", inputs.conventions.motionJittered)
      .dispatch(extent);
  if (inputs.conventions.light.fullSize()) pass.texels(extent);
  specializeLight(pass, inputs.conventions.light);
  return pass.update("counters", counters);
}

void LintCounts::add(std::span<const std::uint32_t> words, bool afterAnother) {
  const bool moves = 10 * std::uint64_t(words[kLintStillMoves]) > words[kLintStillTested];
  for (std::uint32_t word = 0; word < kLintWords; ++word) {
    const bool aboutMotion = word >= kLintMotionX && word < kLintNormalTested;
    const bool aboutStillness = word >= kLintStillTested && word <= kLintStillMovesAlike;
    if ((aboutMotion && !afterAnother) || (aboutStillness && !moves)) continue;
    sums_[word] += words[word];
  }
}

}  // namespace walr
