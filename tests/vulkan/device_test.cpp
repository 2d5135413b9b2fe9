#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "framegraph/vulkan/driver_memory_model.h"
#include "framegraph/vulkan/error.h"
#include "tests/error_text.h"
#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/graph_run.h"
#include "tests/vulkan/test_graphs.h"

namespace fg::test {
namespace {

using DeviceTest = GpuTest;

TEST_F(DeviceTest, ListingNamesDeviceAndDriver) {
  const auto devices = vk::physicalDevices(instance());
  const std::string text = vk::listing(devices);
  for (const vk::PhysicalDevice& device : devices) {
    expectContains(text, {std::to_string(device.index) + ": " + device.name});
    EXPECT_FALSE(device.driver.empty());
    expectContains(text, {device.driver});
  }
}

vk::PhysicalDevice fakeDevice(std::uint32_t index, std::string name, VkPhysicalDeviceType type) {
  vk::PhysicalDevice device;
  device.index = index;
  device.name = std::move(name);
  device.driver = "fake 1.0";
  device.type = type;
  device.apiVersion = VK_API_VERSION_1_3;
  device.computeQueueFamily = 0;
  device.synchronization2 = true;
  device.features.shaderStorageImageExtendedFormats = VK_TRUE;
  device.formatFeatures = [](VkFormat) { return ~VkFormatFeatureFlags{0}; };
  return device;
}

TEST(ChooseDevice, ByIndexByPartOfTheNameAndByType) {
  const std::vector<vk::PhysicalDevice> devices = {
      fakeDevice(0, "llvmpipe", VK_PHYSICAL_DEVICE_TYPE_CPU),
      fakeDevice(1, "Integrated Thing", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU),
      fakeDevice(2, "Discrete Thing 7600", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU),
  };
  EXPECT_EQ(vk::choose(devices, "").index, 2u);
  EXPECT_EQ(vk::choose(devices, "0").index, 0u);
  EXPECT_EQ(vk::choose(devices, "LLVM").index, 0u);
  EXPECT_EQ(vk::choose(devices, "thing").index, 1u);
  EXPECT_EQ(vk::choose(devices, "7600").index, 2u);
  const std::string message = errorText<vk::Unsupported>([&] { (void)vk::choose(devices, "radeon"); });
  expectContains(message, {"no Vulkan device 'radeon'"});
  expectContains(message, {"1: Integrated Thing"});
  expectError<vk::Unsupported>([&] { (void)vk::choose(devices, "3"); }, {"no Vulkan device '3'"});
}

TEST(RequireDevice, NamesEveryMissingFeatureAndFormat) {
  vk::PhysicalDevice device = fakeDevice(0, "Old Thing", VK_PHYSICAL_DEVICE_TYPE_OTHER);
  const std::vector<vk::FormatUse> uses = {
      {VK_FORMAT_R16G16B16A16_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, "moments"}};
  EXPECT_TRUE(vk::missing(device, uses).empty());

  device.synchronization2 = false;
  device.features.shaderStorageImageExtendedFormats = VK_FALSE;
  device.formatFeatures = [](VkFormat) { return VkFormatFeatureFlags{VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT}; };
  const std::string message = errorText<vk::Unsupported>([&] { vk::require(device, uses); });
  expectContains(message, {"'Old Thing' (fake 1.0)"});
  expectContains(message, {"synchronization2 (Vulkan 1.3 or VK_KHR_synchronization2): update the driver"});
  expectContains(message, {"shaderStorageImageExtendedFormats"});
  expectContains(message, {"of 'moments' as storage image"});

  device.apiVersion = VK_API_VERSION_1_0;
  device.computeQueueFamily = kNone;
  EXPECT_EQ(vk::missing(device, uses).size(), 5u);
}

TEST(RequireDevice, NamesAnImageThatIsTooLarge) {
  vk::PhysicalDevice device = fakeDevice(0, "Small Thing", VK_PHYSICAL_DEVICE_TYPE_OTHER);
  device.maxImageSide = 4096;
  std::vector<vk::FormatUse> uses = {
      {VK_FORMAT_R16G16B16A16_SFLOAT, VK_IMAGE_USAGE_SAMPLED_BIT, "moments", {4096, 4096}}};
  EXPECT_TRUE(vk::missing(device, uses).empty());
  uses.front().extent.height = 4097;
  expectError<vk::Unsupported>([&] { vk::require(device, uses); },
                               {"'moments', 4096 x 4097 pixels: use at most 4096 pixels a side"});
}

TEST_F(DeviceTest, SupportsTheFormatsOfAPlan) {
  Graph graph;
  chain(graph, 0, 2);
  const auto uses = vk::formatUses(graph.desc(), compileFor(context(), graph));
  ASSERT_EQ(uses.size(), 3u);
  EXPECT_EQ(uses.front().format, VK_FORMAT_R32_UINT);
  EXPECT_NO_THROW(vk::require(vk::physicalDevices(instance()).front(), uses));
}

TEST(NoDriver, MessageNamesTheRemedy) {
  // Later cases need the environment restored.
  const char* names[] = {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"};
  for (const char* name : names) setenv(name, "/nowhere/at/all.json", 1);
  const std::string message = errorText<vk::Unsupported>([] {
    const vk::Instance instance;
    (void)vk::physicalDevices(instance);
  });
  for (const char* name : names) unsetenv(name);
  expectContains(message, {"no Vulkan d"});
  expectContains(message, {"mesa-vulkan-drivers"});
}

int destroyedInstances = 0;

TEST(FailedInstance, IsDestroyed) {
  // A loader that lacks a function of instances.
  const auto entry = [](VkInstance instance, const char* name) -> PFN_vkVoidFunction {
    static PFN_vkDestroyInstance destroy = nullptr;
    const PFN_vkVoidFunction function = vk::openLoader()(instance, name);
    if (std::string_view(name) == "vkEnumeratePhysicalDevices") return nullptr;
    if (std::string_view(name) != "vkDestroyInstance") return function;
    destroy = reinterpret_cast<PFN_vkDestroyInstance>(function);
    const PFN_vkDestroyInstance count = [](VkInstance gone, const VkAllocationCallbacks* allocator) {
      ++destroyedInstances;
      destroy(gone, allocator);
    };
    return reinterpret_cast<PFN_vkVoidFunction>(count);
  };
  EXPECT_THROW(const vk::Instance instance({}, entry), vk::Unsupported);
  EXPECT_EQ(destroyedInstances, 1);
}

TEST(NoLayer, MessageNamesTheRemedy) {
  const auto entry = [](VkInstance instance, const char* name) -> PFN_vkVoidFunction {
    if (std::string_view(name) != "vkEnumerateInstanceLayerProperties") return vk::openLoader()(instance, name);
    const PFN_vkEnumerateInstanceLayerProperties none = [](std::uint32_t* count, VkLayerProperties*) {
      *count = 0;
      return VK_SUCCESS;
    };
    return reinterpret_cast<PFN_vkVoidFunction>(none);
  };
  const std::string message = errorText<vk::Unsupported>([&] {
    vk::InstanceOptions options;
    options.validation = true;
    const vk::Instance instance(options, entry);
  });
  expectContains(message,
                 {"VK_LAYER_KHRONOS_validation is not installed: install the package vulkan-validationlayers"});
}

TEST_F(DeviceTest, MissingFunctionIsNamed) {
  static PFN_vkGetDeviceProcAddr real;
  real = instance().functions().vkGetDeviceProcAddr;
  const PFN_vkGetDeviceProcAddr withoutSynchronization2 = [](VkDevice handle, const char* name) -> PFN_vkVoidFunction {
    return std::string_view(name).starts_with("vkCmdPipelineBarrier2") ? nullptr : real(handle, name);
  };
  const std::string message = errorText<vk::Unsupported>(
      [&] { (void)vk::DeviceFunctions::load(context().view.device, withoutSynchronization2); });
  expectContains(message, {"vkCmdPipelineBarrier2 is missing"});
  expectContains(message, {"VK_KHR_synchronization2"});
}

TEST_F(DeviceTest, ExtensionFunctionsReplaceMissingCoreFunctions) {
  static PFN_vkGetDeviceProcAddr real;
  real = instance().functions().vkGetDeviceProcAddr;
  // As on a device of Vulkan 1.1 with the extension.
  const PFN_vkGetDeviceProcAddr extensionOnly = [](VkDevice handle, const char* name) -> PFN_vkVoidFunction {
    const std::string_view wanted = name;
    if (wanted == "vkCmdPipelineBarrier2" || wanted == "vkCmdWriteTimestamp2") return nullptr;
    if (wanted == "vkCmdPipelineBarrier2KHR") return real(handle, "vkCmdPipelineBarrier2");
    if (wanted == "vkCmdWriteTimestamp2KHR") return real(handle, "vkCmdWriteTimestamp2");
    return real(handle, name);
  };
  const auto functions = vk::DeviceFunctions::load(context().view.device, extensionOnly);
  EXPECT_EQ(functions.vkCmdPipelineBarrier2, context().functions.vkCmdPipelineBarrier2);
}

TEST_F(DeviceTest, MemoryModelQueriesTheDriverWithAndWithoutMaintenance4) {
  vk::DeviceContext old = context();
  old.functions.vkGetDeviceImageMemoryRequirements = nullptr;
  old.functions.vkGetDeviceBufferMemoryRequirements = nullptr;
  const vk::DriverMemoryModel modern(context());
  const vk::DriverMemoryModel throwaway(old);
  const TextureDesc desc{VK_FORMAT_R16G16B16A16_SFLOAT, {123, 45}};
  const auto usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT;
  const MemoryRequirements asked = modern.texture(desc, usage);
  const MemoryRequirements made = throwaway.texture(desc, usage);
  EXPECT_GE(asked.size, 123u * 45u * 8u);
  EXPECT_EQ(asked.size, made.size);
  EXPECT_EQ(asked.alignment, made.alignment);
  EXPECT_EQ(asked.memoryTypeBits, made.memoryTypeBits);
  EXPECT_EQ(modern.buffer({1000}, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT).size,
            throwaway.buffer({1000}, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT).size);
  EXPECT_TRUE(modern.supports(VK_FORMAT_R16G16B16A16_SFLOAT, usage));
  EXPECT_FALSE(modern.supports(VK_FORMAT_BC1_RGB_UNORM_BLOCK, VK_IMAGE_USAGE_STORAGE_BIT));
}

}  // namespace
}  // namespace fg::test
