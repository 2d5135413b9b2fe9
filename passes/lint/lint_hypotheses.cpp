#include "passes/lint/lint_hypotheses.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "passes/conventions/camera_check.h"

namespace walr {
namespace {

using Context = const LintContext&;
using Signs = const glm::dvec3&;
using Reading = LintReading&;

/// Nothing of too few values.
std::optional<double> median(std::vector<double> values) {
  constexpr std::size_t kLeast = 50;
  if (values.size() < kLeast) return std::nullopt;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

// ---- Cameras ----

bool isStill(const FrameDescription& camera) {
  return sameView(camera.previousView, camera.view) && camera.previousOrigin == camera.origin;
}

bool previousIsLast(Context context, Reading reading) {
  if (context.last == nullptr) return false;
  const FrameDescription& last = context.last->camera;
  reading.previousFromView = viewFromView(context.frame.camera, glm::dmat4(last.view), last.origin);
  return true;
}

bool cameraStill(Context context, Signs, Reading reading) {
  return isStill(context.frame.camera) && previousIsLast(context, reading);
}

bool cameraPrevious(Context context, Signs, Reading reading) {
  return !isStill(context.frame.camera) && previousIsLast(context, reading);
}

bool cameraLate(Context context, Signs, Reading reading) {
  reading.previousFromView = statedReading(*context.next, context.motionJittered).previousFromView;
  return true;
}

/// @tparam view, previous which of the two matrices is the inverse of what it should be
template <bool view, bool previous>
bool inverted(Context context, Signs, Reading reading) {
  const glm::dmat4 fromView(context.frame.camera.view);
  const glm::dmat4 toPrevious(context.frame.camera.previousView);
  reading.previousFromView =
      (previous ? glm::inverse(toPrevious) : toPrevious) * (view ? fromView : glm::inverse(fromView));
  return true;
}

bool viewAxes(Context, Signs signs, Reading reading) {
  const glm::dmat4 mirror = glm::scale(glm::dmat4(1.0), signs);
  reading.previousFromView = mirror * reading.previousFromView * mirror;
  return true;
}

// ---- Motion ----

bool otherSigns(Context, Signs signs, Reading reading) {
  reading.scale = glm::dvec2(signs);
  return true;
}

/// Motion in another unit, of which `pixels` are 1.
bool inUnit(Context context, Signs signs, Reading reading, glm::dvec2 pixels) {
  const glm::dvec2 stated = glm::abs(glm::dvec2(context.frame.camera.motionScale));
  if (!(stated.x > 0.0 && stated.y > 0.0)) return false;
  reading.scale = pixels / stated * glm::dvec2(signs);
  const glm::dvec2 ratio = glm::abs(glm::log(pixels / stated));
  return std::max(ratio.x, ratio.y) > 0.1;
}

bool inPictures(Context context, Signs signs, Reading reading) {
  return inUnit(context, signs, reading, context.frame.size);
}

bool inClip(Context context, Signs signs, Reading reading) {
  return inUnit(context, signs, reading, 0.5 * context.frame.size);
}

bool inPixels(Context context, Signs signs, Reading reading) {
  return inUnit(context, signs, reading, glm::dvec2(1.0));
}

bool toNext(Context context, Signs signs, Reading reading) {
  const LintFrame& next = *context.next;
  reading.previousFromView = viewFromView(context.frame.camera, glm::dmat4(next.camera.view), next.camera.origin);
  reading.previousRay = glm::dvec4(next.constants.rayFromPixel);
  reading.jitterDelta = glm::dvec2(context.frame.camera.jitter) - glm::dvec2(next.camera.jitter);
  if (context.motionJittered) reading.inMotion = reading.jitterDelta;
  reading.scale = glm::dvec2(signs);
  return true;
}

// ---- Jitter ----

bool jitterTheOtherWay(Context, Signs, Reading reading) {
  reading.inMotion = reading.jitterDelta - reading.inMotion;
  return true;
}

bool jitterNegated(Context, Signs, Reading reading) {
  reading.inMotion = -reading.jitterDelta;
  return true;
}

bool jitterLate(Context context, Signs, Reading reading) {
  reading.inMotion = glm::dvec2(context.next->constants.jitterDelta);
  return context.motionJittered;
}

/// Motion that all pixels have beside the cameras', as jitter would give it.
bool jitterUnknown(Context context, Signs, Reading reading) {
  constexpr double kNone = 0.02;  // Pixels: as little as jitter has in another unit.
  constexpr double kMost = 1.5;   // Jitter within a pixel differs by at most sqrt(2) from frame to frame.
  if (glm::length(reading.jitterDelta) > kNone) return false;
  std::vector<double> x;
  std::vector<double> y;
  for (const LintSample& sample : context.frame.samples) {
    const glm::dvec2 rest = context.frame.motionOf(sample) - predict(context.frame, reading, sample).motion;
    if (!std::isfinite(rest.x) || !std::isfinite(rest.y)) continue;
    x.push_back(rest.x);
    y.push_back(rest.y);
  }
  const glm::dvec2 common(median(x).value_or(0.0), median(y).value_or(0.0));
  if (glm::length(common) < kMost) reading.inMotion += common;
  return true;
}

// ---- Depth ----

bool depthAlongRay(Context, Signs, Reading reading) {
  reading.depth = LintReading::Depth::Distance;
  return true;
}

/// Depth times a factor: the median of those that explain the parallax of each sample.
template <LintReading::Depth depth>
bool scaledDepth(Context context, Signs, Reading reading) {
  reading.depth = depth;
  constexpr double kLeastParallax = 0.1;  // Pixels.
  std::vector<double> inverse;
  for (const LintSample& sample : context.frame.samples) {
    const glm::dvec2 parallax = context.frame.motionOf(sample) - motionOfRotation(context.frame, reading, sample);
    if (!(glm::length(parallax) > kLeastParallax)) continue;
    inverse.push_back(inverseDepthFromMotion(context.frame, reading, sample) * depthOf(context.frame, reading, sample));
  }
  const double factor = median(inverse).value_or(0.0);
  if (factor > 0.0) reading.depthScale = 1.0 / factor;
  return factor > 0.0;
}

bool depthUnknown(Context, Signs, Reading reading) {
  reading.depth = LintReading::Depth::Any;
  return true;
}

std::vector<LintHypothesis> makeHypotheses() {
  std::vector<LintHypothesis> all;
  const auto add = [&](std::string_view name, auto apply, std::string_view cause,
                       std::string_view wayOut) -> LintHypothesis& {
    return all.emplace_back(LintHypothesis{.name = name, .cause = cause, .wayOut = wayOut, .apply = apply});
  };
  const auto addAll = [&](std::string_view name, auto apply, std::string_view cause, std::string_view wayOut,
                          std::initializer_list<glm::dvec3> signs) {
    for (const glm::dvec3& sign : signs) add(name, apply, cause, wayOut).signs = sign;
  };
  const glm::dvec3 same(1.0);
  const glm::dvec3 x(-1, 1, 1);
  const glm::dvec3 y(1, -1, 1);
  const glm::dvec3 z(1, 1, -1);
  const glm::dvec3 xy = x * y;

  const std::string_view keepCamera =
      "keep the matrices of the last frame, or leave the previous camera to the library";
  add("camera-still", cameraStill, "the previous camera that is handed over is this frame's", keepCamera);
  addAll("motion-direction", otherSigns,
         "motion leads from the last frame to this one (current minus previous) or to the next one, or its y is up",
         "negate this axis of motion_scale", {x, y, xy});
  addAll("motion-unit", inPictures, "motion is in pictures (\"UV\"), not in the stated unit",
         "state so (WALR_MOTION_PICTURES), and negate an axis whose sign differs (motion_scale)", {same, y, xy, x});
  addAll("motion-unit", inClip, "motion is a difference of clip-space positions, where 2 is the picture's size",
         "scale motion by half a picture, and negate an axis whose sign differs (motion_unit, motion_scale)",
         {same, y, xy, x});
  addAll("motion-unit", inPixels, "motion is in pixels, not in the stated unit",
         "state so (WALR_MOTION_PIXELS), and negate an axis whose sign differs (motion_scale)", {same, y, xy, x});
  add("motion-jitter", jitterTheOtherWay,
      "motion holds the difference of the two frames' jitter though stated to be without, or leaves it out",
      "state the other (motion_jittered), or make motion with or without jitter, as stated");
  add("jitter-sign", jitterNegated,
      "jitter is stated with the other sign: it is sample position minus pixel centre, y down",
      "negate the jitter that is handed over");
  add("jitter-missing", jitterUnknown, "motion holds the jitter of the images, but no jitter is handed over",
      "hand over the jitter in pixels, and state whether motion holds it (motion_jittered)")
      .alternates = true;
  add("jitter-late", jitterLate, "the jitter that is handed over is that of the frame before",
      "hand over the jitter with which the frame was rendered")
      .needsNext = true;
  for (const auto apply : {inverted<true, true>, inverted<true, false>, inverted<false, true>}) {
    add("view-inverted", apply,
        "the view matrix that is handed over, or the previous one, is its inverse, which leads from view to world "
        "space",
        "hand over the matrix from world to view space");
  }
  add("camera-previous", cameraPrevious,
      "the previous camera that is handed over is another one than that of the frame before", keepCamera);
  addAll("motion-missing", otherSigns, "the motion image was not written, or holds the motion of objects alone",
         "write the motion of all surfaces, or, where only the camera moves, set scene.object-motion off",
         {{0, 1, 1}, {1, 0, 1}, {0, 0, 1}});
  using Depth = LintReading::Depth;
  add("depth-unit", scaledDepth<Depth::Axis>,
      "depth and the view matrices are in different units, such as centimetres and metres",
      "write depth in the units of the view matrices")
      .ofDepth = true;
  add("depth-distance", depthAlongRay,
      "depth is the distance from the camera, as a ray's length, not along the view axis",
      "multiply it by the cosine of ray and view axis")
      .ofDepth = true;
  const std::string_view linearise = "state device depth and its projection (WALR_DEPTH_DEVICE), or make it linear";
  add("depth-device", scaledDepth<Depth::Device>,
      "depth is that of a projection, 0 near and 1 far, not linear view depth", linearise)
      .ofDepth = true;
  add("depth-reversed", scaledDepth<Depth::Reversed>, "depth is that of a reversed projection, not linear view depth",
      linearise)
      .ofDepth = true;
  add("camera-late", cameraLate, "the camera that is handed over is that of the frame before",
      "hand over the camera with which the frame was rendered")
      .needsNext = true;
  for (const glm::dvec3& sign : {same, xy}) {
    LintHypothesis& next = add("motion-next", toNext, "motion leads to the next frame, or from it to this one",
                               "write the motion that leads to the previous frame");
    next.needsNext = true;
    next.signs = sign;
  }
  addAll("view-axes", viewAxes,
         "view space is not that of the picture, where x is to the right, y up and the camera looks down -z",
         "negate the axes of the view matrix, and the z of the world if one is left-handed",
         {y * z, z, y, x, x * z, xy, xy * z});
  LintHypothesis& other = add("depth-other", depthUnknown,
                              "depth is another quantity, such as a mist or fog factor, or that of another frame",
                              "write linear view depth in the units of the view matrices");
  other.fitsStated = other.ofDepth = true;
  return all;
}

}  // namespace

const std::vector<LintHypothesis>& lintHypotheses() {
  static const std::vector<LintHypothesis> kAll = makeHypotheses();
  return kAll;
}

}  // namespace walr
