#include "tests/vulkan/random_graph.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "framegraph/plan/memory_places.h"
#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/graph_run.h"

namespace fg::test {
namespace {

constexpr std::uint32_t kGraphs = 300;
constexpr std::uint32_t kFrames = 4;

/// Seed of the first graph. WALR_SEED sets another one, to try further graphs or to repeat a failure.
std::uint32_t firstSeed() {
  const char* const seed = std::getenv("WALR_SEED");
  return seed != nullptr ? static_cast<std::uint32_t>(std::strtoul(seed, nullptr, 10)) : 1u;
}

class RandomGraphTest : public GpuTest {
 protected:
  /// Run frames on device and CPU, with changing uploads and with resets. Two frames are in flight.
  void compareWithCpu(std::uint32_t seed, bool poison) {
    SCOPED_TRACE("WALR_SEED=" + std::to_string(seed) + (poison ? ", poisoned" : ""));
    RandomGraph random(seed, context().functions);
    const Plan plan = compileFor(context(), random.graph(), poison);
    countHistoryAliases(random.graph().desc(), plan);
    GraphRun run(device(), random.graph(), plan, {.poison = poison});
    for (const Texture input : random.inputs()) run.fill(input, random.texels(input));
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
      const std::uint32_t value = seed * kFrames + frame;
      run.executor().upload(random.frame(), value);
      if (frame == 2 && !random.histories().empty()) {
        run.executor().resetHistory(random.histories().front());
        random.resetHistoryOnCpu(random.histories().front());
      }
      run.submitFrame();
      random.runOnCpu(value);
    }
    run.finish();
    for (const Texture output : random.outputs()) {
      EXPECT_EQ(run.texels<std::uint32_t>(output), random.texels(output));
    }
    for (const vk::Message& message : takeMessages()) ADD_FAILURE() << "validation: " << message.text;
  }

  void countHistoryAliases(const GraphDesc& graph, const Plan& plan) {
    std::set<std::uint32_t> typesOfTextures;
    std::set<std::uint32_t> typesOfBuffers;
    for (std::uint32_t i = 0; i < graph.resources.size(); ++i) {
      if (plan.resources[i].heap == kNone) continue;
      const bool isTexture = std::holds_alternative<TextureDesc>(graph.resources[i].desc);
      (isTexture ? typesOfTextures : typesOfBuffers).insert(plan.resources[i].memoryTypeBits);
      if (!aliasedHistoryImages(graph, plan, i).empty()) ++(isTexture ? texturesInHistories_ : buffersInHistories_);
    }
    buffersCanAlias_ = buffersCanAlias_ || std::ranges::any_of(typesOfBuffers, [&](std::uint32_t types) {
                         return typesOfTextures.contains(types);
                       });
  }

  std::uint32_t texturesInHistories_ = 0;
  std::uint32_t buffersInHistories_ = 0;
  /// Whether the driver allows the same types of memory for some buffers as for textures, of which histories are made.
  /// Otherwise the two share no memory.
  bool buffersCanAlias_ = false;
};

TEST_F(RandomGraphTest, ResultsEqualTheDeclaredOrderOnTheCpu) {
  for (std::uint32_t seed = firstSeed(); seed < firstSeed() + kGraphs && !HasFailure(); ++seed) {
    compareWithCpu(seed, seed % 2 == 0);
  }
  EXPECT_GT(texturesInHistories_, kGraphs / 4) << "too few textures in the memory of histories";
  if (buffersCanAlias_) {
    EXPECT_GT(buffersInHistories_, kGraphs / 20) << "too few buffers in the memory of histories";
  } else {
    EXPECT_EQ(buffersInHistories_, 0U);
  }
}

}  // namespace
}  // namespace fg::test
