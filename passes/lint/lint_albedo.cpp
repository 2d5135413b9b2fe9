// Lighting compared with albedo.
#include <cmath>

#include "passes/lint/lint_judge.h"

namespace walr {

AlbedoPairs albedoPairs(const LintCounts& counts, std::uint32_t followsFirst, std::uint32_t ignoresFirst) {
  AlbedoPairs pairs;
  for (std::uint32_t contrast = 0; contrast < kAlbedoContrasts; ++contrast) {
    const std::uint64_t follows = counts[followsFirst + contrast];
    const std::uint64_t ignores = counts[ignoresFirst + contrast];
    // A small share of light tells pairs of little contrast apart, so these weigh less.
    const double weight = contrast + 1.0;
    pairs.balance += weight * (double(follows) - double(ignores));
    pairs.variance += weight * weight * double(follows + ignores);
    pairs.follow += follows;
    pairs.all += follows + ignores;
  }
  return pairs;
}

bool AlbedoPairs::holdAlbedo() const {
  // Measured at one sample per pixel on path-traced scenes of 192 x 108 pixels, in standard errors: right light lies at
  // -1 to -8 after one frame and at -2 to -13 after four, light with albedo in it at 3 to 7 and at 5 to 14 where
  // surfaces have textures. Pairs share pixels, so that the error is up to 1.6 of these standard errors, which are
  // those of independent pairs.
  constexpr double kStandardErrors = 4.0;
  return all >= kLeastLintSample && balance >= kStandardErrors * std::sqrt(variance);
}

/// Compares two pixels on one surface with different albedo. If the lighting holds no albedo, either pixel is equally
/// likely to be the brighter one. If it holds albedo, that is true of the lighting divided by albedo. The test lies
/// half way between: it divides by the square root of albedo. Then the pixel with the larger albedo is mostly the
/// darker one in the first case and mostly the brighter one in the second. Only signs of differences count, so that
/// rare bright samples do not hide them.
void LintJudge::judgeAlbedo() {
  const AlbedoPairs pairs = albedoPairs(counts_, kLintFollowsAlbedo, kLintIgnoresAlbedo);
  if (!pairs.holdAlbedo()) return;
  add({"albedo-in-lighting",
       "the light's contrast is nearer to that of albedo than to none on " +
           share(pairs.follow, pairs.all, "pairs of pixels on one surface whose albedo differs"),
       "albedo was left in the lighting", "divide it out before the denoiser, and multiply it in after"});
}

}  // namespace walr
