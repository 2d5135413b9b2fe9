// Normals compared with the slope of depth.
#include "passes/lint/lint_normals.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "passes/lint/lint_judge.h"

namespace walr {
namespace {

constexpr double kFittingCosine = 0.8;  // A random normal that faces the camera is nearer with a probability of 0.2.

bool isSmooth(double before, double here, double after, float skyDepth) {
  return before > 0.0 && after > 0.0 && before < skyDepth && after < skyDepth &&
         std::abs(before + after - 2.0 * here) < 0.1 * std::abs(after - before) + 1e-3 * here;
}

/// View depth from what the host wrote, up to a constant factor, which does not change slopes.
double assumedDepth(std::size_t mistake, double depth, const glm::dvec3& ray) {
  switch (mistake) {
    case LintNormals::ReversedDepth:
      return 1.0 / depth;
    case LintNormals::DeviceDepth:
      return 1.0 / std::max(1.0 - depth, 1e-7);
    case LintNormals::Distance:
      return depth / glm::length(ray);
    default:
      return depth;
  }
}

/// Normal of the surface that depth shows.
glm::dvec3 slopeNormal(const LintFrame& frame, const LintSample& sample, std::size_t mistake) {
  const auto position = [&](glm::dvec2 offset, double depth) {
    const glm::dvec3 ray = frame.rayThrough(sample.pixel + offset);
    return ray * assumedDepth(mistake, depth, ray);
  };
  const auto& [left, right, above, below] = sample.around;
  return glm::normalize(glm::cross(position({0, 1}, below) - position({0, -1}, above),
                                   position({1, 0}, right) - position({-1, 0}, left)));
}

}  // namespace

void LintNormals::add(const LintFrame& frame) {
  for (const LintSample& sample : frame.samples) add(frame, sample);
}

void LintNormals::add(const LintFrame& frame, const LintSample& sample) {
  const auto& [left, right, above, below] = sample.around;
  const double length = glm::length(sample.normal);
  if (!std::isfinite(length) || !(length > 0.0)) return;
  if (!isSmooth(left, sample.depth, right, frame.camera.skyDepth)) return;
  if (!isSmooth(above, sample.depth, below, frame.camera.skyDepth)) return;
  const glm::dmat3 view(frame.camera.view);
  const auto inView = [&](const glm::dvec3& normal, bool world) {
    return glm::normalize(world ? view * normal : normal);
  };
  const glm::dvec3 stated = inView(sample.normal, world_);
  const glm::dvec3 slope = slopeNormal(frame, sample, kMistakes);
  const double fit = std::abs(glm::dot(stated, slope));
  if (!std::isfinite(fit)) return;
  ++tested_;
  fits_ += fit > kFittingCosine ? 1 : 0;
  for (std::size_t mistake = 0; mistake < kMistakes; ++mistake) {
    glm::dvec3 assumed = stated;
    if (mistake == OtherSpace) assumed = inView(sample.normal, !world_);
    const glm::dvec3& n = sample.normal;
    if (mistake == ZUp) assumed = inView({n.x, n.z, -n.y}, world_);
    if (mistake == YUp) assumed = inView({n.x, -n.z, n.y}, world_);
    if (mistake == ExchangedYZ) assumed = inView({n.x, n.z, n.y}, world_);
    if (mistake == FlippedY) assumed = inView(sample.normal * glm::dvec3(1, -1, 1), world_);
    if (mistake == InvertedView && world_) assumed = glm::normalize(sample.normal * view);
    const bool ofDepth = mistake == ReversedDepth || mistake == DeviceDepth || mistake == Distance;
    const double otherFit = std::abs(glm::dot(assumed, ofDepth ? slopeNormal(frame, sample, mistake) : slope));
    if (!std::isfinite(otherFit)) continue;
    gain_.at(mistake) += otherFit - fit;
    constexpr double kMargin = 0.02;
    better_.at(mistake) += otherFit > fit + kMargin ? 1 : 0;
    worse_.at(mistake) += fit > otherFit + kMargin ? 1 : 0;
  }
}

std::size_t LintNormals::best() const {
  std::size_t found = kMistakes;
  for (std::size_t i = 0; i < kMistakes; ++i) {
    const bool explains = better(i) >= kLeastLintSample && better(i) > 3 * worse(i) && 10 * better(i) > tested_;
    if (explains && (found == kMistakes || gain_.at(i) > gain_.at(found))) found = i;
  }
  return found;
}

void LintJudge::judgeNormals() {
  struct Cause {
    std::string_view name;
    std::string_view cause;
    std::string_view wayOut;
  };
  static constexpr Cause kAxes{"normal-axes", "y and z of normals are exchanged, as in a world with another axis up",
                               "exchange them, and negate one of them if the sense of rotation changes"};
  static constexpr std::array<Cause, LintNormals::kMistakes> kCauses{{
      {"normal-space", "normals are in world space though stated in view space, or the other way about",
       "state the other space (WalrConventions::normal_space, InputConventions::normal)"},
      {"normal-y",
       "normals have y down, as those of a picture or of another handedness, or all images have their last row first",
       "negate the y of normals, or hand over all images with their first row at the top"},
      {"depth-reversed", "depth is that of a reversed projection, not linear view depth",
       "state device depth and its projection (WALR_DEPTH_DEVICE), or make it linear"},
      {"depth-device", "depth is that of a projection, 0 near and 1 far, not linear view depth",
       "state device depth and its projection (WALR_DEPTH_DEVICE), or make it linear"},
      {"depth-distance", "depth is the distance from the camera, as a ray's length, not along the view axis",
       "multiply it by the cosine of ray and view axis"},
      {"view-inverted", "the view matrix that is handed over is its inverse, which leads from view to world space",
       "hand over the matrix from world to view space"},
      kAxes,
      kAxes,
      kAxes,
  }};
  if (isMost(counts_[kLintNormalNotUnit], counts_[kLintSurfaces])) return;  // A wrong encoding explains them.
  const std::optional<std::size_t> mistake = motion_.continued().best();
  // Where the camera moves, motion tells more about positions than slopes do. A wrong view matrix turns normals, too.
  const bool world = conventions_.normal == InputConventions::Space::World;
  if (mistake && lintHypotheses()[*mistake].ofPlaces) return;
  if (mistake && world && lintHypotheses()[*mistake].name.starts_with("view-")) return;
  const std::uint64_t tested = normals_.tested();
  const std::size_t best = normals_.best();
  if (best < LintNormals::kMistakes) {
    add({kCauses.at(best).name,
         "normals and the slope of depth agree better on " + share(normals_.better(best), tested, "smooth samples") +
             ", and worse on " + std::to_string(normals_.worse(best)) + ", if read another way",
         kCauses.at(best).cause, kCauses.at(best).wayOut});
    return;
  }
  if (tested < kLeastLintSample || double(normals_.fits()) > 2.0 * (1.0 - kFittingCosine) * double(tested)) return;
  add({"normal-depth",
       "normals agree with the slope of depth on no more than " + share(normals_.fits(), tested, "smooth samples") +
           ", where directions at random do on 20 %",
       "normals and depth are of different frames, cameras or conventions, or the projection is another",
       "compare both with the matrices that are handed over"});
}

}  // namespace walr
