#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "passes/methods/denoiser.h"
#include "tests/passes/host_textures.h"
#include "tests/vulkan/test_device.h"

namespace walr::test {

/// A method on a device with all its counters, and optionally some of its views.
class CountedRun {
 public:
  using Counts = std::map<std::string, std::uint64_t>;

  CountedRun(const fg::test::TestDevice& device, Denoiser& method, glm::ivec2 size,
             const std::vector<std::string>& views = {});

  /// Submit a frame without waiting for it.
  std::uint32_t submit(const reference::HostFrame& frame);
  void finish() { run_->finish(); }
  /// Denoise a frame.
  Counts count(const reference::HostFrame& frame);
  /// The counters of the last frame that was submitted to a slot.
  [[nodiscard]] Counts counters(std::uint32_t slot) const;
  void reset() { run_->executor().resetAllHistory(); }
  [[nodiscard]] reference::Image<glm::dvec4> output() const { return readHalves(*run_, output_, size_); }
  /// Sum of a component of a view over the image.
  [[nodiscard]] double viewSum(std::size_t view, int component) const;
  /// Expect every counter of the requested views to be the sum of its view's component.
  void expectSumsOfViews(const Counts& counted) const;
  [[nodiscard]] const Inspection& inspection() const { return inspection_; }

 private:
  glm::ivec2 size_;
  fg::Graph graph_;
  DenoiserInputs inputs_;
  fg::Texture output_;
  Inspection inspection_;
  std::unique_ptr<fg::test::GraphRun> run_;
};

}  // namespace walr::test
