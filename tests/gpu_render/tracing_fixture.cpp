#include "tests/gpu_render/tracing_fixture.h"

#include <cstdlib>
#include <iostream>

namespace walr::gpu_render::test {
namespace {

// For Mesa's software driver, LLVM takes minutes to optimise the path tracer's shader, far longer than the tests take
// without. Set before the driver is loaded, which reads it once.
[[maybe_unused]] const bool kWithoutOptimisation = setenv("GALLIVM_PERF", "nopt", 0) == 0;

}  // namespace

void TracingTest::SetUp() {
  if (!gpu.missingForRayQueries().empty()) {
    GTEST_SKIP() << "not run: the device " << gpu.name() << ", driver " << gpu.driver() << ", lacks "
                 << gpu.missingForRayQueries();
  }
  std::cout << "traced by " << gpu.name() << ", driver " << gpu.driver() << '\n';
}

void TracingTest::TearDown() {
  EXPECT_NO_THROW(gpu.refuseMessages());
}

}  // namespace walr::gpu_render::test
