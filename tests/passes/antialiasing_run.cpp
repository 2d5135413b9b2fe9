#include "tests/passes/antialiasing_run.h"

#include "passes/temporal/antilag.h"

namespace walr::test {

using reference::Image;

AntialiasingRun::AntialiasingRun(const fg::test::TestDevice& device, glm::ivec2 size,
                                 const TemporalAntialiasingSettings& settings, const SceneDescription& scene,
                                 const Inputs& inputs)
    : size_(size),
      inputs_(importInputs(graph_, size)),
      guides_(importGuides(graph_, size)),
      output_(importOutput(graph_, size)) {
  inputs_.scene = scene;
  if (inputs.objectIds) inputs_.objectId = importObjectIds(graph_, size);
  if (inputs.shortening) {
    const fg::Extent tiles = antilagTiles(inputs_.extent(graph_));
    shortening_ = graph_.import("shortening", {VK_FORMAT_R32_UINT, tiles}, fg::vk::kUploaded);
  }
  graph_.exported(addTemporalAntialiasing(graph_, inputs_, guides_, inputs_.lighting, output_, settings, shortening_),
                  fg::vk::kReadable);
  run_ = std::make_unique<fg::test::GraphRun>(device, graph_, fg::vk::ExecutorOptions{.shared = device.pipelines()});
}

void AntialiasingRun::setShortening(const Image<std::uint32_t>& bits) {
  run_->fill(shortening_, bits.pixels());
}

Image<glm::dvec4> AntialiasingRun::frame(const reference::HostFrame& frame, const Image<reference::Guide>& guides,
                                         const Image<reference::Guide>& previous) {
  upload(*run_, inputs_, frame);
  upload(*run_, guides_, guides);
  uploadPrevious(*run_, guides_, previous);
  run_->frame();
  return readHalves(*run_, output_, size_);
}

}  // namespace walr::test
