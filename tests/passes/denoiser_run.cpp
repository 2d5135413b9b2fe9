#include "tests/passes/denoiser_run.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace walr::test {

DenoiserRun::DenoiserRun(const fg::test::TestDevice& device, Denoiser& denoiser, glm::ivec2 size,
                         const InputConventions& conventions, bool specularMotion)
    : size_(size),
      inputs_(importInputs(graph_, size, conventions, specularMotion)),
      output_(importOutput(graph_, size)) {
  graph_.exported(denoiser.add(graph_, inputs_, output_), fg::vk::kReadable);
  run_ = std::make_unique<fg::test::GraphRun>(device, graph_, fg::vk::ExecutorOptions{.shared = device.pipelines()});
}

reference::Image<glm::dvec4> DenoiserRun::frame(const reference::HostFrame& frame) {
  upload(*run_, inputs_, frame);
  run_->frame();
  return readHalves(*run_, output_, size_);
}

double surfaceError(const reference::Image<glm::dvec4>& result, const reference::HostFrame& truth) {
  double sum = 0.0;
  int count = 0;
  reference::forEachPixel(truth.size(), [&](glm::ivec2 p) {
    if (reference::surfaceAt(truth, p, {}).depth == 0.0) return;
    const glm::dvec3 difference = glm::dvec3(result[p]) - truth.lighting[p];
    sum += glm::dot(difference, difference) / 3.0;
    ++count;
  });
  return std::sqrt(sum / count);
}

}  // namespace walr::test
