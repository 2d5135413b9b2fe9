#include "tiny_host.h"

#include <stdexcept>

namespace tiny_host {
namespace {

bool writes(VkAccessFlags2 access) {
  return (access & (VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT)) != 0;
}

bool isHistory(const WalrResource& resource) {
  return resource.kind == WALR_RESOURCE_HISTORY_CURRENT || resource.kind == WALR_RESOURCE_HISTORY_PREVIOUS;
}

}  // namespace

Graph::Graph(Host& host, const WalrApi& api, WalrPasses passes) : host_(&host), api_(&api), passes_(passes) {
  if (api.get_pass_list(passes, &list_) != WALR_SUCCESS) throw std::runtime_error(api.last_error());
  for (std::uint32_t i = 0; i < list_->resource_count; ++i) {
    const WalrResource& resource = *list_->resources[i];
    if (resource.used == VK_TRUE || resource.kind == WALR_RESOURCE_HOST) makeResource(resource);
  }
}

Graph::~Graph() {
  for (auto& [name, named] : images_) {
    for (HostImage& image : named.slots) {
      api_->forget_pass_image(passes_, image.image, 0);
      host_destroy_image(host_, &image);
    }
  }
  for (auto& [name, named] : buffers_) host_destroy_buffer(host_, &named.own);
}

void Graph::makeResource(const WalrResource& resource) {
  const bool ours = resource.kind != WALR_RESOURCE_UPLOAD && resource.kind != WALR_RESOURCE_LIBRARY;
  if (!ours || resource.kind == WALR_RESOURCE_HISTORY_PREVIOUS) return;
  if (resource.buffer == VK_TRUE) {
    HostBuffer& buffer = buffers_[resource.name].own;
    buffer = host_make_buffer(host_, resource.buffer_size, resource.buffer_usage, 0);
    bytes_ += buffer.bytes;
    listedBytes_ += resource.memory_size;
    return;
  }
  Named& named = images_[resource.name];
  for (int slot = 0; slot < (isHistory(resource) ? 2 : 1); ++slot) {
    HostImage image = host_make_image(host_, resource.format, resource.width, resource.height, resource.image_usage);
    if (resource.kind != WALR_RESOURCE_HOST) {
      bytes_ += host_image_bytes(host_, &image);
      listedBytes_ += resource.memory_size;
    }
    named.slots.push_back(image);
  }
}

HostImage* Graph::lastOf(const std::string& history) {
  if (hasHistory_) return &images_.at(history).slots[1 - parity_];
  return before_ != nullptr ? before_->lastOf(history) : nullptr;
}

HostImage* Graph::behind(std::uint32_t index) {
  const WalrResource& resource = *list_->resources[index];
  if (resource.kind == WALR_RESOURCE_HISTORY_PREVIOUS) {
    return lastOf(list_->resources[resource.partner]->name);
  }
  Named& named = images_.at(resource.name);
  return &named.slots[named.slots.size() == 2 ? parity_ : 0];
}

void Graph::transition(VkCommandBuffer commands, const WalrBinding& binding) {
  const WalrResource& resource = *list_->resources[binding.resource];
  if (resource.kind == WALR_RESOURCE_UPLOAD || resource.kind == WALR_RESOURCE_LIBRARY) return;
  if (resource.buffer == VK_TRUE) {
    NamedBuffer& buffer = buffers_.at(resource.name);
    VkBufferMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2;
    barrier.srcStageMask = buffer.stage;
    barrier.srcAccessMask = buffer.access;
    barrier.dstStageMask = binding.stage;
    barrier.dstAccessMask = binding.access;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.buffer = buffer.own.buffer;
    barrier.size = VK_WHOLE_SIZE;
    VkDependencyInfo dependency{};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.bufferMemoryBarrierCount = 1;
    dependency.pBufferMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &dependency);
    buffer.stage = binding.stage;
    buffer.access = binding.access;
    return;
  }
  HostImage* image = behind(binding.resource);
  if (image == nullptr) return;
  const bool readAgain = image->layout == VK_IMAGE_LAYOUT_GENERAL && image->stage == binding.stage &&
                         !writes(image->access) && !writes(binding.access);
  const bool leftOut = !readBarriers_ && image->layout == VK_IMAGE_LAYOUT_GENERAL && !writes(binding.access);
  if (readAgain || leftOut) return;
  if (!writes(binding.access)) {
    host_transition(commands, image, binding.stage, binding.access, VK_IMAGE_LAYOUT_GENERAL);
    return;
  }
  // It is overwritten, so earlier contents may be discarded.
  if (binding.access == VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT) image->layout = VK_IMAGE_LAYOUT_UNDEFINED;
  host_transition(commands, image, binding.stage, binding.access, VK_IMAGE_LAYOUT_GENERAL);
}

std::vector<VkCommandBuffer> Graph::beginPasses() {
  std::vector<VkCommandBuffer> buffers(list_->pass_count);
  VkCommandBufferAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  info.commandPool = host_->command_pool;
  info.level = VK_COMMAND_BUFFER_LEVEL_SECONDARY;
  info.commandBufferCount = list_->pass_count;
  if (vkAllocateCommandBuffers(host_->device, &info, buffers.data()) != VK_SUCCESS) {
    throw std::runtime_error("allocating the passes' command buffers");
  }
  VkCommandBufferInheritanceInfo inheritance{};
  inheritance.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_INHERITANCE_INFO;
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  begin.pInheritanceInfo = &inheritance;
  for (const VkCommandBuffer buffer : buffers) {
    if (vkBeginCommandBuffer(buffer, &begin) != VK_SUCCESS) throw std::runtime_error("beginning a pass");
  }
  return buffers;
}

void Graph::recordPass(std::uint32_t index, VkCommandBuffer commands) {
  const WalrDispatch& pass = *list_->passes[index];
  std::vector<WalrPassResource> resources(pass.binding_count);
  for (std::uint32_t b = 0; b < pass.binding_count; ++b) {
    const WalrBinding& binding = *pass.bindings[b];
    const WalrResource& resource = *list_->resources[binding.resource];
    if (resource.kind == WALR_RESOURCE_UPLOAD || resource.kind == WALR_RESOURCE_LIBRARY) continue;
    if (resource.buffer == VK_TRUE) {
      resources[b].buffer = buffers_.at(resource.name).own.buffer;
      continue;
    }
    const HostImage* image = behind(binding.resource);
    resources[b].image = image == nullptr ? VK_NULL_HANDLE : image->image;
    resources[b].layout = VK_IMAGE_LAYOUT_GENERAL;
  }
  if (api_->record_pass(passes_, index, commands, resources.data(), pass.binding_count) != WALR_SUCCESS) {
    throw std::runtime_error(api_->last_error());
  }
  if (vkEndCommandBuffer(commands) != VK_SUCCESS) throw std::runtime_error("ending a pass");
}

void Graph::frame(const WalrPassFrame& frame) {
  if (api_->begin_frame(passes_, &frame) != WALR_SUCCESS) throw std::runtime_error(api_->last_error());
  const VkCommandBuffer commands = host_begin(host_);
  std::vector<VkCommandBuffer> passes = beginPasses();
  for (std::uint32_t i = list_->pass_count; i-- > 0;) recordPass(i, passes[i]);
  for (std::uint32_t i = 0; i < list_->pass_count; ++i) {
    const WalrDispatch& pass = *list_->passes[i];
    for (std::uint32_t b = 0; b < pass.binding_count; ++b) transition(commands, *pass.bindings[b]);
    vkCmdExecuteCommands(commands, 1, &passes[i]);
  }
  host_submit_and_wait(host_, commands);
  vkFreeCommandBuffers(host_->device, host_->command_pool, list_->pass_count, passes.data());
  parity_ = 1 - parity_;
  hasHistory_ = true;
  before_ = nullptr;
}

}  // namespace tiny_host
