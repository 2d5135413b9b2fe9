#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "passes/lint/lint_hypotheses.h"

namespace walr {

/// How well a reading of the inputs explains motion, over frames.
struct LintScore {
  std::uint64_t samples = 0;
  std::uint64_t tested = 0;                ///< Samples in which the reading differs from the stated one,
  std::uint64_t better = 0;                ///< which it explains, and the stated one does not,
  std::uint64_t worse = 0;                 ///< and the reverse.
  std::array<std::uint64_t, 2> axes = {};  ///< `tested`, for x and y.
  double gain = 0.0;                       ///< How much nearer than the stated one the reading comes, summed.
  std::uint64_t moving = 0;                ///< Samples of which the reading says that they move,
  std::uint64_t movingFits = 0;            ///< and that it explains.
  /// The third channel of motion, where the reading explains the others and says that depth changes.
  struct {
    std::uint64_t tested = 0;
    std::uint64_t opposite = 0;
    std::uint64_t none = 0;
  } depth;
  // Of `LintReading::inMotion`, over frames:
  glm::dvec2 jitterSum{0.0};
  double jitterLength = 0.0;
  // `LintReading::fitted` in frames that it explains:
  glm::dvec2 leastFitted{std::numeric_limits<double>::max()};
  glm::dvec2 mostFitted{0.0};

  /// Whether the reading explains what the stated one does not: most of what tells the two apart, and twenty times
  /// as much as the reverse. A mistake shows on all surfaces that stand still; they may be few, but those that fit by
  /// accident are fewer.
  [[nodiscard]] bool explains(const LintHypothesis& mistake) const;
  [[nodiscard]] double meanGain() const { return samples > 0 ? gain / double(samples) : 0.0; }
};

/// Scores of all mistakes over frames of one kind.
struct LintScores {
  std::uint64_t frames = 0;
  LintScore stated;
  std::vector<LintScore> mistakes = std::vector<LintScore>(lintHypotheses().size());

  /// The mistake that explains motion best; nothing if none explains it clearly better than the stated reading.
  [[nodiscard]] std::optional<std::size_t> best() const;
  /// Names of other mistakes that explain it as well or nearly so, with commas between.
  [[nodiscard]] std::string rivals(std::size_t best) const;
};

/// Frames after another one by their cameras.
struct LintOrder {
  std::uint64_t frames = 0;
  std::uint64_t foreign = 0;   ///< The previous camera is not that of the frame before,
  std::uint64_t still = 0;     ///< but this frame's,
  std::uint64_t repeated = 0;  ///< or this frame's camera is that of the frame before,
  std::uint64_t reversed = 0;  ///< or is the previous camera of the frame before.

  void add(const FrameDescription& last, const FrameDescription& camera);
};

/// Compares motion with cameras and depth.
class LintMotion {
 public:
  explicit LintMotion(const InputConventions& conventions) : conventions_(conventions) {}

  void add(LintFrame frame);

  /// Scores of frames that continue the one before.
  [[nodiscard]] const LintScores& continued() const { return continued_; }
  /// Scores of cuts, as if they did.
  [[nodiscard]] const LintScores& cuts() const { return cuts_; }
  /// Whether every frame in which the camera moves is a cut, of more than a few.
  [[nodiscard]] bool cutsOnly() const { return continued_.stated.moving == 0 && cuts_.frames >= 3; }
  [[nodiscard]] const LintOrder& order() const { return order_; }
  /// Samples, and those that the rounding of the view matrix moves by more than a tenth of a pixel.
  [[nodiscard]] std::uint64_t surfaces() const { return surfaces_; }
  [[nodiscard]] std::uint64_t rounded() const { return rounded_; }

 private:
  void countRounding(const LintFrame& frame);
  void score(LintScores& scores, const LintContext& context) const;

  InputConventions conventions_;
  std::optional<LintFrame> last_;
  LintScores continued_;
  LintScores cuts_;
  LintOrder order_;
  std::uint64_t surfaces_ = 0;
  std::uint64_t rounded_ = 0;
};

}  // namespace walr
