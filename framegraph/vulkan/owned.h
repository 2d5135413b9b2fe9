#pragma once

#include <utility>

#include "framegraph/vulkan/device_context.h"
#include "framegraph/vulkan/error.h"

namespace fg::vk {

/// The function that destroys handles of a type.
template <typename Handle>
inline constexpr auto kDestroy = nullptr;
template <>
inline constexpr auto kDestroy<VkImage> = &DeviceFunctions::vkDestroyImage;
template <>
inline constexpr auto kDestroy<VkImageView> = &DeviceFunctions::vkDestroyImageView;
template <>
inline constexpr auto kDestroy<VkBuffer> = &DeviceFunctions::vkDestroyBuffer;
template <>
inline constexpr auto kDestroy<VkSampler> = &DeviceFunctions::vkDestroySampler;
template <>
inline constexpr auto kDestroy<VkShaderModule> = &DeviceFunctions::vkDestroyShaderModule;
template <>
inline constexpr auto kDestroy<VkPipelineCache> = &DeviceFunctions::vkDestroyPipelineCache;
template <>
inline constexpr auto kDestroy<VkPipelineLayout> = &DeviceFunctions::vkDestroyPipelineLayout;
template <>
inline constexpr auto kDestroy<VkPipeline> = &DeviceFunctions::vkDestroyPipeline;
template <>
inline constexpr auto kDestroy<VkDescriptorSetLayout> = &DeviceFunctions::vkDestroyDescriptorSetLayout;
template <>
inline constexpr auto kDestroy<VkDescriptorPool> = &DeviceFunctions::vkDestroyDescriptorPool;
template <>
inline constexpr auto kDestroy<VkQueryPool> = &DeviceFunctions::vkDestroyQueryPool;
template <>
inline constexpr auto kDestroy<VkFence> = &DeviceFunctions::vkDestroyFence;
template <>
inline constexpr auto kDestroy<VkCommandPool> = &DeviceFunctions::vkDestroyCommandPool;

/// A Vulkan handle, destroyed in the destructor.
template <typename Handle>
class Owned {
 public:
  Owned() = default;
  Owned(const DeviceContext& device, Handle handle) : device_(&device), handle_(handle) {}
  Owned(Owned&& other) noexcept : device_(other.device_), handle_(std::exchange(other.handle_, VK_NULL_HANDLE)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(handle_, other.handle_);
    return *this;
  }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() {
    if (handle_ == VK_NULL_HANDLE) return;
    (device_->functions.*kDestroy<Handle>)(device_->view.device, handle_, device_->view.allocator);
  }

  [[nodiscard]] Handle get() const { return handle_; }

 private:
  const DeviceContext* device_ = nullptr;
  Handle handle_ = VK_NULL_HANDLE;
};

/// Call a Vulkan function of the shape `vkCreateX(device, &info, allocator, &handle)`.
/// @param action what the call does, for the error message
template <typename Handle, typename Info, typename Function>
Owned<Handle> create(const DeviceContext& device, Function function, const Info& info, const std::string& action) {
  Handle handle = VK_NULL_HANDLE;
  check(function(device.view.device, &info, device.view.allocator, &handle), action);
  return Owned<Handle>(device, handle);
}

}  // namespace fg::vk
