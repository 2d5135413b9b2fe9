#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "framegraph/vulkan/resources.h"

namespace fg::vk {

/// Bytes that the host writes: kept here and copied into a frame's own copy when that frame is recorded, so that a
/// frame in flight is never overwritten and a buffer keeps its contents until the next upload.
class Uploads {
 public:
  Uploads(const GraphDesc& graph, const Plan& plan, std::uint32_t slots);

  /// @throws std::invalid_argument naming a resource that takes no upload, or that is of another size
  void set(std::uint32_t resource, std::span<const std::byte> bytes);
  /// Bring a frame's copies up to date.
  void copyTo(const Resources& resources, std::uint32_t slot);

 private:
  struct Entry {
    std::uint32_t resource = kNone;
    std::vector<std::byte> bytes;
    std::vector<bool> stale;  ///< By slot.
  };
  const GraphDesc* graph_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> entryOf_;  ///< By resource; kNone for what takes no upload.
};

}  // namespace fg::vk
