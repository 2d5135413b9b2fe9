#include <algorithm>
#include <bit>
#include <cstdint>

#include "framegraph/check/checks.h"
#include "framegraph/declare/access.h"
#include "framegraph/declare/format.h"
#include "framegraph/plan/names.h"

namespace fg {
namespace {

/// Indexed by resource: the union of the image usages of all declared accesses, and of the host's use after an export.
std::vector<VkImageUsageFlags> declaredUsage(const GraphDesc& graph) {
  std::vector<VkImageUsageFlags> usage(graph.resources.size());
  for (const PassDecl& pass : graph.passes) {
    for (const AccessDecl& access : pass.accesses) {
      if (validHandle(graph, access)) usage[access.resource] |= accessInfo(access.access).imageUsage;
    }
  }
  for (const ExportDecl& exported : graph.exports) {
    const std::uint32_t resource = exported.resource.resource;
    if (resource < usage.size()) usage[resource] |= imageUsageIn(exported.release);
  }
  return usage;
}

void checkNames(const Topology& topology, Findings& findings) {
  const GraphDesc& graph = topology.graph();
  for (std::size_t i = 1; i < topology.passesByName().size(); ++i) {
    const PassDecl& pass = graph.passes[topology.passesByName()[i]];
    if (pass.name != graph.passes[topology.passesByName()[i - 1]].name) continue;
    findings.error(code::kDuplicateName, pass,
                   "two passes are called '" + pass.name + "'; give each pass a name of its own");
  }
  for (std::size_t i = 1; i < topology.resourcesByName().size(); ++i) {
    const ResourceDecl& resource = graph.resources[topology.resourcesByName()[i]];
    if (resource.name != graph.resources[topology.resourcesByName()[i - 1]].name) continue;
    findings.error(code::kDuplicateName, resource,
                   "two resources are called '" + resource.name + "'; give each resource a name of its own");
  }
}

// No device has larger limits. Within them, no sum of sizes overflows 64 bits.
constexpr std::uint32_t kLargestSide = 1U << 16;
constexpr std::uint32_t kMostLayers = 1U << 12;
constexpr std::uint64_t kLargestBuffer = std::uint64_t{1} << 46;

void checkSize(const ResourceDecl& resource, Findings& findings) {
  if (const auto* buffer = std::get_if<BufferDesc>(&resource.desc)) {
    if (buffer->size == 0) findings.error(code::kEmptyExtent, resource, "buffer '" + resource.name + "' has no bytes");
    if (buffer->size > kLargestBuffer) {
      findings.error(code::kTooLarge, resource,
                     "buffer '" + resource.name + "' has " + std::to_string(buffer->size) + " bytes; the limit is " +
                         std::to_string(kLargestBuffer));
    }
    return;
  }
  const auto& texture = std::get<TextureDesc>(resource.desc);
  const Extent extent = texture.extent;
  if (extent.width == 0 || extent.height == 0 || texture.mipLevels == 0 || texture.arrayLayers == 0) {
    findings.error(code::kEmptyExtent, resource,
                   "texture '" + resource.name + "' is empty: " + std::to_string(extent.width) + "x" +
                       std::to_string(extent.height) + ", " + std::to_string(texture.mipLevels) + " mip levels, " +
                       std::to_string(texture.arrayLayers) + " layers");
    return;
  }
  if (std::max(extent.width, extent.height) > kLargestSide || texture.arrayLayers > kMostLayers) {
    findings.error(code::kTooLarge, resource,
                   "texture '" + resource.name + "' has " + std::to_string(extent.width) + "x" +
                       std::to_string(extent.height) + " texels and " + std::to_string(texture.arrayLayers) +
                       " layers; the limits are " + std::to_string(kLargestSide) + " texels a side and " +
                       std::to_string(kMostLayers) + " layers");
    return;
  }
  const auto levels = static_cast<std::uint32_t>(std::bit_width(std::max(extent.width, extent.height)));
  if (texture.mipLevels > levels) {
    findings.error(code::kTooLarge, resource,
                   "texture '" + resource.name + "' has " + std::to_string(texture.mipLevels) +
                       " mip levels, but its extent allows only " + std::to_string(levels));
  }
}

void checkFormat(const ResourceDecl& resource, VkImageUsageFlags usage, const MemoryModel& memory, Findings& findings) {
  const auto* texture = std::get_if<TextureDesc>(&resource.desc);
  if (texture == nullptr || usage == 0 || memory.supports(texture->format, usage)) return;
  const FormatInfo& info = formatInfo(texture->format);
  std::string message = "texture '" + resource.name + "': this device does not support optimally tiled " +
                        std::string(info.name) + " (" + std::to_string(texture->format) + ") for " +
                        imageUsageNames(usage);
  if (info.fallback != VK_FORMAT_UNDEFINED) {
    message += "; the documented fallback is " + std::string(formatInfo(info.fallback).name);
    if (!memory.supports(info.fallback, usage)) message += ", which the device does not support either";
  } else {
    message += "; choose another format";
  }
  findings.error(code::kFormatUnsupported, resource, std::move(message));
}

}  // namespace

void checkResources(const Topology& topology, const MemoryModel& memory, Findings& findings) {
  const GraphDesc& graph = topology.graph();
  checkNames(topology, findings);
  const std::vector<VkImageUsageFlags> usage = declaredUsage(graph);
  for (std::size_t i = 0; i < graph.resources.size(); ++i) {
    const ResourceDecl& resource = graph.resources[i];
    checkSize(resource, findings);
    checkFormat(resource, usage[i], memory, findings);
    if (resource.lifetime == Lifetime::Imported && !resource.acquire) {
      findings.error(code::kImportWithoutState, resource,
                     "import '" + resource.name +
                         "' has no state; give the layout, stages and accesses in which the host leaves it");
    }
  }
}

}  // namespace fg
