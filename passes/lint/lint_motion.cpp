// Motion compared with that of the cameras.
#include <array>

#include "passes/lint/lint_judge.h"

namespace walr {

void LintJudge::judgeAxis(std::string_view axis, std::uint32_t base) {
  struct Reading {
    std::uint32_t reading;
    std::string_view name;
    const char* what;
    std::string_view cause;
    std::string_view wayOut;
  };
  static constexpr std::string_view kScale = "see WalrConventions::motion_unit, or scale motion (motion_scale)";
  static constexpr std::string_view kSignAndScale = "scale motion, with the other sign (motion_unit, motion_scale)";
  static constexpr std::array kReadingRules{
      Reading{kReadingOpposite, "direction", "the opposite of the camera's",
              "motion leads from the last frame to this one (current minus previous), or its y is up",
              "negate this axis of motion_scale"},
      Reading{kReadingUv, "unit", "the camera's in units of the picture", "motion is in pictures (\"UV\"), not pixels",
              "state so (WALR_MOTION_PICTURES)"},
      Reading{kReadingUvOpposite, "unit", "the opposite of the camera's in units of the picture",
              "motion is in pictures (\"UV\"), not pixels, and current minus previous or with y up",
              "state so (WALR_MOTION_PICTURES) and negate this axis of motion_scale"},
      Reading{kReadingClip, "unit", "the camera's in clip space, where 2 is the picture's size",
              "motion is a difference of clip-space positions", kScale},
      Reading{kReadingClipOpposite, "unit", "the opposite of the camera's in clip space, where 2 is the picture's size",
              "motion is a difference of clip-space positions, current minus previous or with y up", kSignAndScale},
      Reading{kReadingPixels, "unit", "the camera's in pixels, multiplied by the picture's size",
              "motion is in pixels though stated in pictures", "state so (WALR_MOTION_PIXELS)"},
      Reading{kReadingPixelsOpposite, "unit",
              "the opposite of the camera's in pixels, multiplied by the picture's size",
              "motion is in pixels though stated in pictures, and current minus previous or with y up", kSignAndScale},
      Reading{kReadingNone, "missing", "zero, though the camera moves",
              "the motion image was not written, or holds the motion of objects alone",
              "write the motion of all surfaces, or, where only the camera moves, set scene.object-motion off"},
  };
  static constexpr std::array<std::array<std::string_view, 3>, 2> kNames{
      {{"motion-x-direction", "motion-x-unit", "motion-x-missing"},
       {"motion-y-direction", "motion-y-unit", "motion-y-missing"}}};
  const std::uint64_t tested = counts_[base + kReadingTested];
  for (const Reading& rule : kReadingRules) {
    const std::uint64_t count = counts_[base + rule.reading];
    if (!isMost(count, tested)) continue;
    const std::size_t kind = rule.name == "direction" ? 0 : rule.name == "unit" ? 1 : 2;
    add({kNames.at(axis == "x" ? 0 : 1).at(kind),
         "motion." + std::string(axis) + " is " + rule.what + " on " +
             share(count, tested, "pixels where a still surface would move"),
         rule.cause, rule.wayOut});
  }
}

void LintJudge::judgeMotionDepth() {
  const std::uint64_t tested = counts_[kLintMotionZ + kReadingTested];
  if (isMost(counts_[kLintMotionZ + kReadingOpposite], tested)) {
    add({"motion-z-direction",
         "motion.z is the opposite of the camera's on " +
             share(counts_[kLintMotionZ + kReadingOpposite], tested, "pixels"),
         "motion.z is current minus previous view depth, or a difference of view space's z",
         "state so (WALR_MOTION_DEPTH_REVERSED), or negate it"});
  }
  if (isMost(counts_[kLintMotionZ + kReadingNone], tested)) {
    add({"motion-z-missing",
         "motion.z is zero on " + share(counts_[kLintMotionZ + kReadingNone], tested, "pixels") +
             " whose depth the camera changes",
         "motion has no third channel",
         "write previous minus current view depth, or state that there is none (WALR_MOTION_DEPTH_FOUND, or "
         "WALR_MOTION_DEPTH_STATIC_SCENE where only the camera moves)"});
  }
}

void LintJudge::judgeJitter() {
  const std::uint64_t tested = counts_[kLintJitterTested];
  if (isMost(counts_[kLintJitterOther], tested)) {
    const bool stated = conventions_.motionJittered;
    add({"motion-jitter",
         std::string("motion ") + (stated ? "leaves out" : "holds") + " the difference of the two frames' jitter on " +
             share(counts_[kLintJitterOther], tested, "pixels"),
         stated ? "motion is made with matrices that are not jittered, though stated to be that of the jittered images"
                : "motion is made with jittered matrices",
         stated ? "state that it is without jitter (motion_jittered), or make it with the jittered matrices"
                : "make it with matrices without jitter, or state that it holds it (motion_jittered)"});
  }
  if (isMost(counts_[kLintJitterOpposite], tested)) {
    add({"jitter-sign",
         "motion holds the difference of the two frames' jitter with the other sign on " +
             share(counts_[kLintJitterOpposite], tested, "pixels"),
         "jitter is stated with the other sign: it is sample position minus pixel centre, y down",
         "negate the jitter that is handed over"});
  }
}

void LintJudge::judgeStillness() {
  // Objects may fill most of an image, but hardly all of it.
  const std::uint64_t tested = counts_[kLintStillTested];
  const std::uint64_t moves = counts_[kLintStillMoves];
  if (tested < kLeastLintSample || 10 * moves <= 9 * tested) return;
  const std::string what =
      "everything moves on " + share(moves, tested, "pixels") + " where the cameras say that nothing but objects would";
  if (10 * counts_[kLintStillMovesAlike] > 9 * moves) {
    add({"jitter-missing", what + ", all of it alike and by no more than jitter differs from frame to frame",
         "motion holds the jitter of the images, but no jitter is handed over",
         "hand over the jitter, and state whether motion holds it (motion_jittered)"});
  } else {
    add({"camera-still", what, "the previous camera that is handed over is this frame's",
         "keep the matrices of the last frame, or leave the previous camera to the library"});
  }
}

void LintJudge::judgeMotion() {
  judgeAxis("x", kLintMotionX);
  judgeAxis("y", kLintMotionY);
  judgeMotionDepth();
  judgeJitter();
  judgeStillness();
}

}  // namespace walr
