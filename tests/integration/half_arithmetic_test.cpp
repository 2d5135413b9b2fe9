// A host that enables shaderFloat16 gets shaders that compute in halves, and the same picture up to rounding.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/gtc/packing.hpp>

#include "tests/integration/hosted_run.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::half_arithmetic_test {
namespace {

constexpr glm::ivec2 kSize(45, 37);

/// What a device was created with: what the library needs, and perhaps shaderFloat16.
struct CreateInfo {
  explicit CreateInfo(bool halves) {
    float16.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_FLOAT16_INT8_FEATURES;
    float16.shaderFloat16 = halves ? VK_TRUE : VK_FALSE;
    synchronization2.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES;
    synchronization2.pNext = &float16;
    synchronization2.synchronization2 = VK_TRUE;
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &synchronization2;
    features.features.shaderStorageImageExtendedFormats = VK_TRUE;
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &features;
  }
  CreateInfo(const CreateInfo&) = delete;
  CreateInfo& operator=(const CreateInfo&) = delete;

  VkPhysicalDeviceShaderFloat16Int8Features float16{};
  VkPhysicalDeviceSynchronization2Features synchronization2{};
  VkPhysicalDeviceFeatures2 features{};
  VkDeviceCreateInfo info{};
};

class HalfArithmeticTest : public fg::test::GpuTest {
 protected:
  static std::vector<std::uint16_t> frame(const fg::test::TestDevice& device, const VkDeviceCreateInfo* createInfo) {
    HostedRun::Options options;
    options.createInfo = createInfo;
    HostedRun run(device, "flnr", kSize, options);
    const FrameDescription camera = cameraAt({}, {}, kSize, 0);
    run.fill(renderFrame(stairs(), camera, kSize));
    return run.frame(camera);
  }
};

TEST_F(HalfArithmeticTest, IsTakenIfTheCreateInfoEnablesIt) {
  const fg::vk::PhysicalDevice physical = fg::vk::physicalDevices(instance()).front();
  if (!physical.shaderFloat16) GTEST_SKIP() << "the device has no feature shaderFloat16";
  const fg::test::TestDevice device(instance(), physical, {}, nullptr, fg::vk::HalfArithmetic::WhereSupported);
  const CreateInfo with(true);
  const CreateInfo without(false);
  const std::vector<std::uint16_t> halves = frame(device, &with.info);
  const std::vector<std::uint16_t> singles = frame(device, &without.info);
  EXPECT_EQ(frame(device, nullptr), singles);
  EXPECT_NE(halves, singles);

  // Guides differ by some thousandths, which guide_network_test.cpp bounds. Of that the fit passes on less: measured
  // are 2.9e-4 of the light's root mean square.
  double difference = 0.0;
  double light = 0.0;
  for (std::size_t i = 0; i < halves.size(); ++i) {
    const auto a = double(glm::unpackHalf1x16(halves[i]));
    const auto b = double(glm::unpackHalf1x16(singles[i]));
    ASSERT_TRUE(std::isfinite(a));
    difference += (a - b) * (a - b);
    light += b * b;
  }
  EXPECT_LT(std::sqrt(difference / light), 0.001);
}

}  // namespace
}  // namespace walr::test::half_arithmetic_test
