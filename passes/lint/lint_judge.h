#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "passes/conventions/inputs.h"
#include "passes/lint/lint_edges.h"
#include "passes/lint/lint_finding.h"
#include "passes/lint/lint_inputs.h"
#include "passes/lint/lint_normals.h"
#include "passes/lint/lint_scores.h"

namespace walr {

/// Draws findings from what `addLintInputs` wrote. Each kind of input has a source file of its own.
class LintJudge {
 public:
  /// All must outlive the judge.
  LintJudge(const InputConventions& conventions, const LintCounts& counts, const LintEdges& edges,
            const LintNormals& normals, const LintMotion& motion)
      : conventions_(conventions), counts_(counts), edges_(edges), normals_(normals), motion_(motion) {}

  std::vector<LintFinding> take() { return std::move(found_); }
  void add(LintFinding finding) { found_.push_back(std::move(finding)); }

  void judgeOrigin();   ///< lint_values.cpp
  void judgeDepth();    ///< lint_values.cpp
  void judgeValues();   ///< lint_values.cpp
  void judgeNormals();  ///< lint_normals.cpp
  void judgeMotion();   ///< lint_motion.cpp
  void judgeAlbedo();   ///< lint_albedo.cpp

  // lint_specular.cpp; they find nothing without the counts of `addLintSpecular`.
  void judgeSpecularValues();
  void judgeSpecularPresence();
  void judgeSpecularDistances();
  void judgeLobes();
  void judgeReflectedDistance();
  void judgeReflectedMotion();

 private:
  void judgeMistake(const LintScores& scores, std::size_t best);
  void judgeCuts();
  /// Frames that come again, or in the reverse order. @returns whether they do
  bool judgeOrder();
  void judgeMotionDepth(const LintScore& score);
  [[nodiscard]] bool has(std::string_view name) const;

  const InputConventions& conventions_;
  const LintCounts& counts_;
  const LintEdges& edges_;
  const LintNormals& normals_;
  const LintMotion& motion_;
  std::vector<LintFinding> found_;
};

/// Pairs of pixels on one surface whose albedo differs.
struct AlbedoPairs {
  std::uint64_t follow = 0;  ///< Those whose light follows albedo.
  std::uint64_t all = 0;
  double balance = 0.0;   ///< Weighed by the contrast of albedo: how many more follow it than ignore it,
  double variance = 0.0;  ///< and the variance of that if chance decides.

  [[nodiscard]] bool holdAlbedo() const;
};

/// The pairs that `addLintInputs` or `addLintSpecular` counted.
/// @param follows, ignores first words of the classes of contrast
AlbedoPairs albedoPairs(const LintCounts& counts, std::uint32_t follows, std::uint32_t ignores);

/// More than a hundredth: errors of single pixels, as opposed to wrong conventions, stay below.
inline bool isMany(std::uint64_t part, std::uint64_t whole) {
  return part > 0 && 100 * part > whole;
}

}  // namespace walr
