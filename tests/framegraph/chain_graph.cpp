#include "tests/framegraph/chain_graph.h"

#include <string>
#include <vector>

namespace fg::test {

Graph chainGraph(std::int64_t passes) {
  constexpr TextureDesc kDesc = {VK_FORMAT_R16G16B16A16_SFLOAT, {1920, 1080}};
  constexpr ExternalState kSampled = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                      VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  Graph graph;
  std::vector<Texture> values = {graph.import("input", kDesc, kSampled)};
  for (std::int64_t i = 0; i < passes; ++i) {
    const std::string number = std::to_string(i);
    auto pass = graph.callback("pass" + number, [](const RecordContext&) {});
    for (std::size_t back = 1; back <= 3 && back <= values.size(); ++back) {
      pass.sample("in" + std::to_string(back), values[values.size() - back]);
    }
    if (i % 8 == 0) {
      const History history = graph.history("history" + number, kDesc);
      pass.sample("previous", history.previous);
      values.push_back(pass.store("out", history.current));
    } else {
      values.push_back(pass.store("out", graph.texture("texture" + number, kDesc)));
    }
  }
  graph.exported(values.back(), kSampled);
  return graph;
}

}  // namespace fg::test
