#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <walr/walr_passes.h>

#include "framegraph/plan/plan.h"
#include "framegraph/vulkan/descriptor_sets.h"
#include "framegraph/vulkan/inherited_histories.h"
#include "framegraph/vulkan/memory.h"
#include "framegraph/vulkan/pipelines.h"

namespace walr::api {

/// Binds and dispatches the passes of a list one at a time. All resources are the host's, except uploads.
class PassRecording {
 public:
  /// @param cache optional; must outlive the constructor
  PassRecording(const fg::vk::DeviceContext& device, const fg::GraphDesc& graph, const fg::Plan& plan,
                const WalrPassList& list, std::uint32_t slots, VkPipelineCache cache);
  PassRecording(const PassRecording&) = delete;
  PassRecording& operator=(const PassRecording&) = delete;

  /// Take over the ages of histories from other passes.
  void continueFrom(const PassRecording& last, std::span<const fg::vk::InheritedHistory> inherited);
  /// Give the buffer behind a WALR_RESOURCE_LIBRARY.
  void bindLibraryBuffer(std::uint32_t resource, VkBuffer buffer) { libraryBuffers_[resource] = buffer; }
  /// Begin a frame. The GPU must have finished the last frame with the same slot.
  void begin(std::uint64_t frame);
  /// Indices of the upload buffers that passes read and that have new contents in every frame.
  [[nodiscard]] const std::vector<std::uint32_t>& frameUploads() const { return frameUploads_; }
  /// Set an upload buffer's contents for the frame.
  void upload(std::uint32_t resource, std::span<const std::byte> bytes);
  /// Slot (among the frames in flight) of the frame begun last.
  [[nodiscard]] std::uint32_t slot() const { return static_cast<std::uint32_t>(frame_ % slots_); }
  /// @throws Error naming the pass and what is wrong with its resources, or if the frame has the pass already
  void requireRecordable(std::uint32_t pass, std::span<const WalrPassResource> resources) const;
  /// Record a pass that is recordable.
  void record(std::uint32_t pass, VkCommandBuffer commandBuffer, std::span<const WalrPassResource> resources);
  void forget(std::uint64_t identity);

 private:
  /// An image of zeros in place of a history that the host does not have.
  struct Zeros {
    fg::vk::MemoryArena memory;
    fg::vk::Owned<VkImage> image;
    fg::vk::Owned<VkImageView> view;
    std::uint64_t lastFrame = 0;
  };
  struct Upload {
    fg::vk::Owned<VkBuffer> buffer;
    std::byte* mapped = nullptr;
  };
  struct Descriptor {
    VkDescriptorImageInfo image{};
    VkDescriptorBufferInfo buffer{};
  };

  void makeUploads(const WalrPassList& list);
  void makeSets();
  /// @throws Error naming a resource that is missing or in a wrong layout
  void requireResources(const WalrDispatch& pass, std::span<const WalrPassResource> resources) const;
  VkImageView view(std::uint32_t resource, const WalrPassResource& given);
  VkImageView zeros(const WalrDispatch& pass, std::uint32_t resource);
  void clear(VkCommandBuffer commandBuffer, const Zeros& zeros) const;
  void clearZeros(VkCommandBuffer commandBuffer, const WalrDispatch& pass);
  Descriptor describe(const WalrDispatch& pass, const WalrBinding& binding, const WalrPassResource& given);
  void writeSet(VkDescriptorSet set, const WalrDispatch& pass, std::span<const WalrPassResource> resources);
  void noteAge(const WalrBinding& binding, const WalrPassResource& given);

  const fg::vk::DeviceContext* device_;
  const fg::GraphDesc* graph_;
  const WalrPassList* list_;
  std::uint32_t slots_;
  std::uint64_t frame_ = 0;
  std::map<std::uint32_t, VkBuffer> libraryBuffers_;  ///< By resource.
  fg::vk::Pipelines pipelines_;
  std::vector<fg::vk::ComputePipeline> passPipelines_;  ///< By pass.
  fg::vk::Owned<VkSampler> nearest_;
  fg::vk::Owned<VkSampler> linear_;
  std::optional<fg::vk::DescriptorSets> sets_;  ///< One per pass and slot.
  std::vector<std::uint64_t> recordedFrame_;    ///< By pass: number of the last frame that has it, plus 1.
  std::map<std::pair<std::uint64_t, std::uint32_t>, fg::vk::Owned<VkImageView>> views_;  ///< By identity and resource.
  std::map<std::pair<const WalrDispatch*, std::uint32_t>, Zeros> zeros_;                 ///< By pass and resource.
  std::map<std::uint32_t, std::pair<std::uint32_t, std::uint64_t>> ages_;  ///< By resource: age and its frame.
  fg::vk::MemoryArena uploadMemory_;
  std::map<std::uint32_t, std::vector<Upload>> uploads_;  ///< By resource and slot.
  std::vector<std::uint32_t> frameUploads_;
};

}  // namespace walr::api
