// Light directions as hosts evaluate them: the shader include agrees with C++ in double precision.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "passes/conventions/light_direction.h"
#include "tests/passes/reference/storage.h"
#include "tests/passes/shaders.h"
#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/graph_run.h"

namespace walr::test::light_direction_test {
namespace {

constexpr fg::Extent kExtent{32, 16};

class LightDirection : public fg::test::GpuTest {
 protected:
  /// Light of 1 in all channels for the normal (0, 0, 1), evaluated for another one.
  [[nodiscard]] std::vector<float> evaluate(const std::vector<std::uint32_t>& words, bool repack) const {
    fg::Graph graph;
    const fg::Texture direction = graph.import("direction", {kLightDirectionFormat, kExtent}, fg::vk::kUploaded);
    fg::Texture target = graph.import("target", {VK_FORMAT_R32G32B32A32_SFLOAT, kExtent}, fg::vk::kOverwritable);
    fg::PassBuilder pass = graph.compute("evaluate", shaders::evaluateDirection);
    pass.sample("direction", direction).specialize("kRepack", repack).dispatch(kExtent);
    target = pass.store("target", target);
    graph.exported(target, fg::vk::kReadable);
    fg::test::GraphRun run(device(), graph, {.shared = device().pipelines()});
    run.fill(direction, words);
    run.frame();
    return run.texels<float>(target);
  }
};

TEST_F(LightDirection, IsEvaluatedAsStated) {
  std::mt19937 random(1);
  std::vector<std::uint32_t> words;
  for (std::uint32_t i = 0; i < kExtent.width * kExtent.height; ++i) {
    // Exponents of units from 2^-20 to 2^11; the first texel has none, as where there is no surface.
    std::array<std::uint32_t, 2> texel{0, (i == 0 ? 0 : 107 + i % 32) << 24U};
    for (std::uint32_t k = 0; k < 9; ++k) {
      const int mantissa = static_cast<int>(random() % 63) - 31;
      texel.at(k / 5) |= (static_cast<std::uint32_t>(mantissa) & 63U) << 6 * (k % 5);
    }
    words.insert(words.end(), texel.begin(), texel.end());
  }
  for (const bool repack : {false, true}) {
    SCOPED_TRACE(repack);
    const std::vector<float> light = evaluate(words, repack);
    for (std::size_t i = 0; i < words.size() / 2; ++i) {
      const glm::dmat3 slopes(lightSlopes({words[2 * i], words[2 * i + 1]}));
      const glm::dvec3 change = slopes * glm::dvec3(0.48, -0.64, 0.6 - 1.0);
      double largest = 1.0;
      for (int k = 0; k < 9; ++k) largest = std::max(largest, std::abs(slopes[k % 3][k / 3]));
      for (int c = 0; c < 3; ++c) {
        // Sums of four terms in single precision. Packed slopes are packed again without loss.
        const double expected = std::max(1.0 + change[c], 0.0);
        EXPECT_NEAR(light[4 * i + c], expected, 8.0 * reference::kFloatRoundoff * largest) << i;
      }
    }
    EXPECT_EQ(light[0], 1.0F);
  }
}

}  // namespace
}  // namespace walr::test::light_direction_test
