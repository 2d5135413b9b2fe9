#pragma once

#include "passes/methods/denoiser.h"
#include "tests/passes/host_textures.h"
#include "tests/vulkan/test_device.h"

namespace walr::test {

/// A whole denoiser on a device, fed with host frames one by one.
class DenoiserRun {
 public:
  DenoiserRun(const fg::test::TestDevice& device, Denoiser& denoiser, glm::ivec2 size,
              const InputConventions& conventions = {}, bool specularMotion = false);

  /// Forget all histories.
  void reset() { run_->executor().resetAllHistory(); }
  /// Device memory of the graph, bytes.
  [[nodiscard]] std::uint64_t allocatedBytes() { return run_->executor().allocatedBytes(); }
  /// Denoise the next frame. rgb of the returned image is the result.
  reference::Image<glm::dvec4> frame(const reference::HostFrame& frame);

 private:
  glm::ivec2 size_;
  fg::Graph graph_;
  DenoiserInputs inputs_;
  fg::Texture output_;
  std::unique_ptr<fg::test::GraphRun> run_;
};

/// Root mean square difference of the colours over pixels that show a surface.
double surfaceError(const reference::Image<glm::dvec4>& result, const reference::HostFrame& truth);

}  // namespace walr::test
