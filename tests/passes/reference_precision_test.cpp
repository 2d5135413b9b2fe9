// The cost of rounding the moments between iterations, for each storage and regularisation: the double-precision
// reference with and without storage rounding.

#include <cmath>

#include <gtest/gtest.h>

#include "tests/passes/linear_signal.h"
#include "tests/passes/reference/walr.h"

namespace walr::test::reference_precision_test {
namespace {

using reference::Image;
using reference::Storage;

constexpr glm::ivec2 kSize(96, 64);

glm::dvec3 toneMap(glm::dvec3 x) {
  return x / (1.0 + x);
}

/// Root mean square difference after the tone map x / (1 + x).
double toneMappedRmse(const Image<glm::dvec3>& a, const Image<glm::dvec3>& b) {
  double sum = 0.0;
  reference::forEachPixel(a.size(), [&](glm::ivec2 p) {
    const glm::dvec3 d = toneMap(a[p]) - toneMap(b[p]);
    sum += d.x * d.x + d.y * d.y + d.z * d.z;
  });
  return std::sqrt(sum / (3.0 * double(a.pixels().size())));
}

Image<glm::dvec4> withLength(const Image<glm::dvec3>& colours) {
  Image<glm::dvec4> result(colours.size());
  reference::forEachPixel(colours.size(), [&](glm::ivec2 p) { result[p] = glm::dvec4(colours[p], 1.0); });
  return result;
}

/// Relative root mean square error of the filtered signal.
double relativeRmse(const LinearSignal& signal, MomentStorage storage, Regularisation regularisation, double epsilon) {
  WeightedRegressionSettings settings;
  settings.storage = storage;
  settings.regularisation.method = regularisation;
  settings.regularisation.ridge = static_cast<float>(epsilon);
  settings.keepSampleCount = storage == MomentStorage::Centred16;
  return relativeRmse(signal,
                      reference::weightedRegression(signal.frame, signal.guides, withLength(signal.frame.lighting),
                                                    Storage::Quantised, settings));
}

// The cost of a storage is its distance to single-precision raw moments with the same regularisation. A storage fails
// where its error exceeds the signal, and passes where it adds less than a tenth to the error that noise leaves anyway.
TEST(Precision, EachStorageHoldsAtItsOwnEpsilonAndFailsBelowIt) {
  constexpr auto kFloor = Regularisation::Floor;
  for (const double variation : {1e-4, 1e-2, 0.1, 0.3}) {
    SCOPED_TRACE(variation);
    const LinearSignal signal = linearSignal(kSize, variation);
    const auto error = [&](MomentStorage storage, double epsilon) {
      return relativeRmse(signal, storage, kFloor, epsilon);
    };
    EXPECT_LE(error(MomentStorage::Raw16, 2e-3), 1.1 * error(MomentStorage::Raw32, 2e-3));
    EXPECT_LE(error(MomentStorage::Raw11, 1e-2), 1.1 * error(MomentStorage::Raw32, 1e-2));
    EXPECT_LE(error(MomentStorage::Centred16, 1e-4), 1.1 * error(MomentStorage::Raw32, 1e-4));
    EXPECT_GT(error(MomentStorage::Raw11, 1e-4), 1.0);
  }
  const LinearSignal bumpy = linearSignal(kSize, 1e-2);
  EXPECT_GT(relativeRmse(bumpy, MomentStorage::Raw16, kFloor, 1e-5), 1.0);
  EXPECT_LE(relativeRmse(bumpy, MomentStorage::Centred16, kFloor, 1e-6),
            1.1 * relativeRmse(bumpy, MomentStorage::Raw32, kFloor, 1e-6));
}

/// The spatial filter up to the solve, with or without rounding of moments between iterations; the result is not
/// rounded.
Image<glm::dvec3> filterWith(const LinearSignal& signal, Storage storage, const WeightedRegressionSettings& settings) {
  reference::AtrousState state = reference::sampleMoments(signal.guides, withLength(signal.frame.lighting));
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

// The project's limit for the effect of rounded moments on the tone-mapped image.
TEST(Precision, StorageRoundingStaysBelowItsBudget) {
  for (const double variation : {1e-3, 0.1}) {
    const LinearSignal signal = linearSignal(kSize, variation);
    const auto distance = [&](MomentStorage storage) {
      WeightedRegressionSettings settings;
      settings.storage = storage;
      settings.keepSampleCount = storage == MomentStorage::Centred16;
      // Raw storage drops the second moment of the luminance, from which the ridge measures the noise.
      if (storage != MomentStorage::Centred16) settings.regularisation.method = Regularisation::Floor;
      return toneMappedRmse(filterWith(signal, Storage::Exact, settings),
                            filterWith(signal, Storage::Quantised, settings));
    };
    EXPECT_LE(distance(MomentStorage::Raw32), 1e-5);
    EXPECT_LE(distance(MomentStorage::Centred16), 2e-4);
  }
}

}  // namespace
}  // namespace walr::test::reference_precision_test
