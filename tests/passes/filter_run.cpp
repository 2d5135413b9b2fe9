#include "tests/passes/filter_run.h"

#include <cmath>
#include <cstdint>
#include <string>

#include <glm/gtc/packing.hpp>
#include <glm/packing.hpp>

namespace walr::test {

using reference::Image;
using reference::Reflector;

namespace {

/// The texels of reflector.glsl: normal, roughness, and the inverse distance as a half.
std::vector<std::uint64_t> encode(const Image<reference::Guide>& guides, const Image<Reflector>& reflectors) {
  std::vector<std::uint64_t> texels;
  reference::forEachPixel(guides.size(), [&](glm::ivec2 p) {
    const auto roughness = static_cast<std::uint32_t>(std::lround(255.0 * reflectors[p].roughness));
    const std::uint32_t distance = glm::packHalf1x16(static_cast<float>(reflectors[p].inverseDistance));
    const std::uint32_t normal = glm::packUnorm2x16(glm::vec2(guides[p].features));
    texels.push_back(std::uint64_t{normal} | std::uint64_t{roughness | 1U << 8U | distance << 16U} << 32U);
  });
  return texels;
}

}  // namespace

FilterRun::FilterRun(const fg::test::TestDevice& device, glm::ivec2 size, std::size_t inputCount, const Add& add,
                     bool occlusion, const Image<Reflector>& reflectors)
    : FilterRun(device, size, std::vector<glm::ivec2>(inputCount, size), add, occlusion, reflectors) {}

FilterRun::FilterRun(const fg::test::TestDevice& device, glm::ivec2 size, const std::vector<glm::ivec2>& inputSizes,
                     const Add& add, bool occlusion, const Image<Reflector>& reflectors)
    : frame_(graph_.upload("frame constants", sizeof(FrameConstants))), reflectors_(reflectors) {
  guides_ = importGuides(graph_, size, occlusion);
  if (!reflectors_.pixels().empty()) {
    const fg::Extent extent{static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y)};
    guides_.features = graph_.import("reflectors", {VK_FORMAT_R32G32_UINT, extent}, fg::vk::kUploaded);
  }
  for (const glm::ivec2 inputSize : inputSizes)
    inputs_.push_back(importHalves(graph_, "input " + std::to_string(inputs_.size()), inputSize));
  output_ = copyOut(graph_, "result", add(graph_, frame_, guides_, inputs_));
  run_ = std::make_unique<fg::test::GraphRun>(device, graph_, fg::vk::ExecutorOptions{.shared = device.pipelines()});
}

Image<glm::dvec4> FilterRun::run(const reference::HostFrame& frame, const Image<reference::Guide>& guides,
                                 const std::vector<Image<glm::dvec4>>& inputs) {
  run_->executor().upload(frame_, frame.constants);
  if (!reflectors_.pixels().empty()) {
    Guides surfaces = guides_;
    surfaces.features = {};
    upload(*run_, surfaces, guides);
    run_->fill(guides_.features, encode(guides, reflectors_));
  } else {
    upload(*run_, guides_, guides);
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) upload(*run_, inputs_[i], inputs[i]);
  run_->frame();
  const fg::Extent extent = graph_.textureDesc(output_).extent;
  return readHalves(*run_, output_, glm::ivec2(extent.width, extent.height));
}

}  // namespace walr::test
