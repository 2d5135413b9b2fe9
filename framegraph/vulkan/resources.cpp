#include "framegraph/vulkan/resources.h"

#include <algorithm>

#include "framegraph/vulkan/driver_memory_model.h"
#include "framegraph/vulkan/image.h"

namespace fg::vk {

Resources::Resources(const DeviceContext& device, const GraphDesc& graph, const Plan& plan, std::uint32_t slots,
                     bool poison)
    : device_(&device),
      graph_(&graph),
      plan_(&plan),
      slots_(slots),
      persistent_(device, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, "histories and exported resources"),
      uploads_(device, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, "upload buffers"),
      images_(graph.resources.size() * kParities),
      buffers_(graph.resources.size() * slots),
      mapped_(graph.resources.size() * slots) {
  allocateHeaps();
  for (std::uint32_t i = 0; i < graph.resources.size(); ++i) {
    const ResourceDecl& decl = graph.resources[i];
    if (!plan.resources[i].used || decl.lifetime == Lifetime::Imported) continue;
    if (const auto* texture = std::get_if<TextureDesc>(&decl.desc)) {
      makeTexture(i, *texture, poison);
    } else {
      makeBuffer(i, std::get<BufferDesc>(decl.desc), poison);
    }
  }
  persistent_.allocate();
  uploads_.allocate();
}

void Resources::import(std::uint32_t resource, VkImage image) {
  std::fill_n(images_.begin() + resource * kParities, kParities, image);
}

void Resources::import(std::uint32_t resource, VkBuffer buffer) {
  std::fill_n(buffers_.begin() + resource * slots_, slots_, buffer);
}

std::uint64_t Resources::allocatedBytes() const {
  std::uint64_t bytes = persistent_.size() + uploads_.size();
  for (const PlannedHeap& heap : plan_->heaps) bytes += heap.size;
  return bytes;
}

void Resources::allocateHeaps() {
  for (const PlannedHeap& heap : plan_->heaps) {
    heaps_.push_back(allocateMemory(*device_, heap.size, heap.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                    "the heap of transient resources"));
  }
}

void Resources::makeTexture(std::uint32_t resource, const TextureDesc& desc, bool poison) {
  const ResourceDecl& decl = graph_->resources[resource];
  const PlannedResource& planned = plan_->resources[resource];
  VkImage* const images = &images_[resource * kParities];
  if (decl.lifetime == Lifetime::HistoryPrevious) return;  // Made with the current one, whose other copy it is.
  if (decl.lifetime == Lifetime::HistoryCurrent) {
    const std::uint32_t previous = graph_->histories[decl.history].previous;
    const VkImageUsageFlags usage =
        planned.imageUsage | plan_->resources[previous].imageUsage | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    for (std::uint32_t parity = 0; parity < kParities; ++parity) {
      images[parity] = addImage(resource, desc, usage);
      images_[previous * kParities + (1 - parity)] = images[parity];
      persistent_.add(images[parity]);
    }
    return;
  }
  std::fill_n(images, kParities, addImage(resource, desc, planned.imageUsage | (poison ? kPoisonImageUsage : 0)));
  if (planned.heap == kNone) return persistent_.add(images[0]);
  checkPlacement(resource, memoryRequirements(*device_, images[0]));
  check(
      device_->functions.vkBindImageMemory(device_->view.device, images[0], heaps_[planned.heap].get(), planned.offset),
      "binding memory of image '" + decl.name + "'");
}

void Resources::makeBuffer(std::uint32_t resource, const BufferDesc& desc, bool poison) {
  const ResourceDecl& decl = graph_->resources[resource];
  const PlannedResource& planned = plan_->resources[resource];
  VkBuffer* const buffers = &buffers_[resource * slots_];
  if (decl.lifetime == Lifetime::Upload) {
    for (std::uint32_t slot = 0; slot < slots_; ++slot) {
      buffers[slot] = addBuffer(resource, desc, planned.bufferUsage);
      uploads_.add(buffers[slot], &mapped_[resource * slots_ + slot]);
    }
    return;
  }
  std::fill_n(buffers, slots_, addBuffer(resource, desc, planned.bufferUsage | (poison ? kPoisonBufferUsage : 0)));
  if (planned.heap == kNone) return persistent_.add(buffers[0]);
  checkPlacement(resource, memoryRequirements(*device_, buffers[0]));
  check(device_->functions.vkBindBufferMemory(device_->view.device, buffers[0], heaps_[planned.heap].get(),
                                              planned.offset),
        "binding memory of buffer '" + decl.name + "'");
}

VkImage Resources::addImage(std::uint32_t resource, const TextureDesc& desc, VkImageUsageFlags usage) {
  return ownedImages_.emplace_back(createImage(*device_, desc, usage, graph_->resources[resource].name)).get();
}

VkBuffer Resources::addBuffer(std::uint32_t resource, const BufferDesc& desc, VkBufferUsageFlags usage) {
  return ownedBuffers_.emplace_back(createBuffer(*device_, desc, usage, graph_->resources[resource].name)).get();
}

void Resources::checkPlacement(std::uint32_t resource, const MemoryRequirements& requirements) const {
  const PlannedResource& planned = plan_->resources[resource];
  const PlannedHeap& heap = plan_->heaps[planned.heap];
  const bool fits = requirements.size <= planned.size && planned.offset % requirements.alignment == 0 &&
                    planned.offset + requirements.size <= heap.size &&
                    (requirements.memoryTypeBits & heap.memoryTypeBits) == heap.memoryTypeBits;
  if (fits) return;
  throw Error("'" + graph_->resources[resource].name + "' does not fit where the plan puts it (needs " +
              std::to_string(requirements.size) + " bytes, has " + std::to_string(planned.size) +
              "): compile the graph with the DriverMemoryModel of this device, made with the executor's poison option");
}

}  // namespace fg::vk
