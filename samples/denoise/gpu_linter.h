#pragma once

#include <memory>
#include <vector>

#include "framegraph/declare/graph.h"
#include "passes/lint/lint_finding.h"
#include "samples/denoise/gpu_device.h"
#include "samples/sequence/frame.h"
#include "samples/sequence/layout.h"

namespace walr {

/// Checks the frames of a sequence on a Vulkan device: diffuse light, and specular light if the first frame has it.
class GpuLinter {
 public:
  /// @param device must outlive this
  /// @param layout conventions of the frames; must outlive this
  GpuLinter(const GpuDevice& device, fg::Extent extent, const Layout& layout);
  ~GpuLinter();
  GpuLinter(GpuLinter&&) noexcept;
  GpuLinter& operator=(GpuLinter&&) noexcept;

  /// Check the next frame. All frames must have the same images.
  /// @throws InputError naming a frame whose camera is not usable; fg::vk::Error if the device fails, or lacks
  /// something
  ///         that the graph needs
  void add(const Frame& frame);

  /// See `InputLinter::findings`.
  [[nodiscard]] std::vector<LintFinding> findings() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace walr
