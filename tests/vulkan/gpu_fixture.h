#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "framegraph/vulkan/instance.h"
#include "tests/vulkan/test_device.h"

namespace fg::test {

/// A test on a Vulkan device with the validation layer and synchronization validation. It fails on every warning and
/// error of the layer, including those at destruction of the device. It also fails if the layer or a device is missing.
///
/// It uses the loader's first device; the loader's environment variables can select another. Shaders compute in single
/// precision, as on the device of a host that enables no more than it must.
class GpuTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  [[nodiscard]] const vk::Instance& instance() const { return *instance_; }
  [[nodiscard]] const TestDevice& device() const { return *device_; }
  [[nodiscard]] const vk::DeviceContext& context() const { return device_->context(); }
  /// Take the messages so far, so that they do not fail the test. For tests that provoke messages.
  std::vector<vk::Message> takeMessages() { return log_.take(); }

 private:
  vk::MessageLog log_;
  std::unique_ptr<vk::Instance> instance_;
  std::unique_ptr<TestDevice> device_;
};

}  // namespace fg::test
