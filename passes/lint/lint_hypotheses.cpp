#include "passes/lint/lint_hypotheses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>

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

/// What a view matrix without its translation hides.
bool withoutPosition(Context context, Signs, Reading reading) {
  const FrameDescription& camera = context.frame.camera;
  const glm::vec4 nowhere(0.0F, 0.0F, 0.0F, 1.0F);
  if (camera.view[3] != nowhere || camera.previousView[3] != nowhere || camera.origin != camera.previousOrigin)
    return false;
  const glm::dvec3 translation = translationFromMotion(context.frame, reading);
  reading.previousFromView[3] = glm::dvec4(translation, 1.0);
  return std::isfinite(glm::length(translation));
}

/// Rays of another projection: the factor that brings most samples near to motion.
/// @tparam x, y which axes have it
template <bool x, bool y>
bool otherProjection(Context context, Signs, Reading reading) {
  const LintReading stated = reading;
  const auto read = [&](double logarithm) {
    reading = stated;
    reading.fitted = {x ? std::exp(logarithm) : 1.0, y ? std::exp(logarithm) : 1.0};
    for (glm::dvec4* ray : {&reading.ray, &reading.previousRay}) *ray *= glm::dvec4(reading.fitted, reading.fitted);
  };
  const auto near = [&](double logarithm) {
    read(logarithm);
    double sum = 0.0;
    for (std::size_t i = 0; i < context.frame.samples.size(); i += 8) {  // Enough for one number.
      const LintSample& sample = context.frame.samples[i];
      const LintPrediction seen = predict(context.frame, reading, sample);
      const double off = glm::length((context.frame.motionOf(sample) - seen.given) / seen.tolerance);
      if (std::isfinite(off)) sum += 1.0 / (1.0 + off * off);
    }
    return sum;
  };
  double best = 0.0;
  double most = near(best);
  const auto search = [&](double middle, double step, int steps) {
    for (int i = -steps; i <= steps; ++i) {
      const double logarithm = middle + i * step;
      const double sum = near(logarithm);
      if (sum <= most) continue;
      most = sum;
      best = logarithm;
    }
  };
  search(0.0, 0.1, 12);  // A third to three times.
  search(best, 0.02, 5);
  search(best, 0.004, 5);
  read(best);
  return std::abs(best) > 0.03;
}

/// Images whose last row comes first.
bool upsideDown(Context context, Signs signs, Reading reading) {
  for (glm::dvec4* ray : {&reading.ray, &reading.previousRay}) {
    ray->w += context.frame.size.y * ray->y;
    ray->y = -ray->y;
  }
  reading.jitterDelta.y = -reading.jitterDelta.y;
  reading.inMotion.y = -reading.inMotion.y;
  reading.scale = glm::dvec2(signs);
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

/// Motion in pixels of a picture of another size: the median factor of each axis.
bool inOtherPixels(Context context, Signs, Reading reading) {
  constexpr double kLeastMotion = 0.1;  // Pixels.
  constexpr double kMost = 5.0;         // Such as a fifth of the height.
  std::array<std::optional<double>, 2> factors;
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<double> all;
    for (const LintSample& sample : context.frame.samples) {
      const double given = context.frame.motionOf(sample)[axis];
      const double seen = predict(context.frame, reading, sample).motion[axis];
      if (std::abs(given) > kLeastMotion && std::isfinite(seen)) all.push_back(seen / given);
    }
    factors.at(std::size_t(axis)) = median(std::move(all));
  }
  if (!factors[0] && !factors[1]) return false;
  reading.scale = {factors[0] ? *factors[0] : *factors[1], factors[1] ? *factors[1] : *factors[0]};
  reading.fitted = reading.scale;
  const auto isOther = [&](double factor) { return factor > 1.0 / kMost && factor < kMost; };
  return isOther(reading.scale.x) && isOther(reading.scale.y) &&
         std::max(std::abs(std::log(reading.scale.x)), std::abs(std::log(reading.scale.y))) > 0.1;
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

/// As if this frame's places were those of the last one: nearly so, beside edges.
bool motionLate(Context context, Signs, Reading reading) {
  if (context.last == nullptr || !context.last->continues) return false;
  reading = statedReading(*context.last, context.motionJittered);
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

/// Jitter in another unit, of which `pixels` are 1.
bool jitterIn(Context context, Reading reading, glm::dvec2 pixels) {
  reading.inMotion = reading.jitterDelta * pixels;
  return context.motionJittered;
}

bool jitterInPictures(Context context, Signs signs, Reading reading) {
  return jitterIn(context, reading, context.frame.size * glm::dvec2(signs));
}

bool jitterInClip(Context context, Signs signs, Reading reading) {
  return jitterIn(context, reading, 0.5 * context.frame.size * glm::dvec2(signs));
}

bool jitterTimes(Context context, Signs signs, Reading reading) {
  return jitterIn(context, reading, glm::dvec2(signs));
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
    const glm::dvec2 parallax = context.frame.motionOf(sample) - motionOfRotation(reading, sample);
    if (!(glm::length(parallax) > kLeastParallax)) continue;
    inverse.push_back(inverseDepthFromMotion(context.frame, reading, sample) * depthOf(reading, sample));
  }
  const double factor = median(inverse).value_or(0.0);
  if (factor > 0.0) reading.fitted = glm::dvec2(reading.depthScale = 1.0 / factor);
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
  LintHypothesis& otherPixels =
      add("motion-unit", inOtherPixels,
          "motion is in pixels of a picture of another size, such as that of the output, or in a share of the picture",
          "scale it to pixels of the picture that is denoised (motion_scale)");
  otherPixels.fits = true;
  otherPixels.factorOf = "motion";
  add("motion-jitter", jitterTheOtherWay,
      "motion holds the difference of the two frames' jitter though stated to be without, or leaves it out",
      "state the other (motion_jittered), or make motion with or without jitter, as stated");
  add("jitter-sign", jitterNegated,
      "jitter is stated with the other sign: it is sample position minus pixel centre, y down",
      "negate the jitter that is handed over");
  const std::string_view jitterUnit = "jitter is in another unit: it is in pixels of the picture that is denoised";
  const std::string_view convertJitter = "hand over the jitter in pixels, y down";
  addAll("jitter-unit", jitterTimes, jitterUnit, convertJitter, {glm::dvec3(0.5), glm::dvec3(2.0)});
  addAll("jitter-unit", jitterInPictures, jitterUnit, convertJitter, {same, y});
  addAll("jitter-unit", jitterInClip, jitterUnit, convertJitter, {same, y});
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
  for (const glm::dvec3& sign : {y, same}) {
    LintHypothesis& upside =
        add("picture-upside-down", upsideDown, "the images are handed over with their last row first",
            "hand them over with their first row at the top, and motion with y down");
    upside.signs = sign;
    upside.ofPlaces = true;
  }
  add("view-position", withoutPosition, "the view matrices have no translation, as those of a world around the camera",
      "hand over the camera's position in the matrices, or by itself (WalrFrame::origin, FrameDescription::origin)")
      .fits = true;
  add("camera-previous", cameraPrevious,
      "the previous camera that is handed over is another one than that of the frame before", keepCamera);
  addAll("motion-missing", otherSigns, "the motion image was not written, or holds the motion of objects alone",
         "write the motion of all surfaces, or, where only the camera moves, set scene.object-motion off",
         {{0, 1, 1}, {1, 0, 1}, {0, 0, 1}});
  using Depth = LintReading::Depth;
  LintHypothesis& depthUnit = add("depth-unit", scaledDepth<Depth::Axis>,
                                  "depth and the view matrices are in different units, such as centimetres and metres",
                                  "write depth in the units of the view matrices");
  depthUnit.ofPlaces = true;
  depthUnit.factorOf = "depth";
  add("depth-distance", depthAlongRay,
      "depth is the distance from the camera, as a ray's length, not along the view axis",
      "multiply it by the cosine of ray and view axis")
      .ofPlaces = true;
  const std::string_view linearise = "state device depth and its projection (WALR_DEPTH_DEVICE), or make it linear";
  struct Projection {
    decltype(LintHypothesis::apply) apply;
    std::string_view factorOf;
  };
  for (const auto& [apply, factorOf] : {Projection{otherProjection<true, true>, "the width and height of the view"},
                                        Projection{otherProjection<true, false>, "the width of the view"},
                                        Projection{otherProjection<false, true>, "the height of the view"}}) {
    LintHypothesis& projection = add(
        "projection", apply, "the projection has another field of view or aspect ratio than the images",
        "hand over the projection with which the frame was rendered: its focal lengths are 1 / tan(half the vertical "
        "field of view), and that divided by width / height");
    projection.ofPlaces = projection.fits = true;
    projection.factorOf = factorOf;
  }
  add("depth-device", scaledDepth<Depth::Device>,
      "depth is that of a projection, 0 near and 1 far, not linear view depth", linearise)
      .ofPlaces = true;
  add("depth-reversed", scaledDepth<Depth::Reversed>, "depth is that of a reversed projection, not linear view depth",
      linearise)
      .ofPlaces = true;
  add("camera-late", cameraLate, "the camera that is handed over is that of the frame before",
      "hand over the camera with which the frame was rendered")
      .needsNext = true;
  for (const glm::dvec3& sign : {same, xy}) {
    LintHypothesis& next = add("motion-next", toNext, "motion leads to the next frame, or from it to this one",
                               "write the motion that leads to the previous frame");
    next.needsNext = true;
    next.signs = sign;
  }
  add("motion-late", motionLate, "motion is that of the frame before", "hand over the motion of the same frame");
  addAll("view-axes", viewAxes,
         "view space is not that of the picture, where x is to the right, y up and the camera looks down -z",
         "negate the axes of the view matrix, and the z of the world if one is left-handed",
         {y * z, z, y, x, x * z, xy, xy * z});
  LintHypothesis& other = add("depth-other", depthUnknown,
                              "depth is another quantity, such as a mist or fog factor, or that of another frame",
                              "write linear view depth in the units of the view matrices");
  other.fitsStated = other.ofPlaces = true;
  return all;
}

}  // namespace

const std::vector<LintHypothesis>& lintHypotheses() {
  static const std::vector<LintHypothesis> kAll = makeHypotheses();
  return kAll;
}

}  // namespace walr
