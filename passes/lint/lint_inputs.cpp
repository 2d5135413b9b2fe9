#include "passes/lint/lint_inputs.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "passes/stage/inspection.h"
#include "shaders/shaders.h"

namespace walr {

static_assert(kLintCountWords <= kCounterWords && kCounterWords <= kLintFirstSample);  // "clear lint counters"

fg::PassBuilder lintPass(fg::Graph& graph, const char* name, const fg::Shader& shader, const DenoiserInputs& inputs) {
  const fg::Extent extent = graph.textureDesc(inputs.depth).extent;
  fg::PassBuilder pass = graph.compute(name, shader);
  pass.uniform("frameConstants", inputs.frame)
      .sample("lighting", inputs.lighting)
      .sample("depth", inputs.depth)
      .sample("normal", inputs.normal)
      .sample("motion", inputs.motion)
      .dispatch(extent);
  if (inputs.conventions.light.fullSize()) pass.texels(extent);
  specializeLight(pass, inputs.conventions.samples());
  return pass;
}

fg::Buffer addLintInputs(fg::Graph& graph, const DenoiserInputs& inputs, fg::Buffer counters) {
  fg::PassBuilder clear = graph.compute("clear lint counters", shaders::countClear);
  clear.dispatch({1, 1});
  counters = clear.store("counters", counters);
  fg::PassBuilder pass = lintPass(graph, "lint inputs", shaders::lintInputs, inputs);
  pass.sample("albedo", inputs.lobeAlbedo());
  return pass.update("counters", counters);
}

void LintCounts::add(std::span<const std::uint32_t> words, bool continues) {
  for (std::uint32_t word = 0; word < kLintCountWords; ++word) {
    const bool ofMotion = word >= kReflectedMotions && word < kReflectedMotions + kReflectedMotionCount;
    if (continues || !ofMotion) sums_[word] += words[word];
  }

  // Halves of all pixels: those of either colour of a chessboard, odd or even columns, and odd or even rows.
  constexpr std::array<std::array<std::uint32_t, 2>, 6> kHalves{{{0, 3}, {1, 2}, {0, 2}, {1, 3}, {0, 1}, {2, 3}}};
  const auto sum = [&](std::uint32_t first, const auto& half) {
    return std::uint64_t(words[first + half[0]]) + words[first + half[1]];
  };
  if (sum(kLintLit, kHalves[0]) + sum(kLintLit, kHalves[1]) < kLeastLintSample) return;
  ++litFrames_;
  const bool halfLit = std::ranges::any_of(
      kHalves, [&](const auto& half) { return sum(kLintLit, half) == 0 && sum(kLintDark, half) >= kLeastLintSample; });
  halfLitFrames_ += halfLit ? 1 : 0;
}

std::uint64_t LintCounts::litPixels() const {
  return std::accumulate(&sums_[kLintLit], &sums_[kLintLit] + 4, std::uint64_t{0});
}

std::vector<LintSample> lintSamples(std::span<const std::uint32_t> words, fg::Extent extent, float skyDepth) {
  const std::uint32_t cells = std::min(kLintColumns, extent.width) * std::min(kLintRows, extent.height);
  std::vector<LintSample> samples;
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    const std::span record = words.subspan(kLintFirstSample + cell * kLintSampleWords, kLintSampleWords);
    const auto number = [&](std::uint32_t word) { return double(std::bit_cast<float>(record[word])); };
    const auto vector = [&](std::uint32_t word) {
      return glm::dvec3(number(word), number(word + 1), number(word + 2));
    };
    const double depth = number(kSampleDepth);
    if (!(depth > 0.0 && depth < skyDepth)) continue;
    LintSample& sample = samples.emplace_back();
    sample.pixel = glm::dvec2(record[kSamplePixel] & 0xffffU, record[kSamplePixel] >> 16U) + 0.5;
    sample.depth = depth;
    for (std::uint32_t i = 0; i < 4; ++i) sample.around.at(i) = number(kSampleAround + i);
    sample.normal = vector(kSampleNormal);
    sample.motion = vector(kSampleMotion);
  }
  return samples;
}

}  // namespace walr
