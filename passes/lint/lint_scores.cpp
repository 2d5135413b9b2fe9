#include "passes/lint/lint_scores.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "passes/conventions/camera_check.h"

namespace walr {
namespace {

constexpr double kFits = 0.5;      // Of 0 to 1.
constexpr double kClearly = 1.03;  // Ratio of gains.

/// 1 where motion is that of the prediction, 0 where it is farther away than the tolerance.
double agreement(glm::dvec2 given, const LintPrediction& seen) {
  const glm::dvec2 error = glm::abs(given - seen.given) / seen.tolerance;
  return std::max(0.0, 1.0 - std::max(error.x, error.y));
}

/// Whether `given` is `expected`, within a quarter.
bool isAbout(double given, double expected) {
  return std::abs(given - expected) < 0.25 * std::abs(expected);
}

void countDepth(LintScore& score, const LintSample& sample, double away) {
  if (!(std::abs(away) > 0.005 * sample.depth)) return;
  ++score.depth.tested;
  score.depth.opposite += isAbout(sample.motion.z, -away) ? 1 : 0;
  score.depth.none += std::abs(sample.motion.z) < 1e-4 * std::abs(away) ? 1 : 0;
}

/// A sample with what the stated reading says of it.
struct Stated {
  const LintSample* sample;
  glm::dvec2 given;
  LintPrediction seen;
  double agreement;
  bool parallax;  ///< It depends on depth.
};

std::vector<Stated> readAsStated(const LintFrame& frame, const LintReading& stated) {
  std::vector<Stated> read;
  for (const LintSample& sample : frame.samples) {
    const glm::dvec2 given = frame.motionOf(sample);
    if (!std::isfinite(given.x) || !std::isfinite(given.y)) continue;
    const LintPrediction seen = predict(frame, stated, sample);
    const double parallax = glm::length(seen.motion - motionOfRotation(stated, sample));
    read.push_back({&sample, given, seen, agreement(given, seen), parallax > 2.0 * glm::length(seen.tolerance)});
  }
  return read;
}

void addSample(LintScore& score, const LintHypothesis& mistake, const Stated& stated, const LintPrediction& seen) {
  const double fit = agreement(stated.given, seen);
  ++score.samples;
  score.gain += fit - stated.agreement;
  bool differs = false;
  for (int axis = 0; axis < 2; ++axis) {
    const bool apart =
        std::abs(seen.given[axis] - stated.seen.given[axis]) > seen.tolerance[axis] + stated.seen.tolerance[axis];
    score.axes.at(std::size_t(axis)) += apart ? 1 : 0;
    differs = differs || apart;
  }
  // What explains all that the stated reading does is the poorer explanation wherever that one holds, too.
  const bool poorer = mistake.fitsStated && stated.parallax && stated.agreement > kFits;
  score.tested += differs || poorer ? 1 : 0;
  score.better += differs && fit > stated.agreement + kFits ? 1 : 0;
  score.worse += poorer || (differs && stated.agreement > fit + kFits) ? 1 : 0;
  if (fit > kFits && !mistake.ofPlaces) countDepth(score, *stated.sample, seen.away);
}

}  // namespace

bool LintScore::explains(const LintHypothesis& mistake) const {
  if (better < kLeastLintSample || 2 * better <= tested || better <= 20 * worse) return false;
  if (mistake.alternates && jitterLength <= 2.0 * glm::length(jitterSum)) return false;
  return glm::all(glm::lessThan(mostFitted, 1.1 * leastFitted));  // A unit stays the same.
}

std::optional<std::size_t> LintScores::best() const {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < mistakes.size(); ++i) {
    if (!mistakes[i].explains(lintHypotheses()[i])) continue;
    // What explains nearly anything must explain much more.
    const double clearly = lintHypotheses()[i].fitsStated ? 1.2 : kClearly;
    if (!found || mistakes[i].meanGain() > clearly * mistakes[*found].meanGain()) found = i;
  }
  return found;
}

std::string LintScores::rivals(std::size_t best) const {
  std::string names;
  for (std::size_t i = 0; i < mistakes.size(); ++i) {
    const LintHypothesis& mistake = lintHypotheses()[i];
    const bool named = mistake.name == lintHypotheses()[best].name || names.find(mistake.name) != std::string::npos;
    if (named || mistake.fitsStated || !mistakes[i].explains(mistake)) continue;
    if (kClearly * mistakes[i].meanGain() > mistakes[best].meanGain())
      names.append(names.empty() ? "" : ", ").append(mistake.name);
  }
  return names;
}

void LintOrder::add(const FrameDescription& last, const FrameDescription& camera) {
  // From one camera's view space to another's: a host may move the origin of its matrices.
  const auto same = [&](const glm::mat4& a, const glm::dvec3& aOrigin, const glm::mat4& b, const glm::dvec3& bOrigin) {
    return sameView(glm::mat4(viewFromView(camera, glm::dmat4(a), aOrigin)),
                    glm::mat4(viewFromView(camera, glm::dmat4(b), bOrigin)));
  };
  ++frames;
  if (same(camera.previousView, camera.previousOrigin, last.view, last.origin)) return;
  ++foreign;
  still += same(camera.previousView, camera.previousOrigin, camera.view, camera.origin) ? 1 : 0;
  repeated += same(camera.view, camera.origin, last.view, last.origin) ? 1 : 0;
  reversed += same(camera.view, camera.origin, last.previousView, last.previousOrigin) ? 1 : 0;
}

void LintMotion::score(LintScores& scores, const LintContext& context) const {
  const LintFrame& frame = context.frame;
  const LintReading stated = statedReading(frame, context.motionJittered);
  const std::vector<Stated> samples = readAsStated(frame, stated);
  const bool withNext = context.next != nullptr;
  if (!withNext) {
    ++scores.frames;
    for (const Stated& sample : samples) {
      constexpr double kLeastMotion = 0.25;  // Pixels.
      const bool moves = glm::length(sample.seen.motion) > kLeastMotion;
      scores.stated.moving += moves ? 1 : 0;
      scores.stated.movingFits += moves && sample.agreement > kFits ? 1 : 0;
      if (sample.agreement > kFits) countDepth(scores.stated, *sample.sample, sample.seen.away);
    }
  }
  const auto fitting = std::ranges::count_if(samples, [](const Stated& sample) { return sample.agreement > kFits; });
  const bool explained = 10 * std::size_t(fitting) > 9 * samples.size();
  for (std::size_t i = 0; i < lintHypotheses().size(); ++i) {
    const LintHypothesis& mistake = lintHypotheses()[i];
    LintReading reading = stated;
    if (mistake.needsNext != withNext || (mistake.fits && explained)) continue;
    if (!mistake.apply(context, mistake.signs, reading)) continue;
    LintScore& score = scores.mistakes[i];
    score.jitterSum += reading.inMotion;
    score.jitterLength += glm::length(reading.inMotion);
    const std::uint64_t tested = score.tested;
    const std::uint64_t better = score.better;
    const bool samePlaces = reading.samePlaces(stated);
    for (const Stated& sample : samples) {
      const LintPrediction seen =
          samePlaces ? predict(frame, reading, stated, sample.seen) : predict(frame, reading, *sample.sample);
      addSample(score, mistake, sample, seen);
    }
    if (2 * (score.better - better) <= score.tested - tested) continue;
    score.leastFitted = glm::min(score.leastFitted, reading.fitted);
    score.mostFitted = glm::max(score.mostFitted, reading.fitted);
  }
}

void LintMotion::countRounding(const LintFrame& frame) {
  // Each component of the translation is off by half a unit in the last place, in this frame and in the previous one.
  const double rounding = glm::length(glm::dvec3(frame.camera.view[3])) * 0x1p-23;
  constexpr double kMost = 0.1;  // Pixels, as much as the errors of a matrix that is accepted (camera_check.cpp).
  surfaces_ += frame.samples.size();
  rounded_ += std::uint64_t(std::ranges::count_if(frame.samples, [&](const LintSample& sample) {
    return rounding > kMost * sample.depth * std::abs(double(frame.constants.rayFromPixel.x));
  }));
}

void LintMotion::add(LintFrame frame) {
  countRounding(frame);
  const LintFrame* const last = last_ ? &*last_ : nullptr;
  if (last != nullptr) order_.add(last->camera, frame.camera);
  const bool jittered = conventions_.motionJittered;
  if (frame.continues) {
    score(continued_, {.frame = frame, .last = last, .motionJittered = jittered});
    if (last != nullptr && last->continues)
      score(continued_, {.frame = *last, .next = &frame, .motionJittered = jittered});
  } else if (last != nullptr) {
    // As if it were no cut.
    const FrameDescription stated = frame.camera;
    frame.camera.previousView = last->camera.view;
    frame.camera.previousOrigin = last->camera.origin;
    score(cuts_, {.frame = frame, .last = last, .motionJittered = jittered});
    frame.camera = stated;
  }
  last_ = std::move(frame);
}

}  // namespace walr
