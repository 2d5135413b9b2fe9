#pragma once

#include <memory>

#include "framegraph/vulkan/device.h"
#include "framegraph/vulkan/shared_objects.h"

namespace fg::test {

/// A device on which the runs of a test can create each pipeline once: creating them takes longer than running frames.
class TestDevice : public vk::Device {
 public:
  using vk::Device::Device;

  /// For `ExecutorOptions::shared`: executors with this membership share pipelines and no memory. Their shaders must
  /// live as long as the device.
  [[nodiscard]] const vk::Membership& pipelines() const { return pipelines_; }
  /// What a user of the device keeps until the device is destroyed; null at first.
  [[nodiscard]] std::shared_ptr<void>& companion() const { return companion_; }

 private:
  mutable std::shared_ptr<void> companion_;
  vk::Membership pipelines_{std::make_shared<vk::SharedObjects>(context())};
};

}  // namespace fg::test
