#pragma once

#include <optional>
#include <vector>

#include "passes/lint/input_linter.h"
#include "tests/passes/host_textures.h"
#include "tests/vulkan/test_device.h"

namespace walr::test {

/// A frame that the linter looks at.
struct HostInput {
  reference::HostFrame frame = {};
  FrameDescription camera = {};
  bool continues = false;  ///< Whether its history is not reset.
};

/// Runs the linter on a device.
class LintRun {
 public:
  LintRun(const fg::test::TestDevice& device, glm::ivec2 size, const LightPattern& light = {}) : size_(size) {
    inputs_ = importInputs(graph_, size, {.light = light});
    counters_ =
        addLintInputs(graph_, inputs_, graph_.import("counters", fg::BufferDesc{kLintBytes}, fg::vk::kOverwritable));
    graph_.exported(counters_, fg::vk::kReadable);
    run_.emplace(device, graph_, fg::vk::ExecutorOptions{.shared = device.pipelines()});
  }

  /// Findings in a sequence.
  std::vector<LintFinding> lint(const std::vector<HostInput>& frames, const InputConventions& conventions) {
    InputLinter linter(conventions);
    for (const HostInput& host : frames) {
      upload(*run_, inputs_, host.frame);
      const std::uint32_t slot = run_->submitFrame();
      run_->finish();
      linter.add(run_->elements<std::uint32_t>(counters_, slot), host.camera,
                 {static_cast<std::uint32_t>(size_.x), static_cast<std::uint32_t>(size_.y)}, host.continues);
    }
    return linter.findings();
  }

 private:
  glm::ivec2 size_;
  fg::Graph graph_;
  DenoiserInputs inputs_;
  fg::Buffer counters_;
  std::optional<fg::test::GraphRun> run_;
};

}  // namespace walr::test
