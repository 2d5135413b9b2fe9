// Motion compared with cameras and depth.
#include <algorithm>
#include <array>
#include <cstdio>

#include "passes/lint/lint_judge.h"

namespace walr {

bool LintJudge::has(std::string_view name) const {
  return std::ranges::any_of(found_, [&](const LintFinding& finding) { return finding.name == name; });
}

namespace {

/// ", with depth times 0.01"
std::string withFactor(const LintHypothesis& mistake, double factor) {
  if (mistake.factorOf.empty()) return "";
  std::array<char, 24> number{};
  std::snprintf(number.data(), number.size(), "%.3g", factor);
  return ", with " + std::string(mistake.factorOf) + " times " + number.data();
}

}  // namespace

void LintJudge::judgeMistake(const LintScores& scores, std::size_t best) {
  const LintHypothesis& mistake = lintHypotheses()[best];
  const LintScore& score = scores.mistakes[best];
  const std::string rivals = scores.rivals(best);
  const glm::dvec2& fitted = score.mostFitted;
  const auto agrees = [&](double factor) {
    return " agrees with cameras and depth on " + share(score.better, score.tested, "samples") +
           " if they are read another way" + withFactor(mistake, factor) + ", and on " + std::to_string(score.worse) +
           " as stated" + (rivals.empty() ? "" : " (less likely mistakes that explain as much: " + rivals + ")");
  };
  static constexpr std::array<std::array<std::string_view, 3>, 2> kNames{
      {{"motion-x-direction", "motion-x-unit", "motion-x-missing"},
       {"motion-y-direction", "motion-y-unit", "motion-y-missing"}}};
  static constexpr std::array<std::string_view, 3> kKinds{"motion-direction", "motion-unit", "motion-missing"};
  const auto kind = std::ranges::find(kKinds, mistake.name);
  if (kind == kKinds.end()) {
    const double factor = fitted.x == 1.0 ? fitted.y : fitted.x;  // Of a projection one may be 1.
    return add({mistake.name, "motion" + agrees(factor), mistake.cause, mistake.wayOut});
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double sign = mistake.signs[int(axis)];
    if ((sign == 1.0 && mistake.name != "motion-unit") || score.axes.at(axis) < kLeastLintSample) continue;
    std::string subject = axis == 0 ? "motion.x" : "motion.y";
    if (sign <= 0.0) subject += sign == 0.0 ? " is 0 and" : ", negated,";
    add({kNames.at(axis).at(std::size_t(kind - kKinds.begin())), subject + agrees(fitted[int(axis)]), mistake.cause,
         mistake.wayOut});
  }
}

void LintJudge::judgeCuts() {
  const LintScores& cuts = motion_.cuts();
  // At a cut motion may be anything, 0 for instance, so that other mistakes would be found by accident.
  const std::optional<std::size_t> best = cuts.best();
  const std::string_view name = best ? lintHypotheses()[*best].name : "";
  if (name == "view-inverted" || name == "view-position") return judgeMistake(cuts, *best);
  if (judgeOrder() || !isMost(cuts.stated.movingFits, cuts.stated.moving)) return;
  const std::string what =
      "every frame in which the camera moves is a cut, though motion leads to the frame before on " +
      share(cuts.stated.movingFits, cuts.stated.moving, "samples that move");
  if (const LintOrder& order = motion_.order(); order.foreign > 0) {
    const bool still = order.still == order.foreign;
    const LintHypothesis& mistake =
        *std::ranges::find(lintHypotheses(), still ? "camera-still" : "camera-previous", &LintHypothesis::name);
    return add({mistake.name, what, mistake.cause, mistake.wayOut});
  }
  add({"cut-every-frame", what, "the history is reset in every frame",
       "reset it (WALR_FRAME_RESET_HISTORY, or \"cut\" of a sequence) only where the camera jumps"});
}

bool LintJudge::judgeOrder() {
  const LintOrder& order = motion_.order();
  const auto most = [&](std::uint64_t part) { return part >= 3 && 2 * part > order.frames; };
  const std::string of = " of " + std::to_string(order.frames) + " frames";
  if (most(order.repeated)) {
    add({"frames-repeated",
         "the camera is that of the frame before, though the previous camera is another one, in " +
             std::to_string(order.repeated) + of,
         "the same frame was handed over again", "render every frame, and hand each over once"});
  } else if (most(order.reversed)) {
    add({"frames-reversed",
         "the camera is the previous one of the frame before in " + std::to_string(order.reversed) + of,
         "frames are handed over in the reverse order", "hand over the earliest frame first"});
  }
  return most(order.repeated) || most(order.reversed);
}

void LintJudge::judgeMotionDepth(const LintScore& score) {
  if (conventions_.motionDepth != InputConventions::MotionDepth::Given) return;
  if (isMost(score.depth.opposite, score.depth.tested)) {
    add({"motion-z-direction",
         "motion.z is the opposite of the camera's on " + share(score.depth.opposite, score.depth.tested, "samples"),
         "motion.z is current minus previous view depth, or a difference of view space's z",
         "state so (WALR_MOTION_DEPTH_REVERSED), or negate it"});
  }
  if (isMost(score.depth.none, score.depth.tested)) {
    add({"motion-z-missing",
         "motion.z is zero on " + share(score.depth.none, score.depth.tested, "samples") +
             " whose depth the camera changes",
         "motion has no third channel",
         "write previous minus current view depth, or state that there is none (WALR_MOTION_DEPTH_FOUND, or "
         "WALR_MOTION_DEPTH_STATIC_SCENE where only the camera moves)"});
  }
}

void LintJudge::judgeMotion() {
  // Motion is judged by cameras and depth, so only once these are right.
  static constexpr std::array<std::string_view, 7> kBefore{"jitter-in-matrices", "origin-far",     "view-inverted",
                                                           "depth-sign",         "depth-reversed", "depth-device",
                                                           "depth-distance"};
  if (std::ranges::any_of(kBefore, [&](std::string_view name) { return has(name); })) return;
  const LintScores& scores = motion_.continued();
  const std::optional<std::size_t> best = scores.best();
  if (!best && motion_.cutsOnly()) return judgeCuts();
  if (best) judgeMistake(scores, *best);
  if (const LintOrder& order = motion_.order();
      !best && !judgeOrder() && order.foreign >= 3 && 2 * order.foreign > order.frames) {
    const LintHypothesis& mistake = *std::ranges::find(lintHypotheses(), "camera-previous", &LintHypothesis::name);
    add({mistake.name,
         "the previous camera is not that of the frame before in " + std::to_string(order.foreign) + " of " +
             std::to_string(order.frames) + " frames",
         mistake.cause, mistake.wayOut});
  }
  judgeMotionDepth(best ? scores.mistakes[*best] : scores.stated);
}

}  // namespace walr
