#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "framegraph/vulkan/device.h"
#include "framegraph/vulkan/instance.h"

namespace fg::test {

/// A test on a Vulkan device with the validation layer and its synchronization validation on. Fails on every warning
/// and error of the layer, those at destruction of the device included, and where the layer or a device is missing.
///
/// The device is the loader's first; the environment chooses among several.
class GpuTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  [[nodiscard]] const vk::Instance& instance() const { return *instance_; }
  [[nodiscard]] const vk::Device& device() const { return *device_; }
  [[nodiscard]] const vk::DeviceContext& context() const { return device_->context(); }
  /// Messages until now, which then do not fail the test: for tests that provoke them.
  std::vector<vk::Message> takeMessages() { return log_.take(); }

 private:
  vk::MessageLog log_;
  std::unique_ptr<vk::Instance> instance_;
  std::unique_ptr<vk::Device> device_;
};

}  // namespace fg::test
