#include "tests/passes/filter_run.h"

#include <string>

namespace walr::test {

FilterRun::FilterRun(const fg::test::TestDevice& device, glm::ivec2 size, std::size_t inputCount, const Add& add,
                     bool occlusion)
    : FilterRun(device, size, std::vector<glm::ivec2>(inputCount, size), add, occlusion) {}

FilterRun::FilterRun(const fg::test::TestDevice& device, glm::ivec2 size, const std::vector<glm::ivec2>& inputSizes,
                     const Add& add, bool occlusion)
    : frame_(graph_.upload("frame constants", sizeof(FrameConstants))), guides_(importGuides(graph_, size, occlusion)) {
  for (const glm::ivec2 inputSize : inputSizes)
    inputs_.push_back(importHalves(graph_, "input " + std::to_string(inputs_.size()), inputSize));
  output_ = copyOut(graph_, "result", add(graph_, frame_, guides_, inputs_));
  run_ = std::make_unique<fg::test::GraphRun>(device, graph_, fg::vk::ExecutorOptions{.shared = device.pipelines()});
}

reference::Image<glm::dvec4> FilterRun::run(const reference::HostFrame& frame,
                                            const reference::Image<reference::Guide>& guides,
                                            const std::vector<reference::Image<glm::dvec4>>& inputs) {
  run_->executor().upload(frame_, frame.constants);
  upload(*run_, guides_, guides);
  for (std::size_t i = 0; i < inputs.size(); ++i) upload(*run_, inputs_[i], inputs[i]);
  run_->frame();
  const fg::Extent extent = graph_.textureDesc(output_).extent;
  return readHalves(*run_, output_, glm::ivec2(extent.width, extent.height));
}

}  // namespace walr::test
