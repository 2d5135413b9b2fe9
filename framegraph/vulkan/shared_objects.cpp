#include "framegraph/vulkan/shared_objects.h"

#include <algorithm>

namespace fg::vk {
namespace {

bool fits(const MemoryRequirements& needed, const MemoryRequirements& block) {
  return needed.size <= block.size && block.alignment % needed.alignment == 0 &&
         needed.memoryTypeBits == block.memoryTypeBits;
}

}  // namespace

std::shared_ptr<DeviceMemory> SharedObjects::transientMemory(const MemoryRequirements& requirements,
                                                             std::uint32_t member) {
  std::erase_if(blocks_, [](const Block& block) { return block.memory.expired(); });
  const auto usable = [&](const Block& block) {
    return block.member != member && fits(requirements, block.requirements);
  };
  // The newest: where executors of all members are replaced, older blocks are freed with those that go.
  const auto found = std::find_if(blocks_.rbegin(), blocks_.rend(), usable);
  if (found != blocks_.rend()) return found->memory.lock();
  auto memory = std::make_shared<DeviceMemory>(*device_, requirements, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                               "transient resources");
  blocks_.push_back({memory, requirements, member});
  return memory;
}

}  // namespace fg::vk
