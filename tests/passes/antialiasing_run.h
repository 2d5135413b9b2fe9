#pragma once

#include <memory>

#include "passes/temporal/temporal_antialiasing.h"
#include "tests/passes/host_textures.h"
#include "tests/vulkan/graph_run.h"
#include "tests/vulkan/test_device.h"

namespace walr::test {

/// Temporal anti-aliasing alone.
class AntialiasingRun {
 public:
  /// Optional inputs of the stage.
  struct Inputs {
    bool objectIds = false;
    bool shortening = false;
  };

  AntialiasingRun(const fg::test::TestDevice& device, glm::ivec2 size, const TemporalAntialiasingSettings& settings,
                  const SceneDescription& scene, const Inputs& inputs);

  /// What the stage reads as its shortening from the next frame on, a value for each tile of antilag.
  void setShortening(const reference::Image<std::uint32_t>& bits);
  /// The result of a frame, whose light is the host's.
  reference::Image<glm::dvec4> frame(const reference::HostFrame& frame,
                                     const reference::Image<reference::Guide>& guides,
                                     const reference::Image<reference::Guide>& previous);

 private:
  glm::ivec2 size_;
  fg::Graph graph_;
  DenoiserInputs inputs_;
  Guides guides_;
  fg::Texture shortening_;
  fg::Texture output_;
  std::unique_ptr<fg::test::GraphRun> run_;
};

}  // namespace walr::test
