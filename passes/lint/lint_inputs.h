#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "shaders/lint/lint_inputs.h"

namespace walr {

/// Bytes of the buffer that receives counts and samples.
inline constexpr std::uint64_t kLintBytes = kLintWords * sizeof(std::uint32_t);

/// Add a pass that counts what is wrong in a host's inputs, and samples what must agree with the cameras. It changes
/// nothing; `InputLinter` turns both into text.
/// @param counters of `kLintBytes`; overwritten
/// @returns its new version, whose words are those of shaders/lint/lint_inputs.h
fg::Buffer addLintInputs(fg::Graph& graph, const DenoiserInputs& inputs, fg::Buffer counters);

/// A pass over all pixels that reads what every pass of the linter does: constants, light, depth, normals and motion.
fg::PassBuilder lintPass(fg::Graph& graph, const char* name, const fg::Shader& shader, const DenoiserInputs& inputs);

/// With fewer pixels or pairs than this there is no finding.
inline constexpr std::uint64_t kLeastLintSample = 100;

/// More than half, of a large enough sample.
inline bool isMost(std::uint64_t part, std::uint64_t whole) {
  return whole >= kLeastLintSample && 2 * part > whole;
}

/// A count of `addLintInputs` that programs may want.
struct LintCount {
  std::string_view name;
  std::uint32_t word;  ///< Of the buffer.
};
inline constexpr std::array kLintCounts{
    LintCount{"lint-pixels", kLintPixels},
    LintCount{"lint-surfaces", kLintSurfaces},
    LintCount{"lint-diffuse", kLintDiffuse},
    LintCount{"lint-depth-not-finite", kLintDepthNotFinite},
    LintCount{"lint-depth-negative", kLintDepthNegative},
    LintCount{"lint-depth-zero", kLintDepthZero},
    LintCount{"lint-normal-not-finite", kLintNormalNotFinite},
    LintCount{"lint-normal-zero", kLintNormalZero},
    LintCount{"lint-normal-not-unit", kLintNormalNotUnit},
    LintCount{"lint-motion-not-finite", kLintMotionNotFinite},
    LintCount{"lint-lighting-not-finite", kLintLightingNotFinite},
    LintCount{"lint-lighting-negative", kLintLightingNegative},
    LintCount{"lint-lighting-samples", kLintSamples},
    LintCount{"lint-lighting-count-invalid", kLintCountInvalid},
    LintCount{"lint-albedo-not-finite", kLintAlbedoNotFinite},
    LintCount{"lint-albedo-outside", kLintAlbedoOutside},
};

/// Counts of `addLintInputs` and `addLintSpecular`, summed over frames.
class LintCounts {
 public:
  /// Add the words of a frame.
  /// @param continues whether its history was not reset: else no motion counts
  void add(std::span<const std::uint32_t> words, bool continues);
  [[nodiscard]] std::uint64_t operator[](std::uint32_t word) const { return sums_[word]; }
  /// Surfaces whose light is not 0.
  [[nodiscard]] std::uint64_t litPixels() const;
  /// Frames with light, and those of them in which every second pixel, column or row has none.
  [[nodiscard]] std::uint64_t litFrames() const { return litFrames_; }
  [[nodiscard]] std::uint64_t halfLitFrames() const { return halfLitFrames_; }

 private:
  std::array<std::uint64_t, kLintCountWords> sums_{};
  std::uint64_t litFrames_ = 0;
  std::uint64_t halfLitFrames_ = 0;
};

/// A pixel with a surface: what the host's images hold there and around it.
struct LintSample {
  glm::dvec2 pixel;              ///< Its centre.
  double depth = 0.0;            ///< Along the view axis.
  std::array<double, 4> around;  ///< Depth left, right, above and below; 0 outside the image.
  glm::dvec3 normal;
  glm::dvec3 motion;  ///< Without `FrameDescription::motionScale`.
};

/// The samples of a frame.
/// @param words  words of the buffer
/// @param extent the image's
std::vector<LintSample> lintSamples(std::span<const std::uint32_t> words, fg::Extent extent, float skyDepth);

}  // namespace walr
