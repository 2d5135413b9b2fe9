#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "framegraph/vulkan/resources.h"

namespace fg::vk {

/// Bytes that the host uploads. They are stored here and copied into a frame's own buffer when that frame is recorded.
/// So an upload never overwrites a frame in flight, and a buffer keeps its contents until the next upload.
class Uploads {
 public:
  Uploads(const GraphDesc& graph, const Plan& plan, std::uint32_t slots);

  /// @throws std::invalid_argument if the resource is no upload buffer or has another size
  void set(std::uint32_t resource, std::span<const std::byte> bytes);
  /// Update a frame's buffers.
  void copyTo(const Resources& resources, std::uint32_t slot);

 private:
  struct Entry {
    std::uint32_t resource = kNone;
    std::vector<std::byte> bytes;
    std::vector<bool> stale;  ///< Indexed by slot: true if the copy there is out of date.
  };
  const GraphDesc* graph_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> entryOf_;  ///< Indexed by resource; kNone if it is no upload buffer.
};

}  // namespace fg::vk
