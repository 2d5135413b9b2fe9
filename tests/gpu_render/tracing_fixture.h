#pragma once

#include <gtest/gtest.h>

#include "samples/denoise/gpu_device.h"

namespace walr::gpu_render::test {

/// A test on a device with ray queries, under synchronization validation. It fails on any message of the layer, and is
/// skipped on a device without ray queries.
class TracingTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  GpuDevice gpu{{.device = {}, .validation = true, .rayQueries = true}};
};

}  // namespace walr::gpu_render::test
