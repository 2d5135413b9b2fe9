#include "integration/c_api/pass_recording.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

#include "framegraph/vulkan/dispatch.h"
#include "framegraph/vulkan/image.h"
#include "framegraph/vulkan/label.h"
#include "integration/c_api/error.h"

namespace walr::api {
namespace {

bool isPrevious(const WalrResource& resource) {
  return resource.kind == WALR_RESOURCE_HISTORY_PREVIOUS;
}

/// Whether a binding's image may be in a layout.
bool allows(const WalrBinding& binding, VkImageLayout layout) {
  if (layout == VK_IMAGE_LAYOUT_GENERAL || layout == binding.layout) return true;
  return layout == VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL && binding.layout == VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
}

/// The buffer with the group counts of an indirect dispatch, which is also one of its bindings.
VkBuffer groupCounts(const WalrDispatch& pass, std::span<const WalrPassResource> resources) {
  for (std::uint32_t i = 0; i < pass.binding_count; ++i) {
    if (pass.bindings[i]->resource == pass.indirect) return resources[i].buffer;
  }
  throw Error(WALR_ERROR_INTERNAL, "pass '" + std::string(pass.name) + "' does not bind its group counts");
}

[[noreturn]] void reject(const WalrDispatch& pass, const WalrResource& resource, const std::string& what) {
  throw Error(WALR_ERROR_INVALID_ARGUMENT,
              "pass '" + std::string(pass.name) + "': resource '" + resource.name + "' " + what);
}

}  // namespace

PassRecording::PassRecording(const fg::vk::DeviceContext& device, const fg::GraphDesc& graph, const fg::Plan& plan,
                             const WalrPassList& list, std::uint32_t slots, VkPipelineCache cache)
    : device_(&device),
      graph_(&graph),
      list_(&list),
      slots_(slots),
      pipelines_(device, cache),
      nearest_(fg::vk::makeSampler(device, VK_FILTER_NEAREST)),
      linear_(fg::vk::makeSampler(device, VK_FILTER_LINEAR)),
      recordedFrame_(list.pass_count),
      uploadMemory_(device, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                    "frame constants") {
  for (const fg::PlannedPass& planned : plan.passes) {
    const fg::PassDecl& pass = graph.passes[planned.pass];
    const auto& work = std::get<fg::ComputeDispatch>(pass.work);
    passPipelines_.push_back(pipelines_.get(*work.shader, work.specialization));
  }
  makeUploads(list);
  makeSets();
}

void PassRecording::makeUploads(const WalrPassList& list) {
  for (std::uint32_t i = 0; i < list.resource_count; ++i) {
    const WalrResource& resource = *list.resources[i];
    if (resource.kind != WALR_RESOURCE_UPLOAD || resource.used == VK_FALSE) continue;
    std::vector<Upload>& copies = uploads_[i];
    if (graph_->resources[i].contents.empty()) frameUploads_.push_back(i);
    copies.resize(slots_);
    for (Upload& copy : copies) {
      copy.buffer = fg::vk::createBuffer(*device_, {resource.buffer_size}, resource.buffer_usage, resource.name);
      uploadMemory_.add(copy.buffer.get(), &copy.mapped);
    }
  }
  uploadMemory_.allocate();
  for (const auto& [resource, copies] : uploads_) {
    for (const Upload& copy : copies) std::ranges::copy(graph_->resources[resource].contents, copy.mapped);
  }
}

void PassRecording::makeSets() {
  std::vector<VkDescriptorSetLayout> layouts;
  std::vector<VkDescriptorType> types;
  for (std::uint32_t i = 0; i < list_->pass_count; ++i) {
    const WalrDispatch& pass = *list_->passes[i];
    layouts.push_back(passPipelines_[i].setLayout);
    for (std::uint32_t b = 0; b < pass.binding_count; ++b) types.push_back(pass.bindings[b]->type);
  }
  sets_.emplace(*device_, layouts, types, slots_);
}

void PassRecording::continueFrom(const PassRecording& last, std::span<const fg::vk::InheritedHistory> inherited) {
  ages_.clear();
  for (const auto& [history, before] : inherited) {
    const auto known = last.ages_.find(last.graph_->histories[before].previous);
    if (known != last.ages_.end()) ages_[graph_->histories[history].previous] = known->second;
  }
}

void PassRecording::begin(std::uint64_t frame) {
  frame_ = frame;
  std::erase_if(zeros_, [&](const auto& entry) { return entry.second.lastFrame + slots_ <= frame_; });
}

void PassRecording::upload(std::uint32_t resource, std::span<const std::byte> bytes) {
  std::ranges::copy(bytes, uploads_.at(resource)[slot()].mapped);
}

void PassRecording::requireResources(const WalrDispatch& pass, std::span<const WalrPassResource> resources) const {
  if (resources.size() != pass.binding_count) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT, "pass '" + std::string(pass.name) + "' has " +
                                                 std::to_string(pass.binding_count) + " bindings, but " +
                                                 std::to_string(resources.size()) + " resources are given");
  }
  for (std::size_t i = 0; i < resources.size(); ++i) {
    const WalrResource& resource = *list_->resources[pass.bindings[i]->resource];
    const WalrPassResource& given = resources[i];
    if (resource.kind == WALR_RESOURCE_UPLOAD || resource.kind == WALR_RESOURCE_LIBRARY) continue;
    if (resource.buffer == VK_TRUE) {
      if (given.buffer == VK_NULL_HANDLE) reject(pass, resource, "is a buffer, and the VkBuffer is null");
      continue;
    }
    if (given.image == VK_NULL_HANDLE) {
      if (!isPrevious(resource)) reject(pass, resource, "has a null VkImage: only a previous history may");
      continue;
    }
    const WalrBinding& binding = *pass.bindings[i];
    if (!allows(binding, given.layout)) {
      reject(pass, resource,
             "is bound in layout " + std::to_string(given.layout) + ": it must be GENERAL or " +
                 std::to_string(binding.layout));
    }
  }
}

VkImageView PassRecording::view(std::uint32_t resource, const WalrPassResource& given) {
  const std::uint64_t identity = given.identity != 0 ? given.identity : reinterpret_cast<std::uint64_t>(given.image);
  auto& known = views_[{identity, resource}];
  if (known.get() == VK_NULL_HANDLE) {
    const fg::ResourceDecl& decl = graph_->resources[resource];
    known = fg::vk::createImageView(*device_, given.image, std::get<fg::TextureDesc>(decl.desc),
                                    {.baseMip = 0, .mipCount = 1, .baseLayer = 0, .layerCount = 1}, decl.name);
  }
  return known.get();
}

void PassRecording::forget(std::uint64_t identity) {
  std::erase_if(views_, [&](const auto& entry) { return entry.first.first == identity; });
}

void PassRecording::clear(VkCommandBuffer commandBuffer, const Zeros& zeros) const {
  VkImageMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  // After the clear and the reads of the frame before.
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  barrier.dstStageMask = VK_PIPELINE_STAGE_2_CLEAR_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = zeros.image.get();
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.imageMemoryBarrierCount = 1;
  dependency.pImageMemoryBarriers = &barrier;
  device_->functions.vkCmdPipelineBarrier2(commandBuffer, &dependency);
  const VkClearColorValue zero{};
  device_->functions.vkCmdClearColorImage(commandBuffer, barrier.image, VK_IMAGE_LAYOUT_GENERAL, &zero, 1,
                                          &barrier.subresourceRange);
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_CLEAR_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  barrier.dstStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
  barrier.oldLayout = VK_IMAGE_LAYOUT_GENERAL;
  device_->functions.vkCmdPipelineBarrier2(commandBuffer, &dependency);
}

/// Created on demand and destroyed when no frame in flight reads it, because histories are rarely null. Every pass has
/// its own zeros: hosts record passes in any order, and the pass that clears must run first on the queue.
VkImageView PassRecording::zeros(const WalrDispatch& pass, std::uint32_t resource) {
  auto known = zeros_.find({&pass, resource});
  if (known == zeros_.end()) {
    const fg::ResourceDecl& decl = graph_->resources[resource];
    const auto& desc = std::get<fg::TextureDesc>(decl.desc);
    const VkImageUsageFlags usage = list_->resources[resource]->image_usage | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    Zeros made{.memory = {*device_, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, "zeros for a history"},
               .image = fg::vk::createImage(*device_, desc, usage, decl.name + " (none)"),
               .view = {}};
    made.memory.add(made.image.get());
    made.memory.allocate();
    made.view = fg::vk::createImageView(*device_, made.image.get(), desc, {}, decl.name + " (none)");
    known = zeros_.emplace(std::pair(&pass, resource), std::move(made)).first;
  }
  known->second.lastFrame = frame_;
  return known->second.view.get();
}

/// Clear what a pass reads in this frame, also if it was cleared before: the host may have thrown those commands away.
void PassRecording::clearZeros(VkCommandBuffer commandBuffer, const WalrDispatch& pass) {
  for (auto& [key, zeros] : zeros_) {
    if (key.first == &pass && zeros.lastFrame == frame_) clear(commandBuffer, zeros);
  }
}

PassRecording::Descriptor PassRecording::describe(const WalrDispatch& pass, const WalrBinding& binding,
                                                  const WalrPassResource& given) {
  Descriptor descriptor;
  const WalrResource& resource = *list_->resources[binding.resource];
  if (resource.buffer == VK_TRUE) {
    VkBuffer buffer = given.buffer;
    if (resource.kind == WALR_RESOURCE_UPLOAD) buffer = uploads_.at(binding.resource)[slot()].buffer.get();
    if (resource.kind == WALR_RESOURCE_LIBRARY) buffer = libraryBuffers_.at(binding.resource);
    descriptor.buffer = {buffer, 0, resource.buffer_size};
    return descriptor;
  }
  const bool none = given.image == VK_NULL_HANDLE;
  descriptor.image = {(binding.filter == VK_FILTER_LINEAR ? linear_ : nearest_).get(),
                      none ? zeros(pass, binding.resource) : view(binding.resource, given),
                      none ? VK_IMAGE_LAYOUT_GENERAL : given.layout};
  return descriptor;
}

void PassRecording::writeSet(VkDescriptorSet set, const WalrDispatch& pass,
                             std::span<const WalrPassResource> resources) {
  std::vector<Descriptor> descriptors(resources.size());
  std::vector<VkWriteDescriptorSet> writes(resources.size());
  for (std::size_t i = 0; i < resources.size(); ++i) {
    const WalrBinding& binding = *pass.bindings[i];
    descriptors[i] = describe(pass, binding, resources[i]);
    noteAge(binding, resources[i]);
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstSet = set;
    writes[i].dstBinding = binding.binding;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = binding.type;
    writes[i].pImageInfo = &descriptors[i].image;
    writes[i].pBufferInfo = &descriptors[i].buffer;
  }
  device_->functions.vkUpdateDescriptorSets(device_->view.device, static_cast<std::uint32_t>(writes.size()),
                                            writes.data(), 0, nullptr);
}

/// The age of a history grows by one in every frame that binds it, and restarts at 0 when the host binds null.
void PassRecording::noteAge(const WalrBinding& binding, const WalrPassResource& given) {
  if (!isPrevious(*list_->resources[binding.resource])) return;
  auto& [age, frame] = ages_[binding.resource];
  if (given.image == VK_NULL_HANDLE) {
    age = 0;
  } else if (frame != frame_) {
    ++age;
  }
  frame = frame_;
}

void PassRecording::requireRecordable(std::uint32_t index, std::span<const WalrPassResource> resources) const {
  const WalrDispatch& pass = *list_->passes[index];
  requireResources(pass, resources);
  if (recordedFrame_[index] == frame_ + 1) {
    throw Error(WALR_ERROR_WRONG_ORDER,
                "pass '" + std::string(pass.name) + "' is recorded twice in a frame: call walr_begin_frame between");
  }
}

void PassRecording::record(std::uint32_t index, VkCommandBuffer commandBuffer,
                           std::span<const WalrPassResource> resources) {
  const WalrDispatch& pass = *list_->passes[index];
  const fg::vk::Label label(*device_, commandBuffer, pass.name);
  const VkDescriptorSet set = sets_->get(index, slot());
  writeSet(set, pass, resources);
  std::vector<std::byte> constants(pass.push_constant_size);
  if (!constants.empty()) std::memcpy(constants.data(), pass.push_constants, constants.size());
  for (std::uint32_t i = 0; i < pass.history_age_count; ++i) {
    const std::uint32_t age = ages_[pass.history_ages[i].resource].first;
    std::memcpy(constants.data() + pass.history_ages[i].offset, &age, sizeof(age));
  }
  const VkBuffer indirect = pass.indirect == WALR_NONE ? VK_NULL_HANDLE : groupCounts(pass, resources);
  clearZeros(commandBuffer, pass);
  fg::vk::recordDispatch(*device_, commandBuffer, passPipelines_[index], set,
                         {constants, std::to_array(pass.group_count), indirect, pass.indirect_offset});
  recordedFrame_[index] = frame_ + 1;
}

}  // namespace walr::api
