#pragma once

#include <stdexcept>
#include <string>

#include <vulkan/vulkan_core.h>

namespace fg::vk {

/// Something went wrong in Vulkan. The message names what was being done and the way out; `result` is Vulkan's word.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message, VkResult result = VK_ERROR_UNKNOWN)
      : std::runtime_error(message), result_(result) {}
  [[nodiscard]] VkResult result() const { return result_; }

 private:
  VkResult result_;
};

/// Host or device memory ran out. Everything made so far is released; try again with smaller textures.
class OutOfMemory final : public Error {
  using Error::Error;
};

/// The device is gone: it hung, was reset or was unplugged. Make a new device and a new executor.
class DeviceLost final : public Error {
  using Error::Error;
};

/// The driver would not make a pipeline. The message names the shader.
class PipelineFailed final : public Error {
  using Error::Error;
};

/// No Vulkan, no device, or a device without something that is needed.
class Unsupported final : public Error {
  using Error::Error;
};

/// Vulkan's name of a result, for instance "VK_ERROR_DEVICE_LOST".
std::string resultName(VkResult result);

/// Throw the fitting error unless `result` is a success.
/// @param action what was being done, as in "creating image 'depth'"
void check(VkResult result, const std::string& action);

}  // namespace fg::vk
