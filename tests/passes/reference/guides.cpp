#include "tests/passes/reference/guides.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "tests/passes/reference/octahedral.h"

namespace walr::reference {
namespace {

/// Relative error of an inverse. Vulkan ("Precision of core operations") allows a division 2.5 units in the last place,
/// and a unit in the last place is at most two roundoffs.
constexpr double kInverseError = 5.0 * kFloatRoundoff;
/// Relative error of a position: two roundings in the ray, the inverse depth and one division.
constexpr double kPositionError = 2.0 * kFloatRoundoff + 2.0 * kInverseError;

bool isFinite(glm::dvec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Inverse view depth; 0 outside the image and on sky.
double inverseDepthAt(const HostFrame& frame, glm::ivec2 p) {
  if (!frame.depth.contains(p)) return 0.0;
  const double z = frame.depth[p];
  return std::isfinite(z) && z > 0.0 && z < double(frame.constants.skyDepth) ? 1.0 / z : 0.0;
}

/// One-sided difference of position between a pixel and its neighbour along an axis.
struct Tangent {
  glm::dvec3 value;
  double misfit;  ///< How far the extrapolation from the two pixels on this side misses the centre's inverse depth.
  double misfitError;  ///< Bound of what single precision adds to `misfit`.
  double error;        ///< Absolute error of `value` in single precision.
};

/// Drop the second of two tangents where rounding cannot make it the better one.
void keepUndecided(std::vector<Tangent>& candidates) {
  if (candidates.size() < 2) return;
  const double gap = candidates[1].misfit - candidates[0].misfit;
  if (gap > candidates[0].misfitError + candidates[1].misfitError) candidates.pop_back();
}

/// The tangent along an axis with the smallest misfit, or nothing where both sides exceed the tolerance. The first
/// entry is the exact answer; the others are those that rounding may choose instead.
std::vector<std::optional<Tangent>> tangents(const HostFrame& frame, glm::ivec2 p, glm::ivec2 axis, double tolerance) {
  const double centreInverse = inverseDepthAt(frame, p);
  const glm::dvec3 centre = rayThrough(frame.constants.rayFromPixel, pixelCentre(p)) / centreInverse;
  const double largestMisfit = tolerance * centreInverse;
  std::vector<Tangent> found;
  for (const int side : {-1, 1}) {
    const glm::ivec2 q = p + side * axis;
    const double near = inverseDepthAt(frame, q);
    if (near == 0.0) continue;
    const double far = inverseDepthAt(frame, q + side * axis);
    const glm::dvec3 position = rayThrough(frame.constants.rayFromPixel, pixelCentre(q)) / near;
    Tangent t{};
    t.value = double(side) * (position - centre);
    t.misfit = far > 0.0 ? std::abs(2.0 * near - far - centreInverse) : std::abs(near - centreInverse);
    t.misfitError = (kInverseError + 2.0 * kFloatRoundoff) * (2.0 * near + far + centreInverse);
    t.error = kPositionError * (glm::length(position) + glm::length(centre));
    if (t.misfit <= largestMisfit + t.misfitError) found.push_back(t);
  }
  std::stable_sort(found.begin(), found.end(), [](const Tangent& a, const Tangent& b) { return a.misfit < b.misfit; });
  keepUndecided(found);
  std::vector<std::optional<Tangent>> options(found.begin(), found.end());
  if (found.empty() || found.front().misfit > largestMisfit) {
    options.insert(options.begin(), std::nullopt);
  } else if (found.front().misfit > largestMisfit - found.front().misfitError) {
    options.emplace_back(std::nullopt);
  }
  return options;
}

/// The cross product of two tangents or, with only one, the shading normal made perpendicular to it. Not normalised.
struct SpannedNormal {
  glm::dvec3 value{0.0};
  double error = 0.0;  ///< Absolute error in single precision.
};

SpannedNormal spannedNormal(const std::optional<Tangent>& x, const std::optional<Tangent>& y,
                            glm::dvec3 shadingNormal) {
  if (x && y) {
    const double sides = glm::length(x->value) + glm::length(y->value);
    return {glm::cross(y->value, x->value),
            std::max(x->error, y->error) * sides + 8.0 * kFloatRoundoff * sides * sides};
  }
  if (!x && !y) return {};
  const Tangent& only = x ? *x : *y;
  const double length = glm::length(only.value);
  return {shadingNormal * (length * length) - only.value * glm::dot(only.value, shadingNormal),
          4.0 * length * only.error + 16.0 * kFloatRoundoff * length * length};
}

}  // namespace

Surface surfaceAt(const HostFrame& frame, glm::ivec2 p, const PrepareGuidesSettings& settings) {
  const glm::dvec3 hostNormal = frame.normal[p];
  const glm::dvec3 albedo = frame.albedo[p];
  const bool hasNormal = isFinite(hostNormal) && glm::length(hostNormal) > 0.0;
  const auto least = double(settings.albedoThreshold);
  const bool hasLobe = least == 0.0 || (isFinite(albedo) && std::max({albedo.x, albedo.y, albedo.z}) >= least);
  if (inverseDepthAt(frame, p) == 0.0 || !hasNormal || !hasLobe) return {};

  glm::dvec3 normal = glm::normalize(hostNormal);
  if (frame.conventions.normal == InputConventions::Space::World) {
    normal = glm::normalize(glm::dmat3(frame.constants.viewFromWorld) * normal);
  }
  const glm::dvec3 ray = rayThrough(frame.constants.rayFromPixel, pixelCentre(p));
  return {frame.depth[p], glm::dot(normal, ray) > 0.0 ? -normal : normal};
}

std::vector<NormalCandidate> geometricNormals(const HostFrame& frame, glm::ivec2 p, const Surface& surface,
                                              const PrepareGuidesSettings& settings) {
  const auto alongX = tangents(frame, p, {1, 0}, double(settings.tangentTolerance));
  const auto alongY = tangents(frame, p, {0, 1}, double(settings.tangentTolerance));
  const NormalCandidate shading{surface.shadingNormal, 8.0 * kFloatRoundoff};
  std::vector<NormalCandidate> candidates;
  for (const auto& x : alongX) {
    for (const auto& y : alongY) {
      const auto [n, absoluteError] = spannedNormal(x, y, surface.shadingNormal);
      const double area = glm::length(n);
      if (!(area > 0.0)) {
        candidates.push_back(shading);
        continue;
      }
      const double error = absoluteError / area;
      const double agreement = glm::dot(n / area, surface.shadingNormal) - double(settings.normalAgreement);
      const bool shadingWins = agreement < 0.0;
      const NormalCandidate geometric{n / area, error};
      candidates.push_back(shadingWins ? shading : geometric);
      if (std::abs(agreement) <= error + 16.0 * kFloatRoundoff) candidates.push_back(shadingWins ? geometric : shading);
    }
  }
  return candidates;
}

double ambientOcclusion(const HostFrame& frame, glm::ivec2 p, const Surface& surface,
                        const AmbientOcclusionSettings& settings) {
  const auto rayAt = [&](glm::ivec2 q) { return rayThrough(frame.constants.rayFromPixel, pixelCentre(q)); };
  const double radius = std::max(double(settings.radius) * frame.size().y, 1.0);
  const double reach = radius * std::abs(double(frame.constants.rayFromPixel.x));
  double sum = 0.0;
  for (int i = 0; i < 9; ++i) {
    const glm::ivec2 direction = glm::ivec2(i % 3, i / 3) - 1;
    if (direction == glm::ivec2(0)) continue;
    double horizon = 0.0;
    for (std::uint32_t step = 1; step <= settings.steps; ++step) {
      const double share = double(step) / settings.steps;
      const int distance = std::max(static_cast<int>(radius * share * share), static_cast<int>(step));
      const glm::ivec2 q = p + distance * direction;
      const double inverseDepth = inverseDepthAt(frame, q);
      if (inverseDepth == 0.0) continue;
      const glm::dvec3 v = rayAt(q) / (inverseDepth * surface.depth) - rayAt(p);
      const double length = glm::length(v);
      const double fade = std::max(1.0 - length * length / (reach * reach), 0.0);
      horizon = std::max(horizon, fade * glm::dot(surface.shadingNormal, v) / length);
    }
    sum += horizon;
  }
  return sum / 8.0;
}

Image<Guide> prepareGuides(const HostFrame& frame, Storage storage, const PrepareGuidesSettings& settings,
                           const std::optional<AmbientOcclusionSettings>& occlusion) {
  Image<Guide> guides(frame.size());
  forEachPixel(frame.size(), [&](glm::ivec2 p) {
    const Surface surface = surfaceAt(frame, p, settings);
    if (surface.depth == 0.0) return;
    Guide guide{surface.depth, octahedralEncode(surface.shadingNormal),
                geometricNormals(frame, p, surface, settings).front().normal};
    if (frame.objectId.contains(p)) guide.object = frame.objectId[p] + 1U;
    if (occlusion) guide.occlusion = ambientOcclusion(frame, p, surface, *occlusion);
    if (storage == Storage::Quantised) {
      const glm::dvec2 features = guide.features;
      guide.depth = roundDepth(guide.depth);
      guide.features = occlusion
                           ? glm::dvec2(roundToUnorm(features.x, kUnorm12Step), roundToUnorm(features.y, kUnorm12Step))
                           : roundToUnorms(features);
      guide.occlusion = roundToUnorm(guide.occlusion, kUnorm8Step);
      guide.normal = occlusion ? roundToShortNormal(guide.normal) : roundToNormal(guide.normal);
    }
    guides[p] = guide;
  });
  return guides;
}

}  // namespace walr::reference
