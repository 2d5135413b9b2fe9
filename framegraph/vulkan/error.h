#pragma once

#include <stdexcept>
#include <string>

#include <vulkan/vulkan_core.h>

namespace fg::vk {

/// A Vulkan call failed. The message names the failed action and what to do about it; `result` is Vulkan's error code.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message, VkResult result = VK_ERROR_UNKNOWN)
      : std::runtime_error(message), result_(result) {}
  [[nodiscard]] VkResult result() const { return result_; }

 private:
  VkResult result_;
};

/// Host or device memory ran out. Everything created so far is released. Try again with smaller textures.
class OutOfMemory final : public Error {
  using Error::Error;
};

/// The device is lost: it hung, was reset or was unplugged. Create a new device and a new executor.
class DeviceLost final : public Error {
  using Error::Error;
};

/// The driver failed to create a pipeline. The message names the shader.
class PipelineFailed final : public Error {
  using Error::Error;
};

/// A frame was to be recorded before the GPU had finished the one that used its slot before. Nothing was recorded.
class FrameInFlight final : public Error {
  using Error::Error;
};

/// There is no Vulkan, no device, or a device that lacks something required.
class Unsupported final : public Error {
  using Error::Error;
};

/// Vulkan's name of a result, for instance "VK_ERROR_DEVICE_LOST".
std::string resultName(VkResult result);

/// Throw the error class for `result`, unless it is a success.
/// @param action what the call does, for the message: "creating image 'depth'"
void check(VkResult result, const std::string& action);

}  // namespace fg::vk
