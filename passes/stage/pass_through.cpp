#include "passes/stage/pass_through.h"

#include "shaders/shaders.h"

namespace walr {

fg::Texture addPassThrough(StageGraph graph, fg::Texture lighting, fg::Texture output) {
  fg::PassBuilder pass = graph.compute("pass through", shaders::passThrough);
  pass.sample("lighting", lighting).dispatch(graph.textureDesc(lighting).extent);
  return pass.store("outImage", output);
}

}  // namespace walr
