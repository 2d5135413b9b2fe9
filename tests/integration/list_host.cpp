#include "list_host.h"

#include <cstring>
#include <stdexcept>

namespace list_host {
namespace {

void check(VkResult result) {
  if (result != VK_SUCCESS) throw std::runtime_error("VkResult " + std::to_string(result));
}

/// Bring an image into a state. Nothing is needed if the image is in it already, and the state only reads.
void transition(VkCommandBuffer commands, HostImage& image, const WalrImageState& to) {
  constexpr VkAccessFlags2 kReads = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
  const bool same = image.stage == to.stage && image.access == to.access && image.layout == to.layout;
  if (same && (to.access & ~kReads) == 0) return;
  host_transition(commands, &image, to.stage, to.access, to.layout);
}

void clear(VkCommandBuffer commands, HostImage& image) {
  host_transition(commands, &image, VK_PIPELINE_STAGE_2_CLEAR_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                  VK_IMAGE_LAYOUT_GENERAL);
  const VkClearColorValue zero{};
  const VkImageSubresourceRange range{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  vkCmdClearColorImage(commands, image.image, VK_IMAGE_LAYOUT_GENERAL, &zero, 1, &range);
}

}  // namespace

Player::Player(Host& host, const WalrApi& api, WalrPasses passes) : host_(&host), api_(&api), passes_(passes) {
  if (api.get_pass_list(passes, &list_) != WALR_SUCCESS) throw std::runtime_error(api.last_error());
  VkSamplerCreateInfo sampler{};
  sampler.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  sampler.addressModeU = sampler.addressModeV = sampler.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  check(vkCreateSampler(host.device, &sampler, nullptr, &sampler_));
  makeHeaps();
  behind_.resize(list_->resource_count);
  for (std::uint32_t i = 0; i < list_->resource_count; ++i) resources_.push_back(*list_->resources[i]);
  for (std::uint32_t i = 0; i < list_->resource_count; ++i) makeResource(i);
  std::vector<VkDescriptorPoolSize> sizes;
  for (std::uint32_t i = 0; i < list_->pass_count; ++i) {
    for (std::uint32_t b = 0; b < list_->passes[i]->binding_count; ++b) {
      sizes.push_back({list_->passes[i]->bindings[b]->type, 2});
    }
  }
  VkDescriptorPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool.maxSets = 2 * list_->pass_count;
  pool.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
  pool.pPoolSizes = sizes.data();
  check(vkCreateDescriptorPool(host.device, &pool, nullptr, &pool_));
  pipelines_.resize(list_->pass_count);
  for (std::uint32_t i = 0; i < list_->pass_count; ++i) makePass(i);
}

Player::~Player() {
  const VkDevice device = host_->device;
  for (const Pass& pass : pipelines_) {
    vkDestroyPipeline(device, pass.pipeline, nullptr);
    vkDestroyPipelineLayout(device, pass.layout, nullptr);
    vkDestroyDescriptorSetLayout(device, pass.setLayout, nullptr);
  }
  vkDestroyDescriptorPool(device, pool_, nullptr);
  vkDestroySampler(device, sampler_, nullptr);
  for (const VkImageView view : views_) vkDestroyImageView(device, view, nullptr);
  for (const HostImage& image : images_) vkDestroyImage(device, image.image, nullptr);
  for (const VkBuffer buffer : buffers_) vkDestroyBuffer(device, buffer, nullptr);
  for (const VkDeviceMemory memory : memory_) vkFreeMemory(device, memory, nullptr);
  for (auto& [name, image] : hostImages_) host_destroy_image(host_, &image);
}

VkDeviceMemory Player::allocate(VkDeviceSize size, std::uint32_t typeBits, VkMemoryPropertyFlags properties) {
  memory_.push_back(host_allocate(host_, {size, 1, typeBits}, properties));
  return memory_.back();
}

void Player::makeHeaps() {
  for (std::uint32_t i = 0; i < list_->heap_count; ++i) {
    heaps_.push_back(allocate(list_->heaps[i].size, list_->heaps[i].memory_type_bits, 0));
  }
}

HostImage* Player::makeImage(const WalrResource& resource) {
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = resource.format;
  info.extent = {resource.width, resource.height, 1};
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = resource.image_usage;
  VkImage image = VK_NULL_HANDLE;
  check(vkCreateImage(host_->device, &info, nullptr, &image));
  HostImage& made = images_.emplace_back();
  made.image = image;
  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(host_->device, image, &needs);
  if (needs.size != resource.memory_size) throw std::runtime_error("the list has another size");
  const bool shared = resource.heap != WALR_NONE;
  check(vkBindImageMemory(host_->device, image,
                          shared ? heaps_.at(resource.heap) : allocate(needs.size, needs.memoryTypeBits, 0),
                          shared ? resource.heap_offset : 0));
  return &made;
}

VkImageView Player::makeView(VkImage image, VkFormat format) {
  VkImageViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  info.image = image;
  info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  info.format = format;
  info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  VkImageView view = VK_NULL_HANDLE;
  check(vkCreateImageView(host_->device, &info, nullptr, &view));
  views_.push_back(view);
  return view;
}

VkBuffer Player::makeBuffer(const WalrResource& resource, void** mapped) {
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = resource.buffer_size;
  info.usage = resource.buffer_usage;
  VkBuffer buffer = VK_NULL_HANDLE;
  check(vkCreateBuffer(host_->device, &info, nullptr, &buffer));
  buffers_.push_back(buffer);
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(host_->device, buffer, &needs);
  if (resource.heap != WALR_NONE) {
    check(vkBindBufferMemory(host_->device, buffer, heaps_.at(resource.heap), resource.heap_offset));
    return buffer;
  }
  const bool upload = resource.kind == WALR_RESOURCE_UPLOAD;
  const VkDeviceMemory memory = allocate(
      needs.size, needs.memoryTypeBits,
      upload ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT : VkMemoryPropertyFlags{0});
  check(vkBindBufferMemory(host_->device, buffer, memory, 0));
  if (upload) check(vkMapMemory(host_->device, memory, 0, VK_WHOLE_SIZE, 0, mapped));
  return buffer;
}

void Player::makeResource(std::uint32_t index) {
  const WalrResource& resource = resources_[index];
  Behind& behind = behind_[index];
  if (resource.kind == WALR_RESOURCE_HOST) {
    HostImage& image = hostImages_[resource.name];
    image = host_make_image(host_, resource.format, resource.width, resource.height, resource.image_usage);
    behind.images[0] = behind.images[1] = &image;
    // An unused image has no usage flag that allows a view.
    if (resource.used == VK_TRUE) behind.views[0] = behind.views[1] = makeView(image.image, resource.format);
    return;
  }
  if (resource.used == VK_FALSE || resource.kind == WALR_RESOURCE_HISTORY_PREVIOUS) return;
  for (int parity = 0; parity < 2; ++parity) {
    const bool two = resource.kind == WALR_RESOURCE_HISTORY_CURRENT || resource.kind == WALR_RESOURCE_UPLOAD;
    if (parity == 1 && !two) {
      behind.images[1] = behind.images[0];
      behind.views[1] = behind.views[0];
      behind.buffers[1] = behind.buffers[0];
    } else if (resource.buffer == VK_TRUE) {
      behind.buffers[parity] = makeBuffer(resource, &behind.mapped[parity]);
    } else {
      behind.images[parity] = makeImage(resource);
      behind.views[parity] = makeView(behind.images[parity]->image, resource.format);
    }
  }
  if (resource.partner == WALR_NONE) return;
  for (int parity = 0; parity < 2; ++parity) {
    behind_[resource.partner].images[parity] = behind.images[1 - parity];
    behind_[resource.partner].views[parity] = behind.views[1 - parity];
  }
}

HostImage* Player::behind(std::uint32_t index) {
  const Behind& behind = behind_[index];
  return behind.inherited != nullptr ? behind.inherited : behind.images[parity_];
}

void Player::falsify(WalrResourceKind kind, WalrImageState WalrResource::*border, void (*change)(WalrImageState&)) {
  for (WalrResource& resource : resources_) {
    if (resource.kind == kind && resource.used == VK_TRUE) change(resource.*border);
  }
}

void Player::resetHistory() {
  for (Behind& behind : behind_) {
    behind.age = 0;
    behind.inherited = nullptr;
  }
}

void Player::goOnFrom(Player& last) {
  resetHistory();
  for (std::size_t i = 0; i < resources_.size(); ++i) {
    if (resources_[i].kind != WALR_RESOURCE_HISTORY_PREVIOUS) continue;
    for (std::uint32_t l = 0; l < last.resources_.size(); ++l) {
      const WalrResource& before = last.resources_[l];
      const bool same = before.kind == resources_[i].kind && before.format == resources_[i].format &&
                        std::strcmp(before.name, resources_[i].name) == 0;
      if (!same || last.behind_[l].age == 0) continue;
      behind_[i].inherited = last.behind(l);
      behind_[i].age = last.behind_[l].age;
    }
  }
}

/// Bring the images into the states in which the list expects them. Transients and current histories need nothing:
/// their contents are discarded.
void Player::enter(VkCommandBuffer commands) {
  for (std::uint32_t i = 0; i < resources_.size(); ++i) {
    const WalrResource& resource = resources_[i];
    const bool previous = resource.kind == WALR_RESOURCE_HISTORY_PREVIOUS;
    if (resource.used == VK_FALSE || (resource.kind != WALR_RESOURCE_HOST && !previous)) continue;
    HostImage& image = *behind(i);
    if (previous && behind_[i].age == 0) clear(commands, image);
    transition(commands, image, resource.entry);
  }
}

/// Note the states in which the list leaves the images, and swap the histories.
void Player::leave() {
  for (std::uint32_t i = 0; i < resources_.size(); ++i) {
    const WalrResource& resource = resources_[i];
    if (resource.used == VK_FALSE) continue;
    if (resource.kind == WALR_RESOURCE_HOST || resource.kind == WALR_RESOURCE_HISTORY_CURRENT) {
      HostImage& image = *behind(i);
      image.stage = resource.exit.stage;
      image.access = resource.exit.access;
      image.layout = resource.exit.layout;
    }
  }
  for (Behind& behind : behind_) {
    ++behind.age;
    behind.inherited = nullptr;
  }
  parity_ = 1 - parity_;
}

void Player::makePass(std::uint32_t index) {
  const WalrDispatch& dispatch = *list_->passes[index];
  Pass& pass = pipelines_[index];
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (std::uint32_t b = 0; b < dispatch.binding_count; ++b) {
    bindings.push_back(
        {dispatch.bindings[b]->binding, dispatch.bindings[b]->type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
  }
  VkDescriptorSetLayoutCreateInfo setInfo{};
  setInfo.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  setInfo.bindingCount = dispatch.binding_count;
  setInfo.pBindings = bindings.data();
  check(vkCreateDescriptorSetLayout(host_->device, &setInfo, nullptr, &pass.setLayout));
  const VkPushConstantRange constants{VK_SHADER_STAGE_COMPUTE_BIT, 0, dispatch.push_constant_size};
  VkPipelineLayoutCreateInfo layoutInfo{};
  layoutInfo.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  layoutInfo.setLayoutCount = 1;
  layoutInfo.pSetLayouts = &pass.setLayout;
  layoutInfo.pushConstantRangeCount = dispatch.push_constant_size > 0 ? 1 : 0;
  layoutInfo.pPushConstantRanges = &constants;
  check(vkCreatePipelineLayout(host_->device, &layoutInfo, nullptr, &pass.layout));

  VkShaderModuleCreateInfo moduleInfo{};
  moduleInfo.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  moduleInfo.codeSize = dispatch.spirv_size;
  moduleInfo.pCode = dispatch.spirv;
  VkShaderModule module = VK_NULL_HANDLE;
  check(vkCreateShaderModule(host_->device, &moduleInfo, nullptr, &module));
  std::vector<VkSpecializationMapEntry> entries;
  std::vector<std::uint32_t> values;
  for (std::uint32_t i = 0; i < dispatch.specialization_count; ++i) {
    entries.push_back({dispatch.specializations[i].constant_id, i * 4, 4});
    values.push_back(dispatch.specializations[i].value);
  }
  const VkSpecializationInfo specialization{dispatch.specialization_count, entries.data(), values.size() * 4,
                                            values.data()};
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  info.layout = pass.layout;
  check(vkCreateComputePipelines(host_->device, VK_NULL_HANDLE, 1, &info, nullptr, &pass.pipeline));
  vkDestroyShaderModule(host_->device, module, nullptr);

  for (VkDescriptorSet& set : pass.sets) {
    VkDescriptorSetAllocateInfo setInfos{};
    setInfos.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    setInfos.descriptorPool = pool_;
    setInfos.descriptorSetCount = 1;
    setInfos.pSetLayouts = &pass.setLayout;
    check(vkAllocateDescriptorSets(host_->device, &setInfos, &set));
  }
}

void Player::writeSets(std::uint32_t index) {
  const WalrDispatch& dispatch = *list_->passes[index];
  const VkDescriptorSet set = pipelines_[index].sets[parity_];
  for (std::uint32_t b = 0; b < dispatch.binding_count; ++b) {
    const WalrBinding& binding = *dispatch.bindings[b];
    const Behind& behind = behind_[binding.resource];
    VkImageView view = behind.views[parity_];
    if (behind.inherited != nullptr) view = makeView(behind.inherited->image, resources_[binding.resource].format);
    const VkDescriptorImageInfo image{sampler_, view, binding.layout};
    const VkDescriptorBufferInfo buffer{behind.buffers[parity_], 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set;
    write.dstBinding = binding.binding;
    write.descriptorCount = 1;
    write.descriptorType = binding.type;
    write.pImageInfo = &image;
    write.pBufferInfo = &buffer;
    vkUpdateDescriptorSets(host_->device, 1, &write, 0, nullptr);
  }
}

void Player::barriers(VkCommandBuffer commands, const WalrBarrier* first, std::uint32_t count) {
  std::vector<VkMemoryBarrier2> memory;
  std::vector<VkImageMemoryBarrier2> images;
  for (std::uint32_t i = 0; i < count; ++i) {
    const WalrBarrier& barrier = first[i];
    const bool handOver = barrier.alias_of != WALR_NONE;
    const HostImage* behindIt = behind(barrier.resource);
    const VkImage image = behindIt == nullptr ? VK_NULL_HANDLE : behindIt->image;
    // For buffers and for aliased memory a memory barrier is enough.
    if (handOver || image == VK_NULL_HANDLE) {
      memory.push_back({VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, barrier.src_stage, barrier.src_access,
                        barrier.dst_stage, barrier.dst_access});
    }
    if (image == VK_NULL_HANDLE) continue;
    VkImageMemoryBarrier2& made = images.emplace_back();
    made.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    made.srcStageMask = barrier.src_stage;
    made.srcAccessMask = barrier.src_access | (handOver ? VK_ACCESS_2_MEMORY_WRITE_BIT : VkAccessFlags2{0});
    made.dstStageMask = barrier.dst_stage;
    made.dstAccessMask = barrier.dst_access;
    made.oldLayout = barrier.old_layout;
    made.newLayout = barrier.new_layout;
    made.srcQueueFamilyIndex = made.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    made.image = image;
    made.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  }
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.memoryBarrierCount = static_cast<std::uint32_t>(memory.size());
  dependency.pMemoryBarriers = memory.data();
  dependency.imageMemoryBarrierCount = static_cast<std::uint32_t>(images.size());
  dependency.pImageMemoryBarriers = images.data();
  if (count > 0) vkCmdPipelineBarrier2(commands, &dependency);
}

void Player::beginFrame(const WalrPassFrame& frame) {
  if (api_->begin_frame(passes_, &frame) != WALR_SUCCESS) throw std::runtime_error(api_->last_error());
  for (std::uint32_t i = 0; i < resources_.size(); ++i) {
    void* mapped = behind_[i].mapped[parity_];
    if (mapped == nullptr) continue;
    std::size_t size = resources_[i].buffer_size;
    if (api_->get_frame_constants(passes_, i, mapped, &size) != WALR_SUCCESS) {
      throw std::runtime_error(api_->last_error());
    }
  }
  for (std::uint32_t i = 0; i < list_->pass_count; ++i) writeSets(i);
}

void Player::record(VkCommandBuffer commands, std::uint32_t index) {
  const WalrDispatch& dispatch = *list_->passes[index];
  const Pass& pass = pipelines_[index];
  barriers(commands, dispatch.barriers, dispatch.barrier_count);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.pipeline);
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.layout, 0, 1, &pass.sets[parity_], 0, nullptr);
  if (dispatch.push_constant_size > 0) {
    const auto* bytes = static_cast<const std::byte*>(dispatch.push_constants);
    std::vector<std::byte> constants(bytes, bytes + dispatch.push_constant_size);
    for (std::uint32_t i = 0; i < dispatch.history_age_count; ++i) {
      const WalrHistoryAge& age = dispatch.history_ages[i];
      std::memcpy(constants.data() + age.offset, &behind_[age.resource].age, sizeof(behind_[age.resource].age));
    }
    vkCmdPushConstants(commands, pass.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, dispatch.push_constant_size,
                       constants.data());
  }
  if (dispatch.indirect == WALR_NONE) {
    vkCmdDispatch(commands, dispatch.group_count[0], dispatch.group_count[1], dispatch.group_count[2]);
  } else {
    vkCmdDispatchIndirect(commands, behind_.at(dispatch.indirect).buffers[parity_], dispatch.indirect_offset);
  }
}

void Player::frames(std::span<const WalrPassFrame> frames) {
  if (frames.size() > 2) throw std::runtime_error("descriptors and constants exist twice");
  const VkCommandBuffer commands = host_begin(host_);
  for (const WalrPassFrame& frame : frames) {
    beginFrame(frame);
    enter(commands);
    for (std::uint32_t i = 0; i < list_->pass_count; ++i) record(commands, i);
    barriers(commands, list_->releases, list_->release_count);
    leave();
  }
  // The host copies from its images next. The change of layout shows validation whether it waits for the list.
  for (auto& [name, image] : hostImages_) {
    if (image.layout == VK_IMAGE_LAYOUT_UNDEFINED) continue;  // Neither written nor used.
    transition(commands, image,
               {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, 0});
  }
  host_submit_and_wait(host_, commands);
}

}  // namespace list_host
