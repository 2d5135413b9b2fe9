#pragma once

#include <vector>

#include <gtest/gtest.h>

#include "framegraph/vulkan/instance.h"
#include "tests/vulkan/test_device.h"

namespace fg::test {

/// A test on a Vulkan device with the validation layer and synchronization validation. It fails on every warning and
/// error of the layer. It also fails if the layer or a device is missing.
///
/// All cases of a program share the device, because making it and its pipelines takes longer than most cases. After a
/// failure the next case gets a new one. What the layer tells when the device is destroyed, for instance of objects
/// that a case has left behind, fails the failed case or else the program: run its cases one by one to see which it
/// was.
///
/// It uses the loader's first device; the loader's environment variables can select another. Shaders compute in single
/// precision, as on the device of a host that enables no more than it must.
class GpuTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  [[nodiscard]] static const vk::Instance& instance();
  [[nodiscard]] static const TestDevice& device();
  [[nodiscard]] static const vk::DeviceContext& context() { return device().context(); }
  /// Take the messages so far, so that they do not fail the test. For tests that provoke messages.
  static std::vector<vk::Message> takeMessages();
};

}  // namespace fg::test
