#include "tests/costs/null_device.h"

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace walr::costs {
namespace {

namespace fs = std::filesystem;

void require(VkResult result, const std::string& action) {
  if (result != VK_SUCCESS && result != VK_INCOMPLETE) {
    throw std::runtime_error(action + ": VkResult " + std::to_string(static_cast<int>(result)));
  }
}

/// The manifest of the driver in the folders that the loader looks into.
std::optional<fs::path> findManifest() {
  const char* given = std::getenv("XDG_DATA_DIRS");
  std::istringstream folders(given != nullptr ? given : "/usr/local/share:/usr/share");
  std::vector<fs::path> places = {"/etc/vulkan/icd.d"};
  for (std::string folder; std::getline(folders, folder, ':');) places.push_back(fs::path(folder) / "vulkan/icd.d");
  for (const fs::path& place : places) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(place, none)) {
      const std::string name = entry.path().filename().string();
      // On a system of two architectures, that of 32 bits is not for this program.
      if (name.starts_with("radeon_icd") && name.find("i686") == std::string::npos) return entry.path();
    }
  }
  return std::nullopt;
}

/// A Vulkan object that is destroyed with its scope.
template <typename Handle>
class Scoped {
 public:
  using Destroy = void (*)(VkDevice, Handle, const VkAllocationCallbacks*);
  Scoped(VkDevice device, Destroy destroy) : device_(device), destroy_(destroy) {}
  ~Scoped() { destroy_(device_, handle, nullptr); }
  Scoped(const Scoped&) = delete;
  Scoped& operator=(const Scoped&) = delete;

  Handle handle = VK_NULL_HANDLE;

 private:
  VkDevice device_;
  Destroy destroy_;
};

template <typename Function>
Function load(VkDevice device, const char* name) {
  const auto function = reinterpret_cast<Function>(vkGetDeviceProcAddr(device, name));
  if (function == nullptr) throw std::runtime_error(std::string("the driver has no ") + name);
  return function;
}

VkPhysicalDevice firstDevice(VkInstance instance) {
  std::uint32_t count = 1;
  VkPhysicalDevice device = VK_NULL_HANDLE;
  const VkResult result = vkEnumeratePhysicalDevices(instance, &count, &device);
  if (result == VK_ERROR_INITIALIZATION_FAILED) {
    throw NoNullDevice(
        "Mesa's driver for AMD GPUs has no null device, which newer versions (seen: 26.2) no longer offer; those of "
        "Debian 12 and 13 (22.3, 25.0) do");
  }
  require(result, "listing devices");
  if (count == 0) throw std::runtime_error("the driver has no device");
  return device;
}

std::string firstWords(std::string_view text, int words) {
  std::istringstream stream{std::string(text)};
  std::string result;
  for (std::string word; words > 0 && stream >> word; --words) result += (result.empty() ? "" : " ") + word;
  return result;
}

void addStatistic(const VkPipelineExecutableStatisticKHR& statistic, std::uint64_t smallestWave,
                  CompiledShader& shader) {
  const std::string_view name = statistic.name;
  const std::uint64_t value = statistic.value.u64;
  if (name == "VGPRs") shader.vectorRegisters = value;
  if (name == "LDS size") shader.sharedBytes = value;
  if (name == "Spilled SGPRs" || name == "Spilled VGPRs") shader.spills += value;
  if (name == "Scratch size") shader.scratchBytes = value;
  if (name == "Subgroups per SIMD") shader.waves = value * smallestWave / 64;
  if (name == "Instructions") shader.instructions = value;
  if (name == "Inverse Throughput") shader.inverseThroughput = value;
}

}  // namespace

bool selectRadv() {
  const auto manifest = findManifest();
  if (!manifest) return false;
  setenv("VK_DRIVER_FILES", manifest->c_str(), 1);
  setenv("VK_ICD_FILENAMES", manifest->c_str(), 1);
  setenv("RADV_FORCE_FAMILY", "navi21", 0);
  setenv("RADV_DEBUG", "nocache", 0);
  return true;
}

NullDevice::NullDevice() {
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo instanceInfo{};
  instanceInfo.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  instanceInfo.pApplicationInfo = &application;
  require(vkCreateInstance(&instanceInfo, nullptr, &instance_), "creating an instance");
  const VkPhysicalDevice physical = firstDevice(instance_);

  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceSubgroupSizeControlProperties subgroups{};
  subgroups.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES;
  driver.pNext = &subgroups;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &driver;
  vkGetPhysicalDeviceProperties2(physical, &properties);
  driver_ = firstWords(static_cast<const char*>(driver.driverInfo), 2);
  smallestWave_ = subgroups.minSubgroupSize;
  const std::string_view name = static_cast<const char*>(properties.properties.deviceName);
  const std::size_t radv = name.find("RADV ");
  if (radv == std::string_view::npos || !name.starts_with("Null")) {
    throw std::runtime_error("device '" + std::string(name) + "' is no null device of RADV: is its family known?");
  }
  family_ = std::string(name.substr(radv + 5, name.find(')', radv) - radv - 5));

  const float priority = 1.0F;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkPhysicalDeviceShaderFloat16Int8Features float16{};
  float16.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_FLOAT16_INT8_FEATURES;
  float16.shaderFloat16 = VK_TRUE;
  VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR executable{};
  executable.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
  executable.pNext = &float16;
  executable.pipelineExecutableInfo = VK_TRUE;
  const char* extension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
  VkPhysicalDeviceFeatures features{};
  features.shaderStorageImageWriteWithoutFormat = VK_TRUE;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &executable;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = 1;
  info.ppEnabledExtensionNames = &extension;
  info.pEnabledFeatures = &features;
  require(vkCreateDevice(physical, &info, nullptr, &device_), "creating a device");
}

NullDevice::~NullDevice() {
  vkDestroyDevice(device_, nullptr);
  vkDestroyInstance(instance_, nullptr);
}

const CompiledShader& NullDevice::compile(const fg::ComputeDispatch& dispatch) {
  const std::pair key(dispatch.shader, dispatch.specialization);
  const auto known = compiled_.find(key);
  return known != compiled_.end() ? known->second : compiled_.emplace(key, compileNew(dispatch)).first->second;
}

CompiledShader NullDevice::compileNew(const fg::ComputeDispatch& dispatch) const {
  const fg::Shader& shader = dispatch.shader->inHalves != nullptr ? *dispatch.shader->inHalves : *dispatch.shader;
  const std::string name(shader.name);

  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (const fg::ShaderBinding& binding : shader.bindings) {
    bindings.push_back({binding.binding, binding.type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
  }
  VkDescriptorSetLayoutCreateInfo setInfo{};
  setInfo.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  setInfo.bindingCount = static_cast<std::uint32_t>(bindings.size());
  setInfo.pBindings = bindings.data();
  Scoped<VkDescriptorSetLayout> set(device_, vkDestroyDescriptorSetLayout);
  require(vkCreateDescriptorSetLayout(device_, &setInfo, nullptr, &set.handle), "descriptor set layout of " + name);

  const VkPushConstantRange constants = {VK_SHADER_STAGE_COMPUTE_BIT, 0, shader.pushConstantSize};
  VkPipelineLayoutCreateInfo layoutInfo{};
  layoutInfo.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  layoutInfo.setLayoutCount = 1;
  layoutInfo.pSetLayouts = &set.handle;
  layoutInfo.pushConstantRangeCount = shader.pushConstantSize != 0 ? 1 : 0;
  layoutInfo.pPushConstantRanges = &constants;
  Scoped<VkPipelineLayout> layout(device_, vkDestroyPipelineLayout);
  require(vkCreatePipelineLayout(device_, &layoutInfo, nullptr, &layout.handle), "pipeline layout of " + name);

  VkShaderModuleCreateInfo moduleInfo{};
  moduleInfo.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  moduleInfo.codeSize = shader.code.size_bytes();
  moduleInfo.pCode = shader.code.data();
  Scoped<VkShaderModule> module(device_, vkDestroyShaderModule);
  require(vkCreateShaderModule(device_, &moduleInfo, nullptr, &module.handle), "shader module " + name);

  std::vector<VkSpecializationMapEntry> entries;
  for (std::size_t i = 0; i < dispatch.specialization.size() && i < shader.constants.size(); ++i) {
    const auto offset = static_cast<std::uint32_t>(i * sizeof(std::uint32_t));
    entries.push_back({shader.constants[i].id, offset, sizeof(std::uint32_t)});
  }
  const VkSpecializationInfo specialization = {static_cast<std::uint32_t>(entries.size()), entries.data(),
                                               dispatch.specialization.size() * sizeof(std::uint32_t),
                                               dispatch.specialization.data()};
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.flags =
      VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR | VK_PIPELINE_CREATE_CAPTURE_INTERNAL_REPRESENTATIONS_BIT_KHR;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module.handle;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  info.layout = layout.handle;
  Scoped<VkPipeline> pipeline(device_, vkDestroyPipeline);
  require(vkCreateComputePipelines(device_, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline.handle),
          "pipeline of " + name);
  return describe(pipeline.handle, name);
}

CompiledShader NullDevice::describe(VkPipeline pipeline, const std::string& shader) const {
  const auto executables =
      load<PFN_vkGetPipelineExecutablePropertiesKHR>(device_, "vkGetPipelineExecutablePropertiesKHR");
  const auto statistics =
      load<PFN_vkGetPipelineExecutableStatisticsKHR>(device_, "vkGetPipelineExecutableStatisticsKHR");
  const auto representations = load<PFN_vkGetPipelineExecutableInternalRepresentationsKHR>(
      device_, "vkGetPipelineExecutableInternalRepresentationsKHR");

  VkPipelineInfoKHR pipelineInfo{};
  pipelineInfo.sType = VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR;
  pipelineInfo.pipeline = pipeline;
  std::uint32_t count = 0;
  require(executables(device_, &pipelineInfo, &count, nullptr), "executables of " + shader);
  if (count != 1) throw std::runtime_error("shader '" + shader + "' has " + std::to_string(count) + " executables");

  CompiledShader compiled;
  VkPipelineExecutableInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR;
  info.pipeline = pipeline;
  require(statistics(device_, &info, &count, nullptr), "statistics of " + shader);
  VkPipelineExecutableStatisticKHR emptyStatistic{};
  emptyStatistic.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
  std::vector<VkPipelineExecutableStatisticKHR> found(count, emptyStatistic);
  require(statistics(device_, &info, &count, found.data()), "statistics of " + shader);
  for (const VkPipelineExecutableStatisticKHR& statistic : found) addStatistic(statistic, smallestWave_, compiled);

  require(representations(device_, &info, &count, nullptr), "listings of " + shader);
  VkPipelineExecutableInternalRepresentationKHR emptyText{};
  emptyText.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INTERNAL_REPRESENTATION_KHR;
  std::vector<VkPipelineExecutableInternalRepresentationKHR> texts(count, emptyText);
  require(representations(device_, &info, &count, texts.data()), "listings of " + shader);
  std::vector<std::string> contents(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    contents[i].resize(texts[i].dataSize);
    texts[i].pData = contents[i].data();
  }
  require(representations(device_, &info, &count, texts.data()), "listings of " + shader);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (std::string_view(static_cast<const char*>(texts[i].name)) == "Assembly")
      compiled.assembly = contents[i].c_str();
  }
  if (compiled.assembly.empty()) throw std::runtime_error("the driver gives no assembly of shader '" + shader + "'");
  return compiled;
}

}  // namespace walr::costs
