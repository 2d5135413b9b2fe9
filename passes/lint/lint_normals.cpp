// Normals compared with the slope of depth.
#include <array>

#include "passes/lint/lint_judge.h"

namespace walr {

/// Whether a hypothesis fits better on at least a tenth of all pixels, and better on three times as many as worse.
/// Where both fit alike, as on floors while the camera only turns about the vertical, neither counts as better.
bool LintJudge::explains(std::uint32_t hypothesis) const {
  const std::uint64_t better = counts_[kLintHypotheses + 2 * hypothesis];
  const std::uint64_t worse = counts_[kLintHypotheses + 2 * hypothesis + 1];
  return better >= kLeastLintSample && better > 3 * worse && 10 * better > counts_[kLintNormalTested];
}

void LintJudge::judgeNormals() {
  struct Hypothesis {
    std::string_view name;
    std::string_view cause;
    std::string_view wayOut;
  };
  static constexpr std::array<Hypothesis, kHypothesisCount> kHypotheses{{
      {"normal-space", "normals are in world space though stated in view space, or the other way about",
       "state the other space (WalrConventions::normal_space, InputConventions::normal)"},
      {"normal-y", "normals have y down, as those of a picture or of another handedness", "negate their y"},
      {"depth-reversed", "depth is that of a reversed projection, not linear view depth",
       "state device depth and its projection (WALR_DEPTH_DEVICE), or make it linear"},
      {"depth-device", "depth is that of a projection, 0 near and 1 far, not linear view depth",
       "state device depth and its projection (WALR_DEPTH_DEVICE), or make it linear"},
      {"depth-distance", "depth is the distance from the camera, as a ray's length, not along the view axis",
       "multiply it by the cosine of ray and view axis"},
      {"view-inverted", "the view matrix that is handed over is its inverse, which leads from view to world space",
       "hand over the matrix from world to view space"},
  }};
  if (isMost(counts_[kLintNormalNotUnit], counts_[kLintSurfaces])) return;  // A wrong encoding explains them.
  const std::uint64_t tested = counts_[kLintNormalTested];
  std::uint32_t best = kHypothesisCount;
  for (std::uint32_t h = 0; h < kHypothesisCount; ++h) {
    if (!explains(h)) continue;
    if (best == kHypothesisCount || counts_[kLintHypotheses + 2 * h] > counts_[kLintHypotheses + 2 * best]) best = h;
  }
  // An inverted view matrix rotates world-space normals the wrong way. Not rotating them at all, as the hypothesis of
  // the other space does, is then closer to the truth, too. So prefer the inverted matrix if it explains nearly as
  // much.
  const auto better = [&](std::uint32_t h) { return counts_[kLintHypotheses + 2 * h]; };
  if (best == kHypothesisOtherSpace && explains(kHypothesisInverseView) &&
      20 * better(kHypothesisInverseView) >= 19 * better(kHypothesisOtherSpace)) {
    best = kHypothesisInverseView;
  }
  if (best < kHypothesisCount) {
    add({kHypotheses.at(best).name,
         "normals and the slope of depth agree better on " +
             share(counts_[kLintHypotheses + 2 * best], tested, "smooth pixels") + ", and worse on " +
             std::to_string(counts_[kLintHypotheses + 2 * best + 1]) + ", if read another way",
         kHypotheses.at(best).cause, kHypotheses.at(best).wayOut});
    return;
  }
  const double atRandom = 1.0 - double(kFittingCosine);
  if (tested < kLeastLintSample || double(counts_[kLintNormalFits]) > 2.0 * atRandom * double(tested)) return;
  add({"normal-depth",
       "normals agree with the slope of depth on no more than " +
           share(counts_[kLintNormalFits], tested, "smooth pixels") + ", where directions at random do on 20 %",
       "normals and depth are of different frames, cameras or conventions, or the projection is another",
       "compare both with the matrices that are handed over"});
}

}  // namespace walr
