#include "framegraph/vulkan/resources.h"

#include <algorithm>
#include <array>

#include "framegraph/vulkan/driver_memory_model.h"
#include "framegraph/vulkan/image.h"

namespace fg::vk {

std::uint64_t requiredBytes(const DeviceContext& device, const GraphDesc& graph, const Plan& plan,
                            std::uint32_t slots) {
  std::uint64_t bytes = 0;
  for (const PlannedHeap& heap : plan.heaps) bytes += blockBytes(device, heap.size);
  ArenaLayout persistent(device);
  ArenaLayout uploads(device);
  for (std::size_t i = 0; i < graph.resources.size(); ++i) {
    const PlannedResource& planned = plan.resources[i];
    const Lifetime lifetime = graph.resources[i].lifetime;
    // Both images of a history are counted with its current one.
    if (!planned.used || lifetime == Lifetime::Imported || lifetime == Lifetime::HistoryPrevious) continue;
    const bool upload = lifetime == Lifetime::Upload;
    if (!upload && planned.heap != kNone) continue;
    const std::uint32_t copies = upload ? slots : lifetime == Lifetime::HistoryCurrent ? kParities : 1;
    for (std::uint32_t copy = 0; copy < copies; ++copy) {
      (upload ? uploads : persistent).add({planned.size, planned.alignment, planned.memoryTypeBits});
    }
  }
  return bytes + persistent.bytes() + uploads.bytes();
}

Resources::Resources(const DeviceContext& device, const GraphDesc& graph, const Plan& plan, std::uint32_t slots,
                     bool poison, const Membership& membership)
    : device_(&device),
      graph_(&graph),
      plan_(&plan),
      slots_(slots),
      persistent_(device, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, "histories and exported resources"),
      uploads_(device, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, "upload buffers"),
      images_(graph.resources.size() * kParities),
      buffers_(graph.resources.size() * slots * kParities),
      mapped_(graph.resources.size() * slots) {
  allocateHeaps(membership);
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
  std::fill_n(&images_[std::size_t{resource} * kParities], kParities, image);
}

void Resources::import(std::uint32_t resource, VkBuffer buffer) {
  std::fill_n(&buffers_[std::size_t{resource} * slots_ * kParities], slots_ * kParities, buffer);
}

std::uint64_t Resources::allocatedBytes() const {
  std::uint64_t bytes = persistent_.size() + uploads_.size();
  for (const auto& heap : heaps_) bytes += heap->size();
  return bytes;
}

std::uint64_t Resources::sharedBytes() const {
  std::uint64_t bytes = 0;
  for (const auto& heap : heaps_) bytes += heap.use_count() > 1 ? heap->size() : 0;
  return bytes;
}

void Resources::allocateHeaps(const Membership& membership) {
  std::vector<MemoryRequirements> heaps;
  for (const PlannedHeap& heap : plan_->heaps) heaps.push_back({heap.size, 1, heap.memoryTypeBits});
  for (const PlannedResource& planned : plan_->resources) {
    if (planned.heap == kNone) continue;
    for (std::uint32_t parity = 0; parity < kParities; ++parity) {
      std::uint64_t& alignment = heaps[allocationOf(plan_->heaps, planned.heap, parity)].alignment;
      alignment = std::max(alignment, planned.alignment);
    }
  }
  for (std::size_t i = 0; i < heaps.size(); ++i) {
    const bool onlyTransients = plan_->heaps[i].partner == kNone;
    heaps_.push_back(onlyTransients && membership.objects != nullptr
                         ? membership.objects->transientMemory(heaps[i], membership.member)
                         : std::make_shared<DeviceMemory>(*device_, heaps[i], VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                                          "resources that share memory"));
  }
}

void Resources::makeTexture(std::uint32_t resource, const TextureDesc& desc, bool poison) {
  const ResourceDecl& decl = graph_->resources[resource];
  const PlannedResource& planned = plan_->resources[resource];
  VkImage* const images = &images_[std::size_t{resource} * kParities];
  if (decl.lifetime == Lifetime::HistoryPrevious) return;  // Created with `current`: the two swap images.
  const bool history = decl.lifetime == Lifetime::HistoryCurrent;
  VkImageUsageFlags usage = planned.imageUsage;
  if (history) {
    usage |= plan_->resources[graph_->histories[decl.history].previous].imageUsage | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  } else if (poison) {
    usage |= kPoisonImageUsage;
  }
  const std::uint32_t count = history ? kParities : copies(planned);
  for (std::uint32_t parity = 0; parity < count; ++parity) {
    images[parity] = addImage(resource, desc, usage);
    if (planned.heap == kNone) {
      persistent_.add(images[parity]);
      continue;
    }
    checkPlacement(resource, memoryRequirements(*device_, images[parity]));
    const DeviceMemory& heap = heapOf(planned, parity);
    check(device_->functions.vkBindImageMemory(device_->view.device, images[parity], heap.handle(),
                                               heap.offset() + planned.offset),
          "binding memory of image '" + decl.name + "'");
  }
  std::fill(images + count, images + kParities, images[0]);
  if (!history) return;
  const std::uint32_t previous = graph_->histories[decl.history].previous;
  for (std::uint32_t parity = 0; parity < kParities; ++parity) {
    images_[previous * kParities + (1 - parity)] = images[parity];
  }
}

void Resources::makeBuffer(std::uint32_t resource, const BufferDesc& desc, bool poison) {
  const ResourceDecl& decl = graph_->resources[resource];
  const PlannedResource& planned = plan_->resources[resource];
  VkBuffer* const buffers = &buffers_[std::size_t{resource} * slots_ * kParities];
  if (decl.lifetime == Lifetime::Upload) {
    for (std::uint32_t slot = 0; slot < slots_; ++slot) {
      const VkBuffer buffer = addBuffer(resource, desc, planned.bufferUsage);
      std::fill_n(buffers + std::size_t{slot} * kParities, kParities, buffer);
      uploads_.add(buffer, &mapped_[resource * slots_ + slot]);
    }
    return;
  }
  const VkBufferUsageFlags usage = planned.bufferUsage | (poison ? kPoisonBufferUsage : 0);
  std::array<VkBuffer, kParities> made{};
  for (std::uint32_t parity = 0; parity < copies(planned); ++parity) {
    made[parity] = addBuffer(resource, desc, usage);
    if (planned.heap == kNone) {
      persistent_.add(made[parity]);
      continue;
    }
    checkPlacement(resource, memoryRequirements(*device_, made[parity]));
    const DeviceMemory& heap = heapOf(planned, parity);
    check(device_->functions.vkBindBufferMemory(device_->view.device, made[parity], heap.handle(),
                                                heap.offset() + planned.offset),
          "binding memory of buffer '" + decl.name + "'");
  }
  std::fill(made.begin() + copies(planned), made.end(), made[0]);
  for (std::uint32_t slot = 0; slot < slots_; ++slot) std::ranges::copy(made, buffers + std::size_t{slot} * kParities);
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
  throw Error(
      "'" + graph_->resources[resource].name + "' does not fit where the plan puts it (it needs " +
      std::to_string(requirements.size) + " bytes and has " + std::to_string(planned.size) +
      "): compile the graph with the DriverMemoryModel of this device, with the same poison option as the executor");
}

}  // namespace fg::vk
