#include "tests/passes/reference/moments.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace walr::reference {
namespace {

constexpr int kLuma2 = 14;
constexpr int kSamples = 15;

/// The products of means by which raw and centred moments differ; 0 for the means themselves.
Moments meanProducts(const Moments& m) {
  return {.xx = {m.x.x * m.x.x, m.x.x * m.x.y, m.x.y * m.x.y}, .yu = m.y * m.x.x, .yv = m.y * m.x.y};
}

/// Moments of a set of samples about a given point instead of about its own mean.
MomentValues about(const Moments& m, glm::dvec2 originX, glm::dvec3 originY) {
  Moments shifted = m;
  shifted.x -= originX;
  shifted.y -= originY;
  shifted.samples = 1.0;
  return toArray(toRaw(shifted));
}

}  // namespace

MomentValues toArray(const Moments& m) {
  return {m.x.x,  m.x.y,  m.y.r,  m.y.g,  m.y.b,  m.xx.x, m.xx.y,  m.xx.z,
          m.yu.r, m.yu.g, m.yu.b, m.yv.r, m.yv.g, m.yv.b, m.luma2, m.samples};
}

Moments fromArray(const MomentValues& a) {
  return {.x = {a[0], a[1]},
          .y = {a[2], a[3], a[4]},
          .xx = {a[5], a[6], a[7]},
          .yu = {a[8], a[9], a[10]},
          .yv = {a[11], a[12], a[13]},
          .luma2 = a[kLuma2],
          .samples = a[kSamples]};
}

Moments toRaw(const Moments& centred) {
  MomentValues values = toArray(centred);
  const MomentValues products = toArray(meanProducts(centred));
  for (int k = 0; k < kMomentCount; ++k) values[k] += products[k];
  return fromArray(values);
}

Moments toCentred(const Moments& raw) {
  MomentValues values = toArray(raw);
  const MomentValues products = toArray(meanProducts(raw));
  for (int k = 0; k < kMomentCount; ++k) values[k] -= products[k];
  return fromArray(values);
}

const char* momentName(int index) {
  constexpr std::array kNames{"X_u",    "X_v",    "Y_r",    "Y_g",    "Y_b",    "XX_uu",  "XX_uv", "XX_vv",
                              "YX_u_r", "YX_u_g", "YX_u_b", "YX_v_r", "YX_v_g", "YX_v_b", "luma2", "W"};
  return kNames[index];
}

double luminance(glm::dvec3 colour) {
  return 0.2126 * colour.r + 0.7152 * colour.g + 0.0722 * colour.b;
}

Moments momentsOf(glm::dvec2 features, glm::dvec4 accumulated) {
  const glm::dvec3 colour(accumulated);
  const double l = luminance(colour);
  return {.x = features, .y = colour, .luma2 = l * l, .samples = accumulated.w > 0.0 ? 1.0 : 0.0};
}

MergedMoments merge(const WeightedMoments* parts, int count, int additions) {
  double weightSum = 0.0;
  glm::dvec2 meanX(0.0);
  glm::dvec3 meanY(0.0);
  for (int i = 0; i < count; ++i) {
    const double w = parts[i].weight * parts[i].moments.samples;
    weightSum += w;
    meanX += w * parts[i].moments.x;
    meanY += w * parts[i].moments.y;
  }
  if (weightSum == 0.0) {
    MergedMoments none{.moments = {.x = parts[0].moments.x, .y = parts[0].moments.y}};
    for (int i = 0; i < count; ++i) none.error[kSamples] += parts[i].weightError * parts[i].moments.samples;
    return none;
  }
  meanX /= weightSum;
  meanY /= weightSum;

  MomentValues mean{};
  for (int i = 0; i < count; ++i) {
    const double w = parts[i].weight * parts[i].moments.samples / weightSum;
    const MomentValues part = about(parts[i].moments, meanX, meanY);
    for (int k = 0; k < kMomentCount; ++k) mean[k] += w * part[k];
  }
  mean[0] = meanX.x;
  mean[1] = meanX.y;
  for (int c = 0; c < 3; ++c) mean[2 + c] = meanY[c];

  MergedMoments merged{};
  mean[kSamples] = weightSum;
  merged.moments = fromArray(mean);

  // Error bounds. Each addition rounds once. Seven further roundings come from the differences, the products, the
  // division and the final correction. In the worst case differences are taken about the centre.
  double weightErrorSum = 0.0;
  for (int i = 0; i < count; ++i) weightErrorSum += parts[i].weightError * parts[i].moments.samples;
  // The sum of weights errs too, which makes the relative weights err by this factor more.
  const double shareOfRest = 1.0 / std::max(1.0 - weightErrorSum / weightSum, 0.5);
  const double roundings = (additions + 7.0) * kFloatRoundoff;
  const Moments& centre = parts[0].moments;
  const MomentValues result = toArray(merged.moments);
  for (int i = 0; i < count; ++i) {
    const WeightedMoments& part = parts[i];
    const double w = part.weight * part.moments.samples / weightSum;
    const double weightError = part.weightError * part.moments.samples / weightSum;
    const MomentValues aboutCentre = about(part.moments, centre.x, centre.y);
    const MomentValues aboutMean = about(part.moments, meanX, meanY);
    const MomentValues products =
        toArray(meanProducts({.x = glm::abs(part.moments.x - centre.x), .y = glm::abs(part.moments.y - centre.y)}));
    // Effect of errors in the part's means on the products of differences.
    const glm::dvec2 dx = glm::abs(part.moments.x - meanX);
    const glm::dvec3 dy = glm::abs(part.moments.y - meanY);
    const glm::dvec2 ex(part.error[0], part.error[1]);
    const glm::dvec3 ey(part.error[2], part.error[3], part.error[4]);
    const MomentValues productErrors = toArray({.xx = {2.0 * dx.x * ex.x, dx.x * ex.y + dx.y * ex.x, 2.0 * dx.y * ex.y},
                                                .yu = dy * ex.x + ey * dx.x,
                                                .yv = dy * ex.y + ey * dx.y});
    for (int k = 0; k < kMomentCount; ++k) {
      // An error of a weight moves each average by its difference from the part.
      const double pull = k < 5 ? aboutMean[k] : aboutMean[k] - result[k];
      merged.error[k] += roundings * w * (std::abs(aboutCentre[k]) + products[k]) +
                         shareOfRest * weightError * std::abs(pull) + w * (part.error[k] + productErrors[k]);
    }
  }
  merged.error[kSamples] += weightErrorSum;
  for (int k = 0; k < 5; ++k) merged.error[k] += 2.0 * kFloatRoundoff * std::abs(result[k]);
  merged.error[kSamples] += roundings * weightSum;
  return merged;
}

Moments roundMoments(const Moments& m, MomentStorage storage) {
  if (m.samples == 0.0) return {};
  const bool centred = storage == MomentStorage::Centred16;
  MomentValues a = toArray(centred ? m : toRaw(m));
  a[kLuma2] = std::sqrt(a[kLuma2]);
  for (int k = 0; k < kMomentCount; ++k) {
    // Packed in threes into R11G11B10: (r, g, b), (uu, uv, vv), (u, v, -).
    const bool blue = k == 4 || k == 7 || k == 10 || k == 13;
    switch (storage) {
      case MomentStorage::Centred16:
      case MomentStorage::Raw16:
        a[k] = roundToFiniteHalf(a[k]);
        break;
      case MomentStorage::Raw11:
        a[k] = roundToUnsignedFloat(a[k], blue ? 5 : 6);
        break;
      case MomentStorage::Raw32:
        a[k] = roundToFloat(a[k]);
        break;
    }
  }
  if (centred) {
    a[kLuma2] *= a[kLuma2];
    return fromArray(a);
  }
  a[kLuma2] = 0.0;
  a[kSamples] = 1.0;
  return toCentred(fromArray(a));
}

MomentValues loadError(const Moments& m, MomentStorage storage) {
  MomentValues error{};
  if (storage == MomentStorage::Centred16) return error;
  const MomentValues products = toArray(meanProducts(m));
  for (int k = 0; k < kMomentCount; ++k) error[k] = 3.0 * kFloatRoundoff * std::abs(products[k]);
  return error;
}

MomentValues sampleError(const Moments& m) {
  MomentValues error{};
  error[0] = error[1] = kFloatRoundoff;
  error[kLuma2] = 8.0 * kFloatRoundoff * m.luma2;
  return error;
}

}  // namespace walr::reference
