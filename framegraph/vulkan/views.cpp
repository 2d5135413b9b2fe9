#include "framegraph/vulkan/views.h"

#include <algorithm>
#include <utility>

#include "framegraph/declare/topology.h"
#include "framegraph/vulkan/image.h"

namespace fg::vk {
namespace {

Owned<VkImageView> makeView(const DeviceContext& device, const ResourceDecl& decl, const SubresourceRange& range,
                            VkImage image) {
  // A host's image may have more mip levels and layers than it was declared with.
  return createImageView(device, image, std::get<TextureDesc>(decl.desc), resolved(decl, range), decl.name);
}

}  // namespace

std::uint32_t Views::request(std::uint32_t resource, const SubresourceRange& range) {
  const auto known = std::ranges::find_if(
      requests_, [&](const Request& request) { return request.resource == resource && request.range == range; });
  if (known != requests_.end()) return static_cast<std::uint32_t>(known - requests_.begin());

  Request request{resource, range, {}};
  for (std::uint32_t parity = 0; parity < kParities; ++parity) {
    const VkImage image = resources_->image(resource, {.slot = 0, .parity = parity});
    if (image == VK_NULL_HANDLE) break;  // An import: its views are created when an image is bound.
    const bool sameAsFirst = parity == 1 && image == resources_->image(resource, {.slot = 0, .parity = 0});
    if (!sameAsFirst) owned_.push_back(makeView(*device_, graph_->resources[resource], range, image));
    request.handles[parity] = owned_.back().get();
  }
  requests_.push_back(request);
  return static_cast<std::uint32_t>(requests_.size() - 1);
}

void Views::import(std::uint32_t resource, VkImage image, std::uint64_t identity) {
  // All views are made before any is used, because making one may fail.
  for (std::uint32_t i = 0; i < requests_.size(); ++i) {
    if (requests_[i].resource != resource || imported_.contains({identity, i})) continue;
    auto view = makeView(*device_, graph_->resources[resource], requests_[i].range, image);
    imported_.emplace(std::pair(identity, i), std::move(view));
  }
  for (std::uint32_t i = 0; i < requests_.size(); ++i) {
    if (requests_[i].resource != resource) continue;
    std::ranges::fill(requests_[i].handles, imported_.at({identity, i}).get());
  }
}

void Views::replace(std::uint32_t resource, std::uint32_t parity, VkImage image) {
  for (Request& request : requests_) {
    if (request.resource != resource) continue;
    owned_.push_back(makeView(*device_, graph_->resources[resource], request.range, image));
    request.replaced = std::exchange(request.handles[parity], owned_.back().get());
  }
}

void Views::restore(std::uint32_t resource, std::uint32_t parity) {
  for (Request& request : requests_) {
    if (request.resource == resource) request.handles[parity] = std::exchange(request.replaced, VK_NULL_HANDLE);
  }
}

void Views::forget(std::uint64_t identity) {
  std::erase_if(imported_, [&](const auto& entry) { return entry.first.first == identity; });
}

}  // namespace fg::vk
