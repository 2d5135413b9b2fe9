#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framegraph/vulkan/functions.h"
#include "framegraph/vulkan/messages.h"
#include "framegraph/vulkan/unique_handle.h"

namespace fg::vk {

/// Open the system's Vulkan loader and return its entry point. The loader stays open until the program ends.
/// @throws Unsupported if there is none
PFN_vkGetInstanceProcAddr openLoader();

/// The version of Vulkan that an installed layer was written for; nothing if it is not installed.
/// @param entry the loader's entry point
/// @throws Error when the loader fails
std::optional<std::uint32_t> layerVersion(PFN_vkGetInstanceProcAddr entry, std::string_view name);

struct InstanceOptions {
  std::string applicationName = "walr";
  /// The Khronos validation layer with synchronization validation. Also enables VK_EXT_debug_utils: names and labels.
  bool validation = false;
  MessageSink sink;                     ///< Receives validation messages; called only with `validation`.
  std::vector<const char*> extensions;  ///< Additional ones, for instance those of a window system.
};

/// A Vulkan instance for programs that have none of their own.
class Instance {
 public:
  /// @throws Unsupported if there is no loader or driver, or if the requested validation layer is missing
  explicit Instance(const InstanceOptions& options = {}, PFN_vkGetInstanceProcAddr entry = openLoader());
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  [[nodiscard]] VkInstance handle() const { return handle_.get(); }
  [[nodiscard]] const InstanceFunctions& functions() const { return functions_; }

 private:
  /// Also destroyed if construction fails later.
  UniqueHandle<VkInstance, PFN_vkDestroyInstance> handle_;
  InstanceFunctions functions_;
  MessageSink sink_;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

}  // namespace fg::vk
