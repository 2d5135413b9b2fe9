#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "passes/conventions/inputs.h"
#include "passes/lint/lint_finding.h"
#include "passes/lint/lint_inputs.h"

namespace walr {

/// Draws findings from the counts of `addLintInputs`. Each kind of input has a source file of its own.
class LintJudge {
 public:
  /// Both must outlive the judge.
  LintJudge(const LintCounts& counts, const InputConventions& conventions)
      : counts_(counts), conventions_(conventions) {}

  std::vector<LintFinding> take() { return std::move(found_); }
  void add(LintFinding finding) { found_.push_back(std::move(finding)); }

  void judgeOrigin();   ///< lint_values.cpp
  void judgeDepth();    ///< lint_values.cpp
  void judgeValues();   ///< lint_values.cpp
  void judgeNormals();  ///< lint_normals.cpp
  void judgeAlbedo();   ///< lint_albedo.cpp
  void judgeMotion();   ///< lint_motion.cpp

 private:
  void judgeAxis(std::string_view axis, std::uint32_t base);
  void judgeMotionDepth();
  void judgeJitter();
  void judgeStillness();
  [[nodiscard]] bool explains(std::uint32_t hypothesis) const;

  const LintCounts& counts_;
  const InputConventions& conventions_;
  std::vector<LintFinding> found_;
};

/// With fewer pixels or pairs than this there is no finding.
inline constexpr std::uint64_t kLeastLintSample = 100;

/// "12.3 % of 4567 pixels".
std::string share(std::uint64_t part, std::uint64_t whole, const std::string& of);

/// More than half, of a large enough sample.
inline bool isMost(std::uint64_t part, std::uint64_t whole) {
  return whole >= kLeastLintSample && 2 * part > whole;
}

/// More than a hundredth: errors of single pixels, as opposed to wrong conventions, stay below.
inline bool isMany(std::uint64_t part, std::uint64_t whole) {
  return part > 0 && 100 * part > whole;
}

}  // namespace walr
