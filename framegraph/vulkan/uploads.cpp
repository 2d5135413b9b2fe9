#include "framegraph/vulkan/uploads.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace fg::vk {

Uploads::Uploads(const GraphDesc& graph, const Plan& plan, std::uint32_t slots)
    : graph_(&graph), entryOf_(graph.resources.size(), kNone) {
  for (std::uint32_t i = 0; i < graph.resources.size(); ++i) {
    const ResourceDecl& decl = graph.resources[i];
    if (decl.lifetime != Lifetime::Upload) continue;
    entryOf_[i] = static_cast<std::uint32_t>(entries_.size());
    const std::uint64_t size = std::get<BufferDesc>(decl.desc).size;
    std::vector<std::byte> bytes(decl.contents.begin(), decl.contents.end());
    bytes.resize(size);
    entries_.push_back({i, std::move(bytes), std::vector<bool>(slots, plan.resources[i].used)});
  }
}

void Uploads::set(std::uint32_t resource, std::span<const std::byte> bytes) {
  if (resource >= entryOf_.size() || entryOf_[resource] == kNone) {
    throw std::invalid_argument(
        "upload: the buffer is not declared with Graph::upload; use the handle that it returns");
  }
  Entry& entry = entries_[entryOf_[resource]];
  if (bytes.size() != entry.bytes.size()) {
    throw std::invalid_argument("upload of " + std::to_string(bytes.size()) + " bytes into '" +
                                graph_->resources[resource].name + "', which has " +
                                std::to_string(entry.bytes.size()));
  }
  std::ranges::copy(bytes, entry.bytes.begin());
  std::fill(entry.stale.begin(), entry.stale.end(), true);
}

void Uploads::copyTo(const Resources& resources, std::uint32_t slot) {
  for (Entry& entry : entries_) {
    std::byte* const target = resources.mapped(entry.resource, slot);
    if (!entry.stale[slot] || target == nullptr) continue;
    std::memcpy(target, entry.bytes.data(), entry.bytes.size());
    entry.stale[slot] = false;
  }
}

}  // namespace fg::vk
