// The epsilon that each storage of the moments needs, on a device: the table of design goals, for a signal that is
// linear in the features. A storage that is said to fail must fail.

#include <string>

#include "tests/passes/linear_signal.h"
#include "tests/passes/walr_run.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::walr_precision_test {
namespace {

constexpr glm::ivec2 kSize(98, 66);

class WalrPrecisionTest : public fg::test::GpuTest {
 protected:
  [[nodiscard]] double error(const LinearSignal& signal, MomentStorage storage, Regularisation method,
                             double epsilon) const {
    WalrPaperSettings settings = robustWalr();
    settings.spatialOnly = true;
    settings.regression.storage = storage;
    settings.regression.keepSampleCount = storage == MomentStorage::Centred16;
    settings.regression.regularisation = {method, static_cast<float>(epsilon), 0.0F};
    WalrRun run(device(), kSize, settings, {}, false);
    return relativeRmse(signal, run.frame(signal.frame).output);
  }
};

// A storage fails where its error exceeds the signal. It passes where it adds less than a tenth to the error that noise
// leaves at the same epsilon in single precision.
TEST_F(WalrPrecisionTest, EachStorageHoldsAtItsOwnEpsilonAndFailsBelowIt) {
  for (const Regularisation method : {Regularisation::Floor, Regularisation::Ridge}) {
    for (const double variation : {1e-4, 1e-3, 1e-2, 0.1, 0.3}) {
      SCOPED_TRACE("normals vary by " + std::to_string(variation) +
                   (method == Regularisation::Floor ? ", floor" : ", ridge"));
      const LinearSignal signal = linearSignal(kSize, variation);
      const auto ratio = [&](MomentStorage storage, double epsilon) {
        return error(signal, storage, method, epsilon) / error(signal, MomentStorage::Raw32, method, epsilon);
      };
      EXPECT_LE(ratio(MomentStorage::Raw16, 2e-3), 1.1);
      EXPECT_LE(ratio(MomentStorage::Raw11, 1e-2), 1.1);
      EXPECT_LE(ratio(MomentStorage::Centred16, 1e-4), 1.1);
      EXPECT_LE(ratio(MomentStorage::Centred16, 1e-3), 1.1);
      if (method == Regularisation::Ridge) continue;
      EXPECT_GT(error(signal, MomentStorage::Raw11, method, 1e-4), 1.0);
    }
  }
  const LinearSignal bumpy = linearSignal(kSize, 1e-2);
  EXPECT_GT(error(bumpy, MomentStorage::Raw16, Regularisation::Floor, 1e-5), 1.0);
  EXPECT_GT(error(bumpy, MomentStorage::Raw16, Regularisation::Floor, 1e-6), 1.0);
  EXPECT_LT(error(bumpy, MomentStorage::Centred16, Regularisation::Floor, 1e-6), 0.1);
}

}  // namespace
}  // namespace walr::test::walr_precision_test
