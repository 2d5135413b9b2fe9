#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/passes/any_walr.h"
#include "tests/passes/reference/atrous.h"
#include "tests/vulkan/graph_run.h"
#include "tests/vulkan/test_device.h"

namespace walr::test {

/// Results of every stage of WALR in one frame on the device.
struct WalrStages {
  reference::Image<reference::Guide> guides;
  reference::Image<glm::dvec4> accumulated;  ///< rgb: mean; a: number of samples.
  bool onLightGrid = false;                  ///< Only pixels with a sample of sparse light have a mean.
  reference::Image<glm::dvec2>
      antilagTiles;                  ///< Per tile, sum and sum of squares of differences; empty without antilag.
  reference::Image<double> antilag;  ///< Antilag factor per tile; empty without antilag.
  std::vector<reference::AtrousState> iterations;  ///< After each iteration but the last; over pixels.
  reference::Image<glm::dvec4> filtered;
  reference::Image<glm::dvec4> resolved;  ///< rgb: mean; a: number of frames.
  reference::Image<glm::dvec4> output;
  std::vector<std::uint16_t> outputBits;  ///< RGBA16F texels of the output.
  std::map<std::string, reference::Image<glm::dvec3>> views;
};

/// WALR on a device, fed with frames in memory.
class WalrRun {
 public:
  /// @param settings used as they are, however small the image: `fitWindow` is ignored
  /// @param inspect read back every stage, not only the output
  /// @param views   views of the filter to read back
  WalrRun(const fg::test::TestDevice& device, glm::ivec2 size, AnyWalr settings = robustWalr(),
          const InputConventions& conventions = {}, bool inspect = true, const SceneDescription& scene = {},
          const std::vector<std::string>& views = {});

  /// Denoise one frame.
  WalrStages frame(const reference::HostFrame& frame);
  /// Device memory of the graph, bytes.
  [[nodiscard]] std::uint64_t allocatedBytes() { return run_->executor().allocatedBytes(); }
  /// Forget all histories.
  void resetHistory() { run_->executor().resetAllHistory(); }

 private:
  struct Iteration {
    std::vector<fg::Texture> moments;
    fg::Texture depth;
  };

  void inspectStages(fg::Graph& graph);
  /// Copy a texture to where the test can read it.
  fg::Texture tap(fg::Graph& graph, fg::Texture texture);

  glm::ivec2 size_;
  AnyWalr settings_;
  PFN_vkCmdCopyImage copyImage_;
  DenoiserInputs inputs_;
  bool inspect_;
  fg::Texture depth_, shadingNormal_, features_, geometricNormal_, accumulated_, antilagTiles_, antilag_, filtered_,
      resolved_, output_;
  std::vector<Iteration> iterations_;
  Inspection inspection_;
  std::unique_ptr<fg::test::GraphRun> run_;
};

}  // namespace walr::test
