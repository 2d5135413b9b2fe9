#include "passes/stage/expected_error.h"

#include <string>
#include <vector>

#include "shaders/shaders.h"

namespace walr {

void offerExpectedError(StageGraph graph, fg::Texture accumulated, fg::Texture result) {
  static const std::vector<ViewInfo> kViews{
      {"expected-error", "Expected error of the tile, contrast around the pixel, size of the residual there"}};
  const fg::Extent extent = graph.textureDesc(result).extent;
  const auto declare = [&](const std::string& name, const fg::Shader& shader) {
    fg::PassBuilder pass = graph.compute(name, shader);
    pass.sample("accumulated", accumulated).load("result", result).dispatch(extent);
    return pass;
  };
  graph.offer(kViews, extent, [&](const std::string& name) { return declare(name, shaders::expectedErrorView); });
  graph.offerExpectedError([&](const std::string& name) { return declare(name, shaders::expectedError); });
}

}  // namespace walr
