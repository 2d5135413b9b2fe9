#include "passes/input_linter.h"

#include <array>
#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

namespace walr {
namespace {

/// Fewer pixels or pairs say nothing.
constexpr std::uint64_t kLeastSample = 100;

std::string percent(std::uint64_t part, std::uint64_t whole) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f %%", 100.0 * double(part) / double(whole));
  return text.data();
}

std::string share(std::uint64_t part, std::uint64_t whole, const std::string& of) {
  return percent(part, whole) + " of " + std::to_string(whole) + " " + of;
}

bool isMost(std::uint64_t part, std::uint64_t whole) {
  return whole >= kLeastSample && 2 * part > whole;
}

/// A hundredth: what is wrong with single pixels, and not with how they are read, stays below.
bool isMany(std::uint64_t part, std::uint64_t whole) {
  return part > 0 && 100 * part > whole;
}

/// The findings of one look at the counts.
class Judge {
 public:
  Judge(const LintCounts& counts, const InputConventions& conventions) : counts_(counts), conventions_(conventions) {}

  std::vector<LintFinding> take() { return std::move(found_); }
  void add(LintFinding finding) { found_.push_back(std::move(finding)); }

  void judgeDepth();
  void judgeValues();
  void judgeNormals();
  void judgeAlbedo();
  void judgeMotion();

 private:
  void judgeAxis(std::string_view axis, std::uint32_t base);
  void judgeMotionDepth();
  void judgeJitter();
  [[nodiscard]] bool explains(std::uint32_t hypothesis) const;

  const LintCounts& counts_;
  const InputConventions& conventions_;
  std::vector<LintFinding> found_;
};

void Judge::judgeDepth() {
  const std::uint64_t pixels = counts_[kLintPixels];
  if (isMany(counts_[kLintDepthNegative], pixels)) {
    add({"depth-sign", "depth is negative on " + share(counts_[kLintDepthNegative], pixels, "pixels"),
         "z of view space, which is negative in front of the camera, is handed over as distance",
         "state negative depth (WALR_DEPTH_NEGATIVE_LINEAR), or negate it"});
  }
  if (isMany(counts_[kLintDepthZero], pixels) && counts_[kLintSurfaces] == 0) {
    add({"depth-empty", "depth is 0 on " + share(counts_[kLintDepthZero], pixels, "pixels") + " and nowhere a surface",
         "the depth image was not written, or is another one", "write depth before the denoiser runs"});
  }
  if (pixels > 0 && counts_[kLintSurfaces] == 0 && found_.empty()) {
    add({"sky-only", "no pixel shows a surface: all depths are from the sky depth on, or not finite",
         "depth is in other units than the sky depth", "state a sky depth beyond the scene's farthest surface"});
  }
}

void Judge::judgeValues() {
  struct Rule {
    std::uint32_t word;
    std::uint32_t of;
    bool any;  ///< One pixel is too many.
    std::string_view name;
    const char* what;
    std::string_view cause;
    std::string_view wayOut;
  };
  static constexpr std::string_view kDivision = "a division by zero, or a variable that is not set on some path";
  static constexpr std::array kRules{
      Rule{kLintLightingNotFinite, kLintPixels, true, "lighting-not-finite", "lighting is NaN or infinite on ",
           "a division by an albedo or a probability of 0, or radiance beyond what halves hold",
           "write 0 there; the denoiser replaces such values, at the cost of what they would have told"},
      Rule{kLintDepthNotFinite, kLintPixels, true, "depth-not-finite", "depth is NaN on ", kDivision,
           "write a depth beyond the sky depth where there is no surface"},
      Rule{kLintNormalNotFinite, kLintSurfaces, true, "normal-not-finite", "normals are NaN or infinite on ",
           "a vector of length 0 was normalised", "write the geometric normal there, or zero on sky"},
      Rule{kLintMotionNotFinite, kLintSurfaces, true, "motion-not-finite", "motion is NaN or infinite on ",
           "a division by the w of what was behind the camera in the last frame",
           "write any motion that leads out of the picture"},
      Rule{kLintAlbedoNotFinite, kLintSurfaces, true, "albedo-not-finite", "albedo is NaN or infinite on ", kDivision,
           "write 0 where there is no diffuse lobe"},
      Rule{kLintLightingNegative, kLintPixels, false, "lighting-negative", "lighting is negative on ",
           "a reconstruction filter with negative lobes, or a subtraction of direct from full light",
           "hand over the light as it was sampled"},
      Rule{kLintNormalNotUnit, kLintSurfaces, false, "normal-not-unit", "normals are not of length 1 on ",
           "normals in 0..1 stated as -1..1, or interpolated and not normalised",
           "state how normals are written (WalrConventions::normals), or normalise them"},
      Rule{kLintAlbedoOutside, kLintSurfaces, false, "albedo-range", "albedo is below 0 or above 1 on ",
           "radiance or a lit colour is handed over as albedo",
           "hand over the share of light that the surface reflects"},
  };
  for (const Rule& rule : kRules) {
    const std::uint64_t count = counts_[rule.word];
    const std::uint64_t whole = counts_[rule.of];
    if (rule.any ? count == 0 : !isMany(count, whole)) continue;
    const std::string of = rule.of == kLintPixels ? "pixels" : "pixels with a surface";
    add({rule.name, rule.what + share(count, whole, of), rule.cause, rule.wayOut});
  }
  const std::uint64_t surfaces = counts_[kLintSurfaces];
  if (isMost(counts_[kLintNormalZero], surfaces)) {
    add({"normal-empty", "normals are zero on " + share(counts_[kLintNormalZero], surfaces, "pixels with a surface"),
         "the normal image was not written, or is another one",
         "write normals before the denoiser runs: without one a pixel passes through as it is"});
  }
  if (surfaces >= kLeastSample && counts_[kLintDiffuse] == 0) {
    add({"albedo-empty", "no pixel has a diffuse albedo of 0.01 or more",
         "the albedo image was not written, or is another one",
         "write the diffuse albedo: without it a pixel passes through as it is"});
  }
}

/// Whether a hypothesis fits better on three times as many pixels as it fits worse on, and on a tenth of all: where
/// both fit alike, as floors do when the camera only turns about the vertical, neither is said to be better.
bool Judge::explains(std::uint32_t hypothesis) const {
  const std::uint64_t better = counts_[kLintHypotheses + 2 * hypothesis];
  const std::uint64_t worse = counts_[kLintHypotheses + 2 * hypothesis + 1];
  return better >= kLeastSample && better > 3 * worse && 10 * better > counts_[kLintNormalTested];
}

void Judge::judgeNormals() {
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
  }};
  if (isMost(counts_[kLintNormalNotUnit], counts_[kLintSurfaces])) return;  // What they say is not what is meant.
  const std::uint64_t tested = counts_[kLintNormalTested];
  std::uint32_t best = kHypothesisCount;
  for (std::uint32_t h = 0; h < kHypothesisCount; ++h) {
    if (!explains(h)) continue;
    if (best == kHypothesisCount || counts_[kLintHypotheses + 2 * h] > counts_[kLintHypotheses + 2 * best]) best = h;
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
  if (tested < kLeastSample || double(counts_[kLintNormalFits]) > 2.0 * atRandom * double(tested)) return;
  add({"normal-depth",
       "normals agree with the slope of depth on no more than " +
           share(counts_[kLintNormalFits], tested, "smooth pixels") + ", where directions at random do on 20 %",
       "normals and depth are of different frames, cameras or conventions, or the projection is another",
       "compare both with the matrices that are handed over"});
}

void Judge::judgeAxis(std::string_view axis, std::uint32_t base) {
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
      Reading{kReadingPictures, "unit", "the camera's in units of the picture",
              "motion is in pictures (\"UV\"), not pixels", "state so (WALR_MOTION_PICTURES)"},
      Reading{kReadingPicturesOpposite, "unit", "the opposite of the camera's in units of the picture",
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

void Judge::judgeMotionDepth() {
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
         "write previous minus current view depth, or state that there is none (WALR_MOTION_DEPTH_STATIC_SCENE)"});
  }
}

void Judge::judgeJitter() {
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

void Judge::judgeMotion() {
  judgeAxis("x", kLintMotionX);
  judgeAxis("y", kLintMotionY);
  judgeMotionDepth();
  judgeJitter();
  // Objects may fill most of a picture, but hardly all of it.
  const std::uint64_t tested = counts_[kLintStillTested];
  if (tested >= kLeastSample && 10 * counts_[kLintStillMoves] > 9 * tested) {
    add({"camera-still",
         "everything moves on " + share(counts_[kLintStillMoves], tested, "pixels") +
             " where the cameras say that nothing but objects would",
         "the previous camera that is handed over is this frame's",
         "keep the matrices of the last frame, or leave the previous camera to the library"});
  }
}

/// Mean of the light whose orders are counted from a word on, and how far it may be off, relatively.
struct MeanLight {
  MeanLight(const LintCounts& counts, std::uint32_t base, std::uint64_t samples) {
    double sum = 0.0;
    double squares = 0.0;
    for (std::uint32_t order = 1; order < kLintOrders; ++order) {
      const double light = std::exp2(double(order) - double(kLintUnitOrder));
      sum += double(counts[base + order]) * light;
      squares += double(counts[base + order]) * light * light;
    }
    mean = sum / double(samples);
    relativeVariance = sum > 0.0 ? squares / (sum * sum) : 0.0;
  }
  double mean = 0.0;
  double relativeVariance = 0.0;  ///< Of the mean, by its standard error.
};

void Judge::judgeAlbedo() {
  const std::uint64_t pairs = counts_[kLintPairs];
  if (pairs < kLeastSample) return;
  const MeanLight more(counts_, kLintLightMore, pairs);
  const MeanLight less(counts_, kLintLightLess, pairs);
  const MeanLight dividedMore(counts_, kLintDividedMore, pairs);
  const MeanLight dividedLess(counts_, kLintDividedLess, pairs);
  if (!(less.mean > 0.0 && dividedLess.mean > 0.0)) return;
  const double ratio = more.mean / less.mean;
  const double divided = dividedMore.mean / dividedLess.mean;
  // Chance is left out at four standard errors; what is real, dark joints that are also deep, at half the contrast.
  const double error = std::sqrt(more.relativeVariance + less.relativeVariance);
  if (std::log(ratio) < 4.0 * error || std::abs(std::log(divided)) > std::log(ratio)) return;
  std::array<char, 128> figures{};
  std::snprintf(figures.data(), figures.size(), "%.2f times the light, and %.2f times after a division by albedo",
                ratio, divided);
  add({"albedo-in-lighting",
       "of " + std::to_string(pairs) +
           " pairs of neighbours on one surface, those with at least twice the albedo have " + figures.data(),
       "albedo was left in the lighting", "divide it out before the denoiser, and multiply it in after"});
}

/// Where the projection's centre is in the picture, pixels.
glm::dvec2 centreOf(const glm::mat4& projection, fg::Extent extent) {
  return {-0.5 * double(projection[2][0]) * extent.width, 0.5 * double(projection[2][1]) * extent.height};
}

bool sameFocalLength(const glm::mat4& a, const glm::mat4& b) {
  constexpr double kRoundoff = 1e-5;
  return std::abs(double(a[0][0]) - double(b[0][0])) <= kRoundoff * std::abs(double(a[0][0])) &&
         std::abs(double(a[1][1]) - double(b[1][1])) <= kRoundoff * std::abs(double(a[1][1]));
}

}  // namespace

std::string LintFinding::text() const {
  return std::string(name) + ": " + what + ". Likeliest cause: " + std::string(cause) +
         ". Way out: " + std::string(wayOut) + ".";
}

void InputLinter::add(const FrameDescription& frame, fg::Extent extent) {
  ++cameras_;
  const glm::dvec2 shift = centreOf(frame.projection, extent) - centreOf(frame.previousProjection, extent);
  // A jitter moves the centre by less than two pixels between frames; shifts of lenses are slower or farther. A
  // hundredth of a pixel is above the roundoff of matrices in single precision.
  constexpr double kLeast = 0.01;
  constexpr double kMost = 2.0;
  if (!sameFocalLength(frame.projection, frame.previousProjection)) return;
  if (glm::length(shift) < kLeast || glm::length(shift) > kMost) return;
  ++shiftedCameras_;
  if (glm::length(shift) > glm::length(largestShift_)) largestShift_ = shift;
}

std::vector<LintFinding> InputLinter::findings() const {
  Judge judge(counts_, conventions_);
  if (2 * shiftedCameras_ > cameras_) {
    std::array<char, 64> shift{};
    std::snprintf(shift.data(), shift.size(), "(%.2f, %.2f)", largestShift_.x, largestShift_.y);
    judge.add({"jitter-in-matrices",
               "the projection's centre moves from frame to frame, by up to " + std::string(shift.data()) + " pixels",
               "jitter was left in the projection matrix",
               "hand over the projection without jitter, and the jitter by itself"});
  }
  judge.judgeDepth();
  judge.judgeValues();
  judge.judgeNormals();
  judge.judgeMotion();
  judge.judgeAlbedo();
  return judge.take();
}

}  // namespace walr
