#pragma once

#include "framegraph/vulkan/instance.h"
#include "tests/vulkan/test_device.h"

namespace fg::test {

/// A device like that of `GpuTest`, but without the validation layer, which takes half of the time of a small frame.
/// For long runs of frames of which the first ones also run under validation.
class PlainDevice {
 public:
  [[nodiscard]] const TestDevice& device() const { return device_; }

 private:
  vk::Instance instance_;
  TestDevice device_{instance_, vk::physicalDevices(instance_).front(), {}, nullptr, vk::HalfArithmetic::Never};
};

}  // namespace fg::test
