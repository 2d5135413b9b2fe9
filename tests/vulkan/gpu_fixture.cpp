#include "tests/vulkan/gpu_fixture.h"

#include <stdexcept>
#include <string_view>

#include "framegraph/vulkan/validation_settings.h"

namespace fg::test {

void GpuTest::SetUp() {
  vk::InstanceOptions options;
  options.applicationName = "walr tests";
  options.validation = true;
  options.sink = log_.sink();
  instance_ = std::make_unique<vk::Instance>(options);
  device_ = std::make_unique<vk::Device>(*instance_, vk::physicalDevices(*instance_).front());
}

void GpuTest::TearDown() {
  device_.reset();
  instance_.reset();
  for (const vk::Message& message : log_.take()) ADD_FAILURE() << "validation: " << message.text;
}

std::uint32_t GpuTest::layerVersion() {
  const auto enumerate = reinterpret_cast<PFN_vkEnumerateInstanceLayerProperties>(
      vk::openLoader()(VK_NULL_HANDLE, "vkEnumerateInstanceLayerProperties"));
  std::uint32_t count = 0;
  enumerate(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  enumerate(&count, layers.data());
  for (const VkLayerProperties& layer : layers) {
    if (std::string_view(layer.layerName) == vk::kValidationLayer) return layer.specVersion;
  }
  throw std::logic_error("the validation layer, which the fixture loads, is not listed");
}

}  // namespace fg::test
