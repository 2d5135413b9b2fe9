// What rounding the moments between iterations costs, for each storage and regularisation: the double-precision
// reference with and without storage rounding.

#include <cmath>

#include <gtest/gtest.h>

#include "tests/passes/reference/walr.h"
#include "tests/passes/synthetic_scene.h"

namespace walr::test {
namespace {

using reference::Guide;
using reference::HostFrame;
using reference::Image;
using reference::Storage;

constexpr glm::ivec2 kSize(96, 64);

glm::dvec3 toneMap(glm::dvec3 x) {
  return x / (1.0 + x);
}

/// Root mean square difference after x / (1 + x).
double toneMappedRmse(const Image<glm::dvec3>& a, const Image<glm::dvec3>& b) {
  double sum = 0.0;
  reference::forEachPixel(a.size(), [&](glm::ivec2 p) {
    const glm::dvec3 d = toneMap(a[p]) - toneMap(b[p]);
    sum += d.x * d.x + d.y * d.y + d.z * d.z;
  });
  return std::sqrt(sum / (3.0 * double(a.pixels().size())));
}

/// A wall whose light is exactly linear in the features, with exponential noise.
struct LinearSignal {
  HostFrame frame;
  Image<Guide> guides;
  Image<glm::dvec4> noisy;
  Image<glm::dvec3> truth;
};
LinearSignal linearSignal(double normalVariation) {
  LinearSignal s{
      renderStill(bumpyWall(normalVariation), kSize, 3), {}, Image<glm::dvec4>(kSize), Image<glm::dvec3>(kSize)};
  s.guides = reference::prepareGuides(s.frame, Storage::Quantised);
  const HostFrame clean = renderStill(bumpyWall(normalVariation), kSize, 3, Noise::None);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const glm::dvec2 x = s.guides[p].features;
    s.truth[p] = glm::dvec3(1.0 + x.x - 0.7 * x.y);
    // The same exponential variate that the scene's samples have.
    const double sample = s.truth[p].g * s.frame.lighting[p].g / clean.lighting[p].g;
    s.noisy[p] = glm::dvec4(glm::dvec3(reference::roundToHalf(sample)), 1.0);
  });
  return s;
}

/// Relative root mean square distance of the filtered signal to the truth.
double relativeRmse(const LinearSignal& signal, MomentStorage storage, Regularisation regularisation, double epsilon) {
  WeightedRegressionSettings settings;
  settings.storage = storage;
  settings.regularisation.method = regularisation;
  settings.regularisation.ridge = static_cast<float>(epsilon);
  settings.keepSampleCount = storage == MomentStorage::Centred16;
  const Image<glm::dvec3> out =
      reference::weightedRegression(signal.frame, signal.guides, signal.noisy, Storage::Quantised, settings);
  double error = 0.0;
  double size = 0.0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    error += std::pow(out[p].g - signal.truth[p].g, 2);
    size += std::pow(signal.truth[p].g, 2);
  });
  return std::sqrt(error / size);
}

// What a storage costs is its distance to single-precision raw moments, regularised in the same way. A storage fails
// where its error exceeds the signal, and passes where it adds less than a tenth to the error that noise leaves anyway.
TEST(Precision, EachStorageHoldsAtItsOwnEpsilonAndFailsBelowIt) {
  constexpr auto kFloor = Regularisation::Floor;
  for (const double variation : {1e-4, 1e-2, 0.1, 0.3}) {
    SCOPED_TRACE(variation);
    const LinearSignal signal = linearSignal(variation);
    const auto error = [&](MomentStorage storage, double epsilon) {
      return relativeRmse(signal, storage, kFloor, epsilon);
    };
    EXPECT_LE(error(MomentStorage::Raw16, 2e-3), 1.1 * error(MomentStorage::Raw32, 2e-3));
    EXPECT_LE(error(MomentStorage::Raw11, 1e-2), 1.1 * error(MomentStorage::Raw32, 1e-2));
    EXPECT_LE(error(MomentStorage::Centred16, 1e-4), 1.1 * error(MomentStorage::Raw32, 1e-4));
    EXPECT_GT(error(MomentStorage::Raw11, 1e-4), 1.0);
  }
  const LinearSignal bumpy = linearSignal(1e-2);
  EXPECT_GT(relativeRmse(bumpy, MomentStorage::Raw16, kFloor, 1e-5), 1.0);
  EXPECT_LE(relativeRmse(bumpy, MomentStorage::Centred16, kFloor, 1e-6),
            1.1 * relativeRmse(bumpy, MomentStorage::Raw32, kFloor, 1e-6));
}

/// The spatial filter up to the solve with moments rounded between iterations, or not; the result is not rounded.
Image<glm::dvec3> filterWith(const LinearSignal& signal, Storage storage, const WeightedRegressionSettings& settings) {
  reference::AtrousState state = reference::sampleMoments(signal.guides, signal.noisy);
  for (std::uint32_t t = 0; t < settings.iterations; ++t) {
    const bool last = t + 1 == settings.iterations;
    state =
        reference::atrousIteration(signal.frame, signal.guides, state, t, last ? Storage::Exact : storage, settings);
  }
  Image<glm::dvec3> out(kSize);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    out[p] = reference::reconstruct(state.moments[p], signal.guides[p].features, settings.regularisation).colour;
  });
  return out;
}

// The project's requirement: what rounding the moments does to the tone-mapped picture.
TEST(Precision, StorageRoundingStaysBelowItsBudget) {
  for (const double variation : {1e-3, 0.1}) {
    const LinearSignal signal = linearSignal(variation);
    const auto distance = [&](MomentStorage storage) {
      WeightedRegressionSettings settings;
      settings.storage = storage;
      settings.keepSampleCount = storage == MomentStorage::Centred16;
      // Raw storage drops the second moment of the luminance, and with it the ridge's measure of noise.
      if (storage != MomentStorage::Centred16) settings.regularisation.method = Regularisation::Floor;
      return toneMappedRmse(filterWith(signal, Storage::Exact, settings),
                            filterWith(signal, Storage::Quantised, settings));
    };
    EXPECT_LE(distance(MomentStorage::Raw32), 1e-5);
    EXPECT_LE(distance(MomentStorage::Centred16), 2e-4);
  }
}

}  // namespace
}  // namespace walr::test
