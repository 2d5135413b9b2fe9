#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/graph_run.h"
#include "tests/vulkan/test_graphs.h"

namespace fg::test {
namespace {

using PoisonTest = GpuTest;

TEST_F(PoisonTest, TexelsWrittenBeforeTheyAreReadAreNotAffected) {
  Graph graph;
  const Texture out = chain(graph, 3, 8);
  GraphRun run(device(), graph, {.poison = true});
  for (int i = 0; i < 3; ++i) {
    run.frame();
    EXPECT_EQ(run.texels<std::uint32_t>(out), filled(3 + 8));
  }
}

/// The first pass writes only 8 x 8 texels. The second shows which texels are NaN.
TEST_F(PoisonTest, UnwrittenTexelsOfFloatTexturesAreNaN) {
  constexpr Extent kExtent{16, 8};
  Graph graph;
  const Texture out = importOutput(graph, "out", {VK_FORMAT_R32_UINT, kExtent});
  const Texture target = graph.texture("half written", {VK_FORMAT_R16G16B16A16_SFLOAT, kExtent});
  auto write = graph.compute("write", shaders::fillFloat);
  const Texture written = write.store("target", target);
  write.dispatch({8, 8});
  auto show = graph.compute("show", shaders::isNan).sample("source", written);
  const Texture shown = show.store("target", out);
  show.dispatch(kExtent);
  graph.exported(shown, vk::kReadable);
  GraphRun run(device(), graph, {.poison = true});
  for (int frame = 0; frame < 2; ++frame) {
    run.frame();
    const auto texels = run.texels<std::uint32_t>(out);
    for (std::uint32_t i = 0; i < texels.size(); ++i) {
      EXPECT_EQ(texels[i], i % kExtent.width < 8 ? 2u : 1u) << "texel " << i;
    }
  }
}

TEST_F(PoisonTest, UnwrittenTexelsOfIntegerTexturesAreAllOnes) {
  constexpr Extent kExtent{16, 8};
  Graph graph;
  const Texture out = importOutput(graph, "out", {VK_FORMAT_R32_UINT, kExtent});
  auto write = graph.compute("write", shaders::fill).constants(std::uint32_t{5});
  const Texture written = write.store("target", graph.texture("half written", {VK_FORMAT_R32_UINT, kExtent}));
  write.dispatch({8, 8});
  graph.exported(add(graph, "show", written, out, 0), vk::kReadable);
  GraphRun run(device(), graph, {.poison = true});
  run.frame();
  auto expected = filled(5, kExtent);
  for (std::uint32_t i = 0; i < expected.size(); ++i) {
    if (i % kExtent.width >= 8) expected[i] = ~0u;
  }
  EXPECT_EQ(run.texels<std::uint32_t>(out), expected);
}

}  // namespace
}  // namespace fg::test
