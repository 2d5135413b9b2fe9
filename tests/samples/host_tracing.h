#pragma once

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "framegraph/declare/graph.h"
#include "samples/denoise/gpu_device.h"
#include "samples/host/tracer.h"
#include "samples/image/half.h"
#include "samples/image/image.h"

namespace walr::host {

inline constexpr fg::Extent kExtent{72, 40};

/// A small picture of one of the project's scenes.
inline Tracer::Options tracing(const std::string& scene = "box.gltf") {
  Tracer::Options options;
  options.scene = std::string(WALR_SCENES "/") + scene;
  options.extent = kExtent;
  options.denoiseDirect = false;  // So that the composite has both lights.
  return options;
}

/// Cases on one device under synchronization validation. Its pipelines depend on nothing but their shader and its
/// constants, so that no case needs new ones.
class HostDeviceTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    device_ = std::make_unique<GpuDevice>(GpuDevice::Options{.device = "", .validation = true});
  }
  static void TearDownTestSuite() { device_.reset(); }
  void TearDown() override { EXPECT_NO_THROW(gpu.refuseMessages()); }

 private:
  static inline std::unique_ptr<GpuDevice> device_;

 protected:
  GpuDevice& gpu = *device_;
};

/// As textures of halves hold it.
inline Image inHalves(Image image) {
  for (float& value : image.values()) value = toHalf(value);
  return image;
}

}  // namespace walr::host
