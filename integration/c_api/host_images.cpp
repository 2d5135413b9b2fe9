#include "integration/c_api/host_images.h"

#include <algorithm>
#include <string>

#include "framegraph/declare/format.h"
#include "framegraph/vulkan/image.h"
#include "integration/c_api/structs.h"

namespace walr::api {
namespace {

constexpr VkImageLayout kInputLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
constexpr VkImageLayout kOutputLayout = VK_IMAGE_LAYOUT_GENERAL;

/// How the denoiser accesses an image.
struct InnerUse {
  VkAccessFlags2 access;
  VkImageLayout layout;
};

bool isWritten(std::size_t index) {
  return imageSlots().at(index).role != ImageRole::Input;
}

InnerUse innerUse(std::size_t index) {
  if (isWritten(index)) return {VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, kOutputLayout};
  return {VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, kInputLayout};
}

[[noreturn]] void reject(std::size_t index, const std::string& what) {
  throw Error(WALR_ERROR_INVALID_ARGUMENT, "image '" + imageSlots().at(index).name() + "' " + what);
}

std::string sizeText(fg::Extent extent) {
  return std::to_string(extent.width) + " x " + std::to_string(extent.height);
}

std::string formatText(VkFormat format) {
  return std::string(fg::formatInfo(format).name) + " (" + std::to_string(format) + ")";
}

/// Layouts that an image can be left in.
bool isStateLayout(VkImageLayout layout) {
  return layout != VK_IMAGE_LAYOUT_UNDEFINED && layout != VK_IMAGE_LAYOUT_PREINITIALIZED;
}

void fillRelease(std::size_t index, WalrImage& image) {
  if (image.release.layout != VK_IMAGE_LAYOUT_UNDEFINED) return;
  image.release = {.stage = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                   .access = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
                   .layout = isWritten(index) ? kOutputLayout : image.acquire.layout,
                   .reserved = 0};
}

bool sameState(const WalrImageState& a, const WalrImageState& b) {
  return a.stage == b.stage && a.access == b.access && a.layout == b.layout;
}

VkImageMemoryBarrier2 barrierOf(const WalrImage& image) {
  VkImageMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image.image;
  barrier.subresourceRange =
      fg::vk::subresourceRange(image.format, {.baseMip = 0, .mipCount = 1, .baseLayer = 0, .layerCount = 1});
  return barrier;
}

template <typename MakeBarrier>
void record(const fg::vk::DeviceContext& device, VkCommandBuffer commandBuffer, const FrameImages& images,
            MakeBarrier makeBarrier) {
  std::array<VkImageMemoryBarrier2, kImageCount> barriers{};
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (images[i].given && !images[i].repeated) barriers[count++] = makeBarrier(images[i].image, innerUse(i));
  }
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.imageMemoryBarrierCount = count;
  info.pImageMemoryBarriers = barriers.data();
  if (count > 0) device.functions.vkCmdPipelineBarrier2(commandBuffer, &info);
}

bool isLighting(std::size_t index) {
  return imageSlots().at(index).ofLight == &LightImages::lighting;
}

/// Members of `WalrFrame` that hold the images of a light.
struct LightMembers {
  const WalrImage* WalrFrame::*lighting;
  const WalrImage* WalrFrame::*confidence;
  const WalrImage* WalrFrame::*denoised;
  const WalrImage* WalrFrame::*historyLength;
  const WalrImage* WalrFrame::*lightDirection;
  const WalrImage* WalrFrame::*expectedError;
};

constexpr std::array<LightMembers, kMostLights> kLightMembers{
    {{&WalrFrame::lighting, &WalrFrame::confidence, &WalrFrame::denoised, &WalrFrame::history_length,
      &WalrFrame::light_direction, &WalrFrame::expected_error},
     {&WalrFrame::second_lighting, &WalrFrame::second_confidence, &WalrFrame::second_denoised,
      &WalrFrame::second_history_length, &WalrFrame::second_light_direction, &WalrFrame::second_expected_error}}};

/// An input that lights share.
struct SharedMember {
  fg::Texture DenoiserInputs::*texture;
  const WalrImage* WalrFrame::*given;
};

constexpr std::array kSharedMembers{SharedMember{&DenoiserInputs::depth, &WalrFrame::depth},
                                    SharedMember{&DenoiserInputs::normal, &WalrFrame::normal},
                                    SharedMember{&DenoiserInputs::motion, &WalrFrame::motion},
                                    SharedMember{&DenoiserInputs::albedo, &WalrFrame::albedo},
                                    SharedMember{&DenoiserInputs::objectId, &WalrFrame::object_id},
                                    SharedMember{&DenoiserInputs::specularAlbedo, &WalrFrame::specular_albedo},
                                    SharedMember{&DenoiserInputs::roughness, &WalrFrame::roughness},
                                    SharedMember{&DenoiserInputs::specularMotion, &WalrFrame::specular_motion}};

/// A slot for an image of a light.
/// @param name of the first light's image
ImageSlot lightSlot(std::size_t light, std::string_view name, const WalrImage* WalrFrame::*LightMembers::*member,
                    ImageRole role, fg::Texture LightImages::*texture) {
  return {.prefix = kLightNames.at(light).images,
          .first = name,
          .given = kLightMembers.at(light).*member,
          .role = role,
          .light = light,
          .ofLight = texture};
}

ImageSlot lightingSlot(std::size_t light) {
  return lightSlot(light, kLightingName, &LightMembers::lighting, ImageRole::Input, &LightImages::lighting);
}

ImageSlot confidenceSlot(std::size_t light) {
  return lightSlot(light, kConfidenceName, &LightMembers::confidence, ImageRole::Input, &LightImages::confidence);
}

ImageSlot inputSlot(const HostInput& input) {
  if (input.texture == &DenoiserInputs::lighting) return lightingSlot(0);
  if (input.texture == &DenoiserInputs::confidence) return confidenceSlot(0);
  const auto shared = std::ranges::find(kSharedMembers, input.texture, &SharedMember::texture);
  return {
      .prefix = {}, .first = input.name, .given = shared->given, .role = ImageRole::Input, .ofInputs = input.texture};
}

std::array<ImageSlot, kImageCount> makeSlots() {
  std::array<ImageSlot, kImageCount> slots;
  auto slot = slots.begin();
  for (const HostInput& input : kHostInputs) *slot++ = inputSlot(input);
  for (std::size_t i = 1; i < kMostLights; ++i) {
    *slot++ = lightingSlot(i);
    *slot++ = confidenceSlot(i);
  }
  for (std::size_t i = 0; i < kMostLights; ++i) {
    *slot++ = lightSlot(i, kOutputName, &LightMembers::denoised, ImageRole::Result, &LightImages::output);
  }
  *slot++ = {.prefix = {}, .first = "view", .given = &WalrFrame::view, .role = ImageRole::Inspection};
  for (std::size_t i = 0; i < kMostLights; ++i) {
    *slot++ = lightSlot(i, kHistoryLengthName, &LightMembers::historyLength, ImageRole::Inspection,
                        &LightImages::historyLength);
    *slot++ = lightSlot(i, kLightDirectionName, &LightMembers::lightDirection, ImageRole::Inspection,
                        &LightImages::lightDirection);
    *slot++ = lightSlot(i, kExpectedErrorName, &LightMembers::expectedError, ImageRole::Inspection,
                        &LightImages::expectedError);
  }
  return slots;
}

}  // namespace

const HostStates kInnerStates{
    .inputs = {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE, kInputLayout},
    .outputBefore = {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE, kOutputLayout},
    .outputAfter = {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE, kOutputLayout},
};

fg::Texture ImageSlot::textureOf(const DenoiseGraph& graph) const {
  if (ofLight != nullptr) return light < graph.lights.size() ? graph.lights[light].*ofLight : fg::Texture{};
  if (ofInputs != nullptr) return graph.inputs.*ofInputs;
  return graph.views.empty() ? fg::Texture{} : graph.views.front().texture;
}

const std::array<ImageSlot, kImageCount>& imageSlots() {
  static const std::array<ImageSlot, kImageCount> kSlots = makeSlots();
  return kSlots;
}

std::size_t imageIndex(std::string_view name) {
  std::string known;
  for (std::size_t i = 0; i < kImageCount; ++i) {
    const std::string each = imageSlots().at(i).name();
    if (each == name) return i;
    known.append(known.empty() ? "" : ", ").append(each);
  }
  throw Error(WALR_ERROR_INVALID_ARGUMENT, "there is no image \"" + std::string(name) + "\"; known images: " + known);
}

void markRepeated(FrameImages& images) {
  for (std::size_t i = 0; i < kImageCount; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const WalrImage &first = images[j].image, &second = images[i].image;
      if (!images[i].given || !images[j].given || first.image != second.image) continue;
      // Outputs come after inputs.
      if (isWritten(i)) {
        reject(j, "is also the output '" + imageSlots().at(i).name() + "': use another image for the output");
      }
      if (!sameState(first.acquire, second.acquire) || !sameState(first.release, second.release)) {
        reject(i, "is also the image '" + imageSlots().at(j).name() + "', but in other states: give both the same");
      }
      images[i].repeated = true;
    }
  }
}

FrameImage checkedImage(std::size_t index, const WalrImage* given, const ImageNeeds& needs, std::uint32_t queueFamily) {
  if (!needs.used) return {};
  if (given == nullptr) reject(index, "is null, but the denoiser uses it: see WalrFrame");
  WalrImage image = readStruct(given, "WalrImage");
  if (image.image == VK_NULL_HANDLE) reject(index, "has a null VkImage");
  if (image.format != needs.format) {
    reject(index, "is of format " + formatText(image.format) + ", but the denoiser was made for " +
                      formatText(needs.format) + ": see WalrDenoiserInfo");
  }
  if (needs.offset && (image.width < needs.extent.width + needs.offset->at(0) ||
                       image.height < needs.extent.height + needs.offset->at(1))) {
    reject(index, "is " + sizeText({image.width, image.height}) + " pixels, which does not hold " +
                      sizeText(needs.extent) + " from (" + std::to_string(needs.offset->at(0)) + ", " +
                      std::to_string(needs.offset->at(1)) + ") on: see WalrFrame::offset");
  }
  if (const fg::Extent extent{image.width, image.height}; !needs.offset && extent != needs.extent) {
    reject(index, "is " + sizeText(extent) + " pixels, but the denoiser is for " + sizeText(needs.extent) +
                      ": call walr_resize" + (isLighting(index) ? ", or see WalrConventions::light_group" : ""));
  }
  if ((image.usage & needs.usage) != needs.usage) {
    reject(index, "lacks usage flags " + std::to_string(needs.usage & ~image.usage) +
                      ": create it with those of walr_get_image_requirements");
  }
  if (image.queue_family != VK_QUEUE_FAMILY_IGNORED && image.queue_family != queueFamily) {
    reject(index, "is owned by queue family " + std::to_string(image.queue_family) +
                      ", but commands are recorded for family " + std::to_string(queueFamily) +
                      ": transfer its ownership first");
  }
  if (!isWritten(index) && !isStateLayout(image.acquire.layout)) {
    reject(index, "is acquired in layout " + std::to_string(image.acquire.layout) +
                      ", which has no contents: state in WalrImage::acquire how it was written");
  }
  fillRelease(index, image);
  if (!isStateLayout(image.release.layout)) {
    reject(index, "cannot be released in layout " + std::to_string(image.release.layout));
  }
  return {.given = true, .image = image};
}

void recordAcquire(const fg::vk::DeviceContext& device, VkCommandBuffer commandBuffer, const FrameImages& images) {
  record(device, commandBuffer, images, [](const WalrImage& image, const InnerUse& use) {
    VkImageMemoryBarrier2 barrier = barrierOf(image);
    barrier.srcStageMask = image.acquire.stage;
    barrier.srcAccessMask = image.acquire.access;
    barrier.oldLayout = image.acquire.layout;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.dstAccessMask = use.access;
    barrier.newLayout = use.layout;
    return barrier;
  });
}

void recordRelease(const fg::vk::DeviceContext& device, VkCommandBuffer commandBuffer, const FrameImages& images) {
  record(device, commandBuffer, images, [](const WalrImage& image, const InnerUse& use) {
    VkImageMemoryBarrier2 barrier = barrierOf(image);
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    barrier.srcAccessMask = use.access & VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    barrier.oldLayout = use.layout;
    barrier.dstStageMask = image.release.stage;
    barrier.dstAccessMask = image.release.access;
    barrier.newLayout = image.release.layout;
    return barrier;
  });
}

}  // namespace walr::api
