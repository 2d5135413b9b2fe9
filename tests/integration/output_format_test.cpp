// The host chooses the format of the result.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <walr/walr_passes.h>
#include <glm/gtc/packing.hpp>

#include "tests/integration/hosted_run.h"
#include "tests/integration/replaced_function.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::output_format_test {
namespace {

constexpr glm::ivec2 kSize(53, 37);
constexpr std::uint32_t kFrames = 3;

template <typename Texel>
std::vector<Texel> texelsOf(const std::vector<std::byte>& bytes) {
  std::vector<Texel> texels(bytes.size() / sizeof(Texel));
  std::memcpy(texels.data(), bytes.data(), bytes.size());
  return texels;
}

/// An unsigned float with 5 bits of exponent. GLM's functions take subnormal values for normal ones.
float smallFloat(std::uint32_t bits, int mantissaBits) {
  const auto mantissa = static_cast<float>(bits & ((1U << mantissaBits) - 1U)) / float(1 << mantissaBits);
  const int exponent = static_cast<int>(bits >> mantissaBits & 31U);
  return exponent == 0 ? std::ldexp(mantissa, -14) : std::ldexp(1.0F + mantissa, exponent - 15);
}

glm::vec3 unpacked(std::uint32_t texel) {
  return {smallFloat(texel & 0x7ffU, 6), smallFloat(texel >> 11 & 0x7ffU, 6), smallFloat(texel >> 22, 5)};
}

std::vector<glm::vec3> decoded(VkFormat format, const std::vector<std::byte>& bytes) {
  std::vector<glm::vec3> colours;
  if (format == VK_FORMAT_B10G11R11_UFLOAT_PACK32) {
    for (const std::uint32_t texel : texelsOf<std::uint32_t>(bytes)) colours.push_back(unpacked(texel));
  } else if (format == VK_FORMAT_R32G32B32A32_SFLOAT) {
    for (const glm::vec4& texel : texelsOf<glm::vec4>(bytes)) colours.emplace_back(texel);
  } else {
    for (const glm::u16vec4& texel : texelsOf<glm::u16vec4>(bytes)) colours.emplace_back(glm::unpackHalf(texel));
  }
  return colours;
}

class OutputFormat : public fg::test::GpuTest {
 protected:
  /// The last result of some frames.
  std::vector<glm::vec3> denoise(VkFormat format, float exposure) {
    HostedRun::Options options;
    options.denoisedFormat = format;
    options.conventions.pre_exposed = exposure != 1.0F ? VK_TRUE : VK_FALSE;
    HostedRun run(device(), "walr", kSize, options);
    std::vector<std::byte> result;
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      const FrameDescription camera = cameraAt({0.06 * i, 0.0, 0.0}, {0.06 * (i - 1.0), 0.0, 0.0}, kSize, i);
      reference::HostFrame frame = renderFrame(sphere(), camera, kSize);
      // Light from far below the smallest normal value of the formats to near the largest value.
      reference::forEachPixel(
          kSize, [&](glm::ivec2 p) { frame.lighting[p] *= std::exp2(double(p.x) / 2.0 - 22.0) * double(exposure); });
      run.fill(frame);
      result = run.frameBytes(camera, 0, exposure);
    }
    return decoded(format, result);
  }

  WalrDenoiserInfo info(VkFormat format) {
    device_ = hostDevice(device());
    WalrDenoiserInfo info = denoiserInfo(&device_);
    info.denoised_format = format;
    return info;
  }
  WalrDevice device_{};
};

/// Unit roundoff and half the smallest value of a channel.
struct Precision {
  float roundoff = 0.0F;
  float halfStep = 0.0F;
};

void expectNear(const std::vector<glm::vec3>& got, const std::vector<glm::vec3>& exact,
                const std::array<Precision, 3>& precisions) {
  ASSERT_EQ(got.size(), exact.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const auto [roundoff, halfStep] = precisions[std::size_t(c)];
      EXPECT_LE(std::abs(got[i][c] - exact[i][c]), std::max(roundoff * exact[i][c], halfStep))
          << "pixel " << i << ", channel " << c << ": " << got[i][c] << " for " << exact[i][c];
    }
  }
}

// 6 mantissa bits in red and green and 5 in blue, 10 in a half; the smallest exponent of all is -14.
constexpr Precision kEleven{0x1p-7F, 0x1p-21F};
constexpr Precision kTen{0x1p-6F, 0x1p-20F};
constexpr Precision kHalf{0x1p-11F, 0x1p-25F};

TEST_F(OutputFormat, HoldsTheResultUpToItsRounding) {
  const std::vector<glm::vec3> halves = denoise(VK_FORMAT_UNDEFINED, 1.0F);
  EXPECT_GT(std::ranges::max(halves, {}, &glm::vec3::x).x, 1.0F);
  expectNear(denoise(VK_FORMAT_B10G11R11_UFLOAT_PACK32, 1.0F), halves, {kEleven, kEleven, kTen});
  EXPECT_EQ(denoise(VK_FORMAT_R32G32B32A32_SFLOAT, 1.0F), halves);
}

TEST_F(OutputFormat, IsRoundedOnceWithExposure) {
  constexpr float kExposure = 0.3F;
  const std::vector<glm::vec3> exact = denoise(VK_FORMAT_R32G32B32A32_SFLOAT, kExposure);
  // An image store may truncate, which gives twice the error of the nearest half.
  expectNear(denoise(VK_FORMAT_R16G16B16A16_SFLOAT, kExposure), exact,
             {Precision{2.0F * kHalf.roundoff, 2.0F * kHalf.halfStep},
              {2.0F * kHalf.roundoff, 2.0F * kHalf.halfStep},
              {2.0F * kHalf.roundoff, 2.0F * kHalf.halfStep}});
  expectNear(denoise(VK_FORMAT_B10G11R11_UFLOAT_PACK32, kExposure), exact, {kEleven, kEleven, kTen});
}

TEST_F(OutputFormat, IsListedForHostsPassByPass) {
  for (const bool withDevice : {false, true}) {
    WalrDenoiserInfo described = info(VK_FORMAT_B10G11R11_UFLOAT_PACK32);
    if (!withDevice) described.device = nullptr;
    WalrPasses passes = nullptr;
    require(createPasses(described, passes));
    const WalrPassList* list = nullptr;
    require(walr_get_pass_list(passes, &list));
    const auto* const found = std::find_if(list->resources, list->resources + list->resource_count,
                                           [](const WalrResource* r) { return std::string(r->name) == "denoised"; });
    ASSERT_NE(found, list->resources + list->resource_count);
    EXPECT_EQ((*found)->format, VK_FORMAT_B10G11R11_UFLOAT_PACK32);
    require(walr_destroy_passes(passes));
    // A single stage writes what it declares.
    described.method = "temporal_antialiasing";
    EXPECT_EQ(createPasses(described, passes), WALR_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(walr_last_error()).find("no denoised_format"), std::string::npos) << walr_last_error();
  }
}

void formatPropertiesWithoutPacked(VkPhysicalDevice device, VkFormat format, VkFormatProperties* properties) {
  realFunction<PFN_vkGetPhysicalDeviceFormatProperties>()(device, format, properties);
  if (format == VK_FORMAT_B10G11R11_UFLOAT_PACK32) {
    properties->optimalTilingFeatures &= ~VkFormatFeatureFlags(VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT);
  }
}

TEST_F(OutputFormat, ThatCannotBeWrittenIsRefusedByName) {
  WalrDenoiser denoiser = nullptr;
  WalrDenoiserInfo described = info(VK_FORMAT_R8G8B8A8_UNORM);
  EXPECT_EQ(walr_create_denoiser(&described, &denoiser), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_NE(std::string(walr_last_error()).find("denoised_format is R8G8B8A8_UNORM (37): it must be R16G16B16A16_"),
            std::string::npos)
      << walr_last_error();

  described = info(VK_FORMAT_B10G11R11_UFLOAT_PACK32);
  device_.get_instance_proc_addr =
      replaceFunction(context(), "vkGetPhysicalDeviceFormatProperties", formatPropertiesWithoutPacked);
  EXPECT_EQ(walr_create_denoiser(&described, &denoiser), WALR_ERROR_UNSUPPORTED);
  EXPECT_NE(std::string(walr_last_error()).find("denoised_format, B10G11R11_UFLOAT_PACK32: use R16G16B16A16_SFLOAT"),
            std::string::npos)
      << walr_last_error();
  WalrPasses passes = nullptr;
  EXPECT_EQ(createPasses(described, passes), WALR_ERROR_UNSUPPORTED);
  // A caller with an older header has no such field.
  described.struct_size = offsetof(WalrDenoiserInfo, denoised_format);
  require(walr_create_denoiser(&described, &denoiser));
  require(walr_destroy_denoiser(denoiser));
}

}  // namespace
}  // namespace walr::test::output_format_test
