#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "framegraph/vulkan/memory.h"
#include "framegraph/vulkan/pipelines.h"

namespace fg::vk {

/// What executors of one device share, for instance those of several views of a scene: pipelines and their layouts, and
/// the memory of transients. Histories are never shared.
///
/// Frames of all of them are recorded one after the other, and submitted in this order to one queue. Not thread-safe.
class SharedObjects {
 public:
  /// @param device must outlive this and every executor that shares it
  /// @param cache  see ExecutorOptions::pipelineCache
  explicit SharedObjects(const DeviceContext& device, VkPipelineCache cache = VK_NULL_HANDLE)
      : SharedObjects(device, std::make_shared<Pipelines>(device, cache)) {}
  /// @param pipelines  of the device, and shared with executors that share nothing else
  SharedObjects(const DeviceContext& device, std::shared_ptr<Pipelines> pipelines)
      : device_(&device), pipelines_(std::move(pipelines)) {}
  SharedObjects(const SharedObjects&) = delete;
  SharedObjects& operator=(const SharedObjects&) = delete;

  [[nodiscard]] Pipelines& pipelines() { return *pipelines_; }
  /// Number of a further member. Executors of one member replace one another, and none takes memory that another one
  /// allocated, so that this can be freed.
  std::uint32_t addMember() { return members_++; }
  /// Memory for transients: the newest block that another member allocated and that is large enough, or
  /// else a new one.
  /// @throws as DeviceMemory does
  std::shared_ptr<DeviceMemory> transientMemory(const MemoryRequirements& requirements, std::uint32_t member);

 private:
  struct Block {
    std::weak_ptr<DeviceMemory> memory;
    MemoryRequirements requirements;
    std::uint32_t member = 0;  ///< That allocated it.
  };

  const DeviceContext* device_;
  std::shared_ptr<Pipelines> pipelines_;
  std::uint32_t members_ = 0;
  std::vector<Block> blocks_;
};

/// A member of executors that share objects.
struct Membership {
  std::shared_ptr<SharedObjects> objects = nullptr;  ///< Null: nothing is shared.
  std::uint32_t member = 0;                          ///< Of `SharedObjects::addMember`.
};

}  // namespace fg::vk
