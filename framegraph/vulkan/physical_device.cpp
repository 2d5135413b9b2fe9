#include "framegraph/vulkan/physical_device.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>

#include "framegraph/vulkan/error.h"
#include "framegraph/vulkan/image.h"

namespace fg::vk {
namespace {

std::vector<std::string> deviceExtensions(const InstanceFunctions& functions, VkPhysicalDevice handle) {
  std::uint32_t count = 0;
  check(functions.vkEnumerateDeviceExtensionProperties(handle, nullptr, &count, nullptr),
        "enumerating device extensions");
  std::vector<VkExtensionProperties> properties(count);
  check(functions.vkEnumerateDeviceExtensionProperties(handle, nullptr, &count, properties.data()),
        "enumerating device extensions");
  std::vector<std::string> names;
  names.reserve(properties.size());
  for (const VkExtensionProperties& extension : properties) names.emplace_back(extension.extensionName);
  return names;
}

std::uint32_t computeQueueFamily(const InstanceFunctions& functions, VkPhysicalDevice handle) {
  std::uint32_t count = 0;
  functions.vkGetPhysicalDeviceQueueFamilyProperties(handle, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  functions.vkGetPhysicalDeviceQueueFamilyProperties(handle, &count, families.data());
  for (const VkQueueFlags wanted : {VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT, VK_QUEUE_COMPUTE_BIT + 0}) {
    const auto family = std::ranges::find_if(families, [&](const VkQueueFamilyProperties& properties) {
      return (properties.queueFlags & wanted) == static_cast<VkQueueFlags>(wanted);
    });
    if (family != families.end()) return static_cast<std::uint32_t>(family - families.begin());
  }
  return kNone;
}

void queryDriver(const InstanceFunctions& functions, PhysicalDevice& device) {
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &driver;
  functions.vkGetPhysicalDeviceProperties2(device.handle, &properties);
  device.driver = std::string(driver.driverName) + ' ' + driver.driverInfo;
  device.name = properties.properties.deviceName;
  device.type = properties.properties.deviceType;
  device.apiVersion = properties.properties.apiVersion;
  device.maxImageSide = properties.properties.limits.maxImageDimension2D;
}

/// Query a feature struct. All features are off if the device has neither the version nor the extension.
template <typename Features>
Features queryFeature(const InstanceFunctions& functions, const PhysicalDevice& device, VkStructureType type,
                      std::string_view extension, std::uint32_t version = VK_API_VERSION_1_3) {
  Features features{};
  features.sType = type;
  if (device.apiVersion < version && !device.hasExtension(extension)) return features;
  VkPhysicalDeviceFeatures2 all{};
  all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  all.pNext = &features;
  functions.vkGetPhysicalDeviceFeatures2(device.handle, &all);
  return features;
}

void queryFeatures(const InstanceFunctions& functions, PhysicalDevice& device) {
  VkPhysicalDeviceFeatures2 all{};
  all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  functions.vkGetPhysicalDeviceFeatures2(device.handle, &all);
  device.features = all.features;
  device.synchronization2 = queryFeature<VkPhysicalDeviceSynchronization2Features>(
                                functions, device, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES,
                                VK_KHR_SYNCHRONIZATION_2_EXTENSION_NAME)
                                .synchronization2 == VK_TRUE;
  device.maintenance4 = queryFeature<VkPhysicalDeviceMaintenance4Features>(
                            functions, device, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES,
                            VK_KHR_MAINTENANCE_4_EXTENSION_NAME)
                            .maintenance4 == VK_TRUE;
  device.timelineSemaphore = queryFeature<VkPhysicalDeviceTimelineSemaphoreFeatures>(
                                 functions, device, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES,
                                 VK_KHR_TIMELINE_SEMAPHORE_EXTENSION_NAME, VK_API_VERSION_1_2)
                                 .timelineSemaphore == VK_TRUE;
  device.shaderFloat16 = queryFeature<VkPhysicalDeviceShaderFloat16Int8Features>(
                             functions, device, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_FLOAT16_INT8_FEATURES,
                             VK_KHR_SHADER_FLOAT16_INT8_EXTENSION_NAME, VK_API_VERSION_1_2)
                             .shaderFloat16 == VK_TRUE;
}

std::string_view typeName(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "software";
    default:
      return "other";
  }
}

int rank(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return 4;
    default:
      return 3;
  }
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::string versionText(std::uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + '.' + std::to_string(VK_API_VERSION_MINOR(version)) + '.' +
         std::to_string(VK_API_VERSION_PATCH(version));
}

std::string_view useName(VkFormatFeatureFlags feature) {
  switch (feature) {
    case VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT:
      return "sampled image";
    case VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT:
      return "storage image";
    case VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT:
      return "colour attachment";
    case VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT:
      return "depth attachment";
    default:
      return "source or destination of a copy";
  }
}

}  // namespace

bool PhysicalDevice::hasExtension(std::string_view name) const {
  return std::ranges::find(extensions, name) != extensions.end();
}

PhysicalDevice physicalDevice(const InstanceFunctions& functions, VkPhysicalDevice handle, std::uint32_t index) {
  PhysicalDevice device;
  device.handle = handle;
  device.index = index;
  queryDriver(functions, device);
  device.extensions = deviceExtensions(functions, handle);
  device.computeQueueFamily = computeQueueFamily(functions, handle);
  queryFeatures(functions, device);
  device.formatFeatures = [getProperties = functions.vkGetPhysicalDeviceFormatProperties, handle](VkFormat format) {
    VkFormatProperties properties{};
    getProperties(handle, format, &properties);
    return properties.optimalTilingFeatures;
  };
  return device;
}

std::vector<PhysicalDevice> physicalDevices(const Instance& instance) {
  const InstanceFunctions& functions = instance.functions();
  std::uint32_t count = 0;
  check(functions.vkEnumeratePhysicalDevices(instance.handle(), &count, nullptr), "enumerating devices");
  std::vector<VkPhysicalDevice> handles(count);
  check(functions.vkEnumeratePhysicalDevices(instance.handle(), &count, handles.data()), "enumerating devices");
  if (handles.empty()) {
    throw Unsupported(
        "no Vulkan device found: the installed drivers find no hardware; Mesa's software driver "
        "(package mesa-vulkan-drivers) needs none",
        VK_ERROR_INITIALIZATION_FAILED);
  }
  std::vector<PhysicalDevice> devices;
  for (const VkPhysicalDevice handle : handles) {
    devices.push_back(physicalDevice(functions, handle, static_cast<std::uint32_t>(devices.size())));
  }
  return devices;
}

std::string listing(const std::vector<PhysicalDevice>& devices) {
  std::ostringstream out;
  for (const PhysicalDevice& device : devices) {
    out << device.index << ": " << device.name << " (" << device.driver << ", " << typeName(device.type) << ", Vulkan "
        << versionText(device.apiVersion) << ")\n";
  }
  return out.str();
}

const PhysicalDevice& choose(const std::vector<PhysicalDevice>& devices, std::string_view choice) {
  if (choice.empty()) return *std::ranges::min_element(devices, {}, [](const auto& d) { return rank(d.type); });
  std::uint32_t index = 0;
  const auto [end, error] = std::from_chars(choice.data(), choice.data() + choice.size(), index);
  const bool isNumber = error == std::errc() && end == choice.data() + choice.size();
  auto device = isNumber ? std::ranges::find(devices, index, &PhysicalDevice::index) : devices.end();
  if (device == devices.end()) {
    device = std::ranges::find_if(devices, [&](const PhysicalDevice& candidate) {
      return lower(candidate.name).find(lower(choice)) != std::string::npos;
    });
  }
  if (device == devices.end()) {
    throw Unsupported("no Vulkan device '" + std::string(choice) + "'; available devices:\n" + listing(devices),
                      VK_ERROR_INITIALIZATION_FAILED);
  }
  return *device;
}

std::vector<FormatUse> formatUses(const GraphDesc& graph, const Plan& plan) {
  std::vector<FormatUse> uses;
  for (std::size_t i = 0; i < plan.resources.size(); ++i) {
    const auto* texture = std::get_if<TextureDesc>(&graph.resources[i].desc);
    if (texture == nullptr || !plan.resources[i].used) continue;
    uses.push_back({texture->format, plan.resources[i].imageUsage, graph.resources[i].name, texture->extent});
  }
  return uses;
}

std::vector<std::string> missing(const PhysicalDevice& device, const std::vector<FormatUse>& formats) {
  std::vector<std::string> lacks;
  if (device.apiVersion < VK_API_VERSION_1_1) {
    lacks.push_back("Vulkan 1.1 (it has " + versionText(device.apiVersion) + "): update the driver");
  }
  if (device.computeQueueFamily == kNone) lacks.emplace_back("a queue that supports compute: choose another device");
  if (!device.synchronization2) {
    lacks.emplace_back("feature synchronization2 (Vulkan 1.3 or VK_KHR_synchronization2): update the driver");
  }
  if (device.features.shaderStorageImageExtendedFormats != VK_TRUE) {
    lacks.emplace_back("feature shaderStorageImageExtendedFormats: choose another device");
  }
  for (const FormatUse& use : formats) {
    if (std::max(use.extent.width, use.extent.height) > device.maxImageSide) {
      lacks.push_back("images as large as '" + use.resource + "', " + std::to_string(use.extent.width) + " x " +
                      std::to_string(use.extent.height) + " pixels: use at most " +
                      std::to_string(device.maxImageSide) + " pixels a side");
    }
    const VkFormatFeatureFlags lacking = requiredFeatures(use.usage) & ~device.formatFeatures(use.format);
    for (VkFormatFeatureFlags bit = 1; bit <= lacking && bit != 0; bit <<= 1) {
      if ((lacking & bit) == 0) continue;
      lacks.push_back("format " + std::to_string(use.format) + " of '" + use.resource + "' as " +
                      std::string(useName(bit)) + ": declare it with another format");
    }
  }
  return lacks;
}

void require(const PhysicalDevice& device, const std::vector<FormatUse>& formats) {
  const std::vector<std::string> lacks = missing(device, formats);
  if (lacks.empty()) return;
  std::string message = "device '" + device.name + "' (" + device.driver + ") lacks";
  for (const std::string& lack : lacks) message += "\n  " + lack;
  throw Unsupported(message, VK_ERROR_FEATURE_NOT_PRESENT);
}

}  // namespace fg::vk
