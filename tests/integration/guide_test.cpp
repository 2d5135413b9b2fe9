// Tables of the integration guide that need no device: the image formats that the library takes, and what it saves that
// two lights share their guides.
// `cmake --build build --target update_guide` writes it again.
#include <algorithm>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "framegraph/compile/compile.h"
#include "framegraph/declare/format.h"
#include "integration/denoise_graph.h"
#include "integration/host_inputs.h"
#include "passes/conventions/light_direction.h"
#include "passes/methods/denoiser.h"
#include "passes/stage/expected_error.h"
#include "passes/stage/history_length.h"
#include "passes/stage/inspection.h"
#include "tests/guide_table.h"

namespace walr {
namespace {

/// Formats that engines store such images in.
constexpr VkFormat kCommonFormats[] = {
    VK_FORMAT_R8_UNORM,
    VK_FORMAT_R16_UNORM,
    VK_FORMAT_R16_SFLOAT,
    VK_FORMAT_R32_SFLOAT,
    VK_FORMAT_D16_UNORM,
    VK_FORMAT_D24_UNORM_S8_UINT,
    VK_FORMAT_D32_SFLOAT,
    VK_FORMAT_R8G8_UNORM,
    VK_FORMAT_R8G8_SNORM,
    VK_FORMAT_R16G16_UNORM,
    VK_FORMAT_R16G16_SNORM,
    VK_FORMAT_R16G16_SFLOAT,
    VK_FORMAT_R32G32_SFLOAT,
    VK_FORMAT_B10G11R11_UFLOAT_PACK32,
    VK_FORMAT_E5B9G9R9_UFLOAT_PACK32,
    VK_FORMAT_R8G8B8A8_UNORM,
    VK_FORMAT_R8G8B8A8_SRGB,
    VK_FORMAT_R8G8B8A8_SNORM,
    VK_FORMAT_A2B10G10R10_UNORM_PACK32,
    VK_FORMAT_A2R10G10B10_UNORM_PACK32,
    VK_FORMAT_R16G16B16A16_UNORM,
    VK_FORMAT_R16G16B16A16_SNORM,
    VK_FORMAT_R16G16B16A16_SFLOAT,
    VK_FORMAT_R32G32B32A32_SFLOAT,
    VK_FORMAT_R8_UINT,
    VK_FORMAT_R16_UINT,
    VK_FORMAT_R32_UINT,
    VK_FORMAT_R32G32_UINT,
};

/// An image of the guide's table.
struct Column {
  std::string name;
  VkFormat usual;
  std::function<bool(VkFormat)> takes;
};

/// Whether an input may have a format: what walr_create_denoiser checks.
bool accepted(std::string_view name, VkFormat format, const InputConventions& conventions,
              const HostConventions& host) {
  std::vector<VkFormat> formats;
  for (const HostInput& input : kHostInputs) {
    const VkFormat usual = input.optional ? VK_FORMAT_UNDEFINED : input.format;
    formats.push_back(input.name == name ? format : usual);
  }
  fg::Graph scratch;
  try {
    (void)importInputs(scratch, {64, 48}, conventions, kComputeHost.inputs, formats, host);
  } catch (const std::invalid_argument&) {
    return false;
  }
  return true;
}

std::vector<Column> columns() {
  std::vector<Column> result;
  const auto add = [&](std::string_view name, const std::string& how, const InputConventions& conventions,
                       const HostConventions& host) {
    const HostInput& input = *hostInputNamed(name);
    const auto takes = [=](VkFormat format) { return accepted(input.name, format, conventions, host); };
    result.push_back(
        {"`" + std::string(name) + "`" + how, takes(input.format) ? input.format : VK_FORMAT_UNDEFINED, takes});
  };
  for (const HostInput& input : kHostInputs) {
    add(input.name, "", {.specular = input.of == HostInput::Of::SpecularLight}, {});
    if (input.name == "lighting") {
      add(input.name, " masked", {.light = {.masked = true}}, {});
      add(input.name, " specular", {.specular = true}, {});
    }
    if (input.name == "normal")
      add(input.name, " octahedral", {}, {.normal = HostConventions::Normal::OctahedralSigned});
    if (input.name == "motion") {
      // Four channels may be given, but need not.
      add(input.name, " without depth", {.motionDepth = InputConventions::MotionDepth::Found}, {});
    }
  }
  const auto one = [](VkFormat wanted) { return [wanted](VkFormat format) { return format == wanted; }; };
  result.push_back({"`denoised`", kResultFormats.front(),
                    [](VkFormat format) { return std::ranges::find(kResultFormats, format) != kResultFormats.end(); }});
  result.push_back({"`history_length`", kHistoryLengthFormat, one(kHistoryLengthFormat)});
  result.push_back({"`light_direction`", kLightDirectionFormat, one(kLightDirectionFormat)});
  result.push_back({"`expected_error`", kExpectedErrorFormat, one(kExpectedErrorFormat)});
  result.push_back({"`view`", kViewFormat, one(kViewFormat)});
  return result;
}

std::string formatTable() {
  const std::vector<Column> images = columns();
  std::string text = "| |";
  for (const Column& image : images) text += " " + image.name + " |";
  text += "\n| --- |";
  for (std::size_t i = 0; i < images.size(); ++i) text += " --- |";
  text += "\n";
  for (const VkFormat format : kCommonFormats) {
    text += "| " + std::string(fg::formatInfo(format).name) + " |";
    for (const Column& image : images) {
      text += format == image.usual ? " usual |" : image.takes(format) ? " yes |" : " |";
    }
    text += "\n";
  }
  return text;
}

/// What a plan for 1920 x 1080 costs.
struct Costs {
  double bytesPerPixel;
  double persistent;  ///< MiB.
  double transient;   ///< MiB.
};

/// @param lights number of lights that share their guides
Costs costsOf(std::size_t lights) {
  constexpr fg::Extent kExtent{1920, 1080};
  constexpr double kMebibyte = 1024.0 * 1024.0;
  const auto method = makeDenoiser("walr");
  const std::vector<DenoisedLight> all(lights, {method.get()});
  const DenoiseGraph declared = declareDenoiseGraph(all, kExtent, {}, kComputeHost);
  const fg::CompileResult result = fg::compile(declared.graph.desc(), fg::TableMemoryModel());
  if (!result.ok()) throw std::runtime_error(result.text());
  const auto bytes = static_cast<double>(result.plan.traffic.bytesRead + result.plan.traffic.bytesWritten);
  const fg::MemoryReport& memory = result.plan.memory;
  return {bytes / (kExtent.width * kExtent.height), static_cast<double>(memory.persistentBytes) / kMebibyte,
          static_cast<double>(memory.transientPeakBytes) / kMebibyte};
}

/// Denoisers that share objects keep their own histories, and use the memory of transients in turn.
std::string twoLightsTable() {
  const Costs one = costsOf(1), shared = costsOf(2);
  char text[256];
  std::snprintf(text, sizeof(text),
                "| | two denoisers | shared guides |\n"
                "| --- | --- | --- |\n"
                "| bytes per pixel | %.1f | %.1f |\n"
                "| memory, MiB | %.1f | %.1f |\n",
                2.0 * one.bytesPerPixel, shared.bytesPerPixel, 2.0 * one.persistent + one.transient,
                shared.persistent + shared.transient);
  return text;
}

TEST(Guide, CostsOfTwoLightsAreThoseOfThePlans) {
  const test::GuideTable guide(WALR_GUIDE "/advanced.md", "Two lights");
  if (test::GuideTable::writing()) return guide.write(twoLightsTable());
  EXPECT_EQ(guide.text(), twoLightsTable()) << "build the target update_guide";
}

TEST(Guide, KnowsTheFormatsOfItsTable) {
  for (const VkFormat format : kCommonFormats) EXPECT_NE(fg::formatInfo(format).name, "unknown") << format;
}

TEST(Guide, ImageFormatsAreThoseThatTheLibraryChecks) {
  const test::GuideTable guide(WALR_GUIDE "/images.md", "Image formats");
  if (test::GuideTable::writing()) return guide.write(formatTable());
  EXPECT_EQ(guide.text(), formatTable()) << "build the target update_guide";
}

}  // namespace
}  // namespace walr
