#include "framegraph/vulkan/instance.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

#include "framegraph/vulkan/error.h"
#include "framegraph/vulkan/validation_settings.h"

namespace fg::vk {
namespace {

constexpr const char* kNoDriver =
    "no Vulkan driver found: install one (Mesa's software driver is the package mesa-vulkan-drivers), or correct "
    "VK_DRIVER_FILES and VK_ICD_FILENAMES if they are set. With VK_LOADER_DEBUG=error, the loader tells which driver "
    "it could not load, and why";

/// The layer warns that a function of a physical device was asked for by vkGetDeviceProcAddr. Some drivers and loaders
/// do so themselves while a device is created (KhronosGroup/Vulkan-ValidationLayers, issue 8048). A program that did it
/// would get a null pointer, and so an error.
constexpr std::string_view kQueryOfDriver = "WARNING-vkGetDeviceProcAddr-device";

VKAPI_ATTR VkBool32 VKAPI_CALL forwardMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                              VkDebugUtilsMessageTypeFlagsEXT,
                                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* sink) {
  const char* const id = data->pMessageIdName != nullptr ? data->pMessageIdName : "";
  if (id == kQueryOfDriver) return VK_FALSE;
  const auto& take = *static_cast<const MessageSink*>(sink);
  take({severity >= VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT ? Message::Severity::Error
                                                                  : Message::Severity::Warning,
        id, data->pMessage != nullptr ? data->pMessage : ""});
  return VK_FALSE;
}

template <typename Function>
Function globalFunction(PFN_vkGetInstanceProcAddr entry, const char* name) {
  const auto function = reinterpret_cast<Function>(entry(VK_NULL_HANDLE, name));
  if (function == nullptr) throw Unsupported(std::string("the Vulkan loader lacks ") + name + ": update it");
  return function;
}

bool hasExtension(PFN_vkGetInstanceProcAddr entry, const char* layer, std::string_view name) {
  const auto enumerate =
      globalFunction<PFN_vkEnumerateInstanceExtensionProperties>(entry, "vkEnumerateInstanceExtensionProperties");
  std::uint32_t count = 0;
  if (enumerate(layer, &count, nullptr) != VK_SUCCESS) return false;
  std::vector<VkExtensionProperties> extensions(count);
  check(enumerate(layer, &count, extensions.data()), "enumerating instance extensions");
  return std::ranges::any_of(extensions, [&](const auto& extension) { return name == extension.extensionName; });
}

}  // namespace

PFN_vkGetInstanceProcAddr openLoader() {
#ifdef _WIN32
  static const HMODULE library = LoadLibraryA("vulkan-1.dll");
  void* const symbol =
      library != nullptr ? reinterpret_cast<void*>(GetProcAddress(library, "vkGetInstanceProcAddr")) : nullptr;
#else
  static void* const library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  void* const symbol = library != nullptr ? dlsym(library, "vkGetInstanceProcAddr") : nullptr;
#endif
  if (symbol == nullptr) {
    throw Unsupported("no Vulkan loader found: install it (package libvulkan1, or your graphics driver)",
                      VK_ERROR_INITIALIZATION_FAILED);
  }
  return reinterpret_cast<PFN_vkGetInstanceProcAddr>(symbol);
}

std::optional<std::uint32_t> layerVersion(PFN_vkGetInstanceProcAddr entry, std::string_view name) {
  const auto enumerate =
      globalFunction<PFN_vkEnumerateInstanceLayerProperties>(entry, "vkEnumerateInstanceLayerProperties");
  std::uint32_t count = 0;
  check(enumerate(&count, nullptr), "enumerating instance layers");
  std::vector<VkLayerProperties> layers(count);
  check(enumerate(&count, layers.data()), "enumerating instance layers");
  const auto found =
      std::ranges::find(layers, name, [](const auto& layer) { return std::string_view(layer.layerName); });
  return found == layers.end() ? std::nullopt : std::optional(found->specVersion);
}

Instance::Instance(const InstanceOptions& options, PFN_vkGetInstanceProcAddr entry) : sink_(options.sink) {
  std::vector<const char*> layers;
  std::vector<const char*> extensions = options.extensions;
  std::optional<ValidationSettings> validation;
  if (options.validation) {
    if (!layerVersion(entry, kValidationLayer)) {
      throw Unsupported(std::string(kValidationLayer) +
                            " is not installed: install the package vulkan-validationlayers, or run without validation",
                        VK_ERROR_LAYER_NOT_PRESENT);
    }
    layers.push_back(kValidationLayer);
    validation.emplace(hasExtension(entry, kValidationLayer, kLayerSettingsExtension));
    if (validation->extension() != nullptr) extensions.push_back(validation->extension());
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  }

  VkDebugUtilsMessengerCreateInfoEXT messenger{};
  messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  messenger.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType =
      VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  messenger.pfnUserCallback = forwardMessage;
  messenger.pUserData = &sink_;

  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = options.applicationName.c_str();
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pNext = validation ? validation->chain() : nullptr;
  info.pApplicationInfo = &application;
  info.enabledLayerCount = static_cast<std::uint32_t>(layers.size());
  info.ppEnabledLayerNames = layers.data();
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  VkInstance made = VK_NULL_HANDLE;
  const VkResult result = globalFunction<PFN_vkCreateInstance>(entry, "vkCreateInstance")(&info, nullptr, &made);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) throw Unsupported(kNoDriver, result);
  check(result, "creating a Vulkan instance");
  handle_ = {made, {reinterpret_cast<PFN_vkDestroyInstance>(entry(made, "vkDestroyInstance"))}};
  functions_ = InstanceFunctions::load(made, entry);
  if (options.validation && sink_) {
    check(functions_.vkCreateDebugUtilsMessengerEXT(made, &messenger, nullptr, &messenger_),
          "creating a messenger for validation messages");
  }
}

Instance::~Instance() {
  if (messenger_ != VK_NULL_HANDLE) functions_.vkDestroyDebugUtilsMessengerEXT(handle(), messenger_, nullptr);
}

}  // namespace fg::vk
