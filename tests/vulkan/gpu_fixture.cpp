#include "tests/vulkan/gpu_fixture.h"

namespace fg::test {

void GpuTest::SetUp() {
  vk::InstanceOptions options;
  options.applicationName = "walr tests";
  options.validation = true;
  options.sink = log_.sink();
  instance_ = std::make_unique<vk::Instance>(options);
  device_ = std::make_unique<TestDevice>(*instance_, vk::physicalDevices(*instance_).front(),
                                         std::span<const char* const>{}, nullptr, vk::HalfArithmetic::Never);
}

void GpuTest::TearDown() {
  device_.reset();
  instance_.reset();
  for (const vk::Message& message : log_.take()) ADD_FAILURE() << "validation: " << message.text;
}

}  // namespace fg::test
