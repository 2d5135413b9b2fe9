// A Vulkan driver for tests: Mesa's CPU driver, which keeps the compute pipelines of a device until the device is
// destroyed, and hands them out again. Creating pipelines takes that driver longer than anything else in the tests. The
// validation layer is between a test and this driver, so it sees each pipeline created and destroyed as the test does.
#include <dlfcn.h>

#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <vulkan/vk_icd.h>

namespace {

void* driverSymbol(const char* name) {
  static void* const driver = dlopen(WALR_KEPT_DRIVER, RTLD_NOW | RTLD_LOCAL);
  return driver == nullptr ? nullptr : dlsym(driver, name);
}

/// The driver's functions that are replaced.
struct Driver {
  PFN_vkGetDeviceProcAddr getDeviceProcAddr = nullptr;
  PFN_vkCreateShaderModule createShaderModule = nullptr;
  PFN_vkCreateDescriptorSetLayout createSetLayout = nullptr;
  PFN_vkCreatePipelineLayout createLayout = nullptr;
  PFN_vkCreateComputePipelines createPipelines = nullptr;
  PFN_vkDestroyPipeline destroyPipeline = nullptr;
  PFN_vkDestroyDevice destroyDevice = nullptr;
};
Driver driver;

/// What a pipeline depends on, as bytes.
class Bytes {
 public:
  template <typename Value>
  void add(const Value& value) {
    addAll(&value, 1);
  }
  template <typename Value>
  void addAll(const Value* values, std::size_t count) {
    addText({reinterpret_cast<const char*>(values), count * sizeof(Value)});
  }
  void addText(std::string_view text) {
    const std::size_t size = text.size();
    bytes_.append(reinterpret_cast<const char*>(&size), sizeof(size)).append(text);
  }
  [[nodiscard]] const std::string& text() const { return bytes_; }

 private:
  std::string bytes_;
};

std::mutex mutex;  // Guards what follows.
// Of objects by handle. A handle that the driver uses again is overwritten, because an object is created first.
std::map<VkShaderModule, std::size_t> codes;  ///< Hashes of 64 bits.
std::map<VkDescriptorSetLayout, std::string> setLayouts;
std::map<VkPipelineLayout, std::string> layouts;
using Key = std::pair<VkDevice, std::string>;
std::map<Key, VkPipeline> kept;
std::set<VkPipeline> keptHandles;

VKAPI_ATTR VkResult VKAPI_CALL createShaderModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                                  const VkAllocationCallbacks* allocator, VkShaderModule* module) {
  const VkResult result = driver.createShaderModule(device, info, allocator, module);
  if (result != VK_SUCCESS) return result;
  const std::lock_guard lock(mutex);
  codes[*module] = std::hash<std::string_view>()({reinterpret_cast<const char*>(info->pCode), info->codeSize});
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createSetLayout(VkDevice device, const VkDescriptorSetLayoutCreateInfo* info,
                                               const VkAllocationCallbacks* allocator, VkDescriptorSetLayout* layout) {
  const VkResult result = driver.createSetLayout(device, info, allocator, layout);
  if (result != VK_SUCCESS) return result;
  Bytes bytes;
  bytes.add(info->flags);
  for (std::uint32_t i = 0; i < info->bindingCount; ++i) {
    const VkDescriptorSetLayoutBinding& binding = info->pBindings[i];
    bytes.add(binding.binding);
    bytes.add(binding.descriptorType);
    bytes.add(binding.descriptorCount);
    bytes.add(binding.stageFlags);
    const bool samplers = binding.pImmutableSamplers != nullptr;
    bytes.addAll(binding.pImmutableSamplers, samplers ? binding.descriptorCount : 0);
  }
  const std::lock_guard lock(mutex);
  setLayouts[*layout] = bytes.text();
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createLayout(VkDevice device, const VkPipelineLayoutCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkPipelineLayout* layout) {
  const VkResult result = driver.createLayout(device, info, allocator, layout);
  if (result != VK_SUCCESS) return result;
  Bytes bytes;
  bytes.add(info->flags);
  bytes.addAll(info->pPushConstantRanges, info->pushConstantRangeCount);
  const std::lock_guard lock(mutex);
  for (std::uint32_t i = 0; i < info->setLayoutCount; ++i) bytes.addText(setLayouts.at(info->pSetLayouts[i]));
  layouts[*layout] = bytes.text();
  return result;
}

Key keyOf(VkDevice device, VkPipelineCache cache, const VkComputePipelineCreateInfo& info) {
  Bytes bytes;
  bytes.add(cache);
  bytes.addText(info.stage.pName);
  if (const VkSpecializationInfo* constants = info.stage.pSpecializationInfo) {
    bytes.addAll(constants->pMapEntries, constants->mapEntryCount);
    bytes.addAll(static_cast<const char*>(constants->pData), constants->dataSize);
  }
  const std::lock_guard lock(mutex);
  bytes.add(codes.at(info.stage.module));
  bytes.addText(layouts.at(info.layout));
  return {device, bytes.text()};
}

VKAPI_ATTR VkResult VKAPI_CALL createPipelines(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                               const VkComputePipelineCreateInfo* infos,
                                               const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
  const bool plain = count == 1 && allocator == nullptr && infos->pNext == nullptr && infos->flags == 0 &&
                     infos->stage.pNext == nullptr && infos->stage.flags == 0;
  if (!plain) return driver.createPipelines(device, cache, count, infos, allocator, pipelines);
  const Key key = keyOf(device, cache, *infos);
  {
    const std::lock_guard lock(mutex);
    if (const auto known = kept.find(key); known != kept.end()) {
      *pipelines = known->second;
      return VK_SUCCESS;
    }
  }
  const VkResult result = driver.createPipelines(device, cache, 1, infos, nullptr, pipelines);
  if (result != VK_SUCCESS) return result;
  const std::lock_guard lock(mutex);
  // Another thread may have made the same one. Then this one is not kept.
  if (kept.emplace(key, *pipelines).second) keptHandles.insert(*pipelines);
  return result;
}

VKAPI_ATTR void VKAPI_CALL destroyPipeline(VkDevice device, VkPipeline pipeline,
                                           const VkAllocationCallbacks* allocator) {
  const std::lock_guard lock(mutex);
  if (!keptHandles.contains(pipeline)) driver.destroyPipeline(device, pipeline, allocator);
}

VKAPI_ATTR void VKAPI_CALL destroyDevice(VkDevice device, const VkAllocationCallbacks* allocator) {
  {
    const std::lock_guard lock(mutex);
    std::erase_if(kept, [&](const auto& each) {
      const auto& [key, pipeline] = each;
      if (key.first != device) return false;
      driver.destroyPipeline(device, pipeline, nullptr);
      keptHandles.erase(pipeline);
      return true;
    });
  }
  driver.destroyDevice(device, allocator);
}

template <typename Function>
PFN_vkVoidFunction replace(Function& original, PFN_vkVoidFunction function, Function replacement) {
  original = reinterpret_cast<Function>(function);
  return reinterpret_cast<PFN_vkVoidFunction>(replacement);
}

PFN_vkVoidFunction replaced(std::string_view name, PFN_vkVoidFunction function);

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name) {
  return replaced(name, driver.getDeviceProcAddr(device, name));
}

PFN_vkVoidFunction replaced(std::string_view name, PFN_vkVoidFunction function) {
  if (function == nullptr) return nullptr;
  if (name == "vkGetDeviceProcAddr") return replace(driver.getDeviceProcAddr, function, getDeviceProcAddr);
  if (name == "vkCreateShaderModule") return replace(driver.createShaderModule, function, createShaderModule);
  if (name == "vkCreateDescriptorSetLayout") return replace(driver.createSetLayout, function, createSetLayout);
  if (name == "vkCreatePipelineLayout") return replace(driver.createLayout, function, createLayout);
  if (name == "vkCreateComputePipelines") return replace(driver.createPipelines, function, createPipelines);
  if (name == "vkDestroyPipeline") return replace(driver.destroyPipeline, function, destroyPipeline);
  if (name == "vkDestroyDevice") return replace(driver.destroyDevice, function, destroyDevice);
  return function;
}

}  // namespace

// What the loader asks a driver for (https://github.com/KhronosGroup/Vulkan-Loader, LoaderDriverInterface.md).
extern "C" {

VKAPI_ATTR VkResult VKAPI_CALL vk_icdNegotiateLoaderICDInterfaceVersion(std::uint32_t* version) {
  const auto negotiate = reinterpret_cast<PFN_vkNegotiateLoaderICDInterfaceVersion>(
      driverSymbol("vk_icdNegotiateLoaderICDInterfaceVersion"));
  return negotiate == nullptr ? VK_ERROR_INCOMPATIBLE_DRIVER : negotiate(version);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vk_icdGetInstanceProcAddr(VkInstance instance, const char* name) {
  static const auto original = reinterpret_cast<PFN_vkGetInstanceProcAddr>(driverSymbol("vk_icdGetInstanceProcAddr"));
  return original == nullptr ? nullptr : replaced(name, original(instance, name));
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vk_icdGetPhysicalDeviceProcAddr(VkInstance instance, const char* name) {
  static const auto original =
      reinterpret_cast<PFN_vkGetInstanceProcAddr>(driverSymbol("vk_icdGetPhysicalDeviceProcAddr"));
  return original == nullptr ? nullptr : original(instance, name);
}
}
