#include "stage_host.h"

#include <cstddef>
#include <stdexcept>
#include <string_view>

namespace stage_host {
namespace {

constexpr VkPipelineStageFlags2 kStage = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkAccessFlags2 kAccess = VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT;

const WalrPassType& typeNamed(const WalrApi& api, std::string_view name) {
  for (std::uint32_t i = 0; i < api.pass_type_count(); ++i) {
    if (name == api.pass_type(i)->name) return *api.pass_type(i);
  }
  throw std::runtime_error("there is no stage " + std::string(name));
}

bool isHostImage(const std::string& port) {
  return port == "lighting" || port == "depth" || port == "normal" || port == "motion" || port == "albedo" ||
         port == "confidence";
}

}  // namespace

Chain::~Chain() {
  for (Stage& stage : stages_) {
    api_->destroy_passes(stage.passes);
    for (auto& [resource, buffer] : stage.buffers) host_destroy_buffer(host_, &buffer);
  }
  for (auto& [name, images] : images_) {
    for (HostImage& image : images) host_destroy_image(host_, &image);
  }
}

/// Create images with all usage flags that images between stages may need, filled with zeros.
void Chain::makeImages(const std::string& name, const WalrResource& resource, std::size_t count) {
  std::vector<HostImage>& images = images_[name];
  while (images.size() < count) {
    images.push_back(host_make_image(host_, resource.format, resource.width, resource.height,
                                     VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT));
    HostImage& image = images.back();
    const std::vector<std::byte> zeros(std::size_t{image.texel_size} * image.width * image.height);
    host_upload(host_, &image, zeros.data());
  }
}

void Chain::add(WalrDenoiserInfo info, const std::vector<WalrSettingValue>& settings,
                const std::map<std::string, std::string>& renamed) {
  const auto sourceOf = [&](const std::string& port) {
    const auto other = renamed.find(port);
    return outputs_.find(other == renamed.end() ? port : other->second);
  };
  std::vector<WalrPortFormat> formats;
  const WalrPassType& type = typeNamed(*api_, info.method);
  for (std::uint32_t i = 0; i < type.port_count; ++i) {
    const WalrPort& port = *type.ports[i];
    const auto made = sourceOf(port.name);
    if (port.output == VK_FALSE && port.buffer == VK_FALSE && made != outputs_.end()) {
      formats.push_back({port.name, made->second.format, 0});
    }
  }
  WalrPassesInfo passes{};
  passes.struct_size = sizeof(passes);
  passes.denoiser = &info;
  passes.settings = settings.data();
  passes.setting_count = static_cast<std::uint32_t>(settings.size());
  passes.ports = formats.data();
  passes.port_count = static_cast<std::uint32_t>(formats.size());
  Stage& stage = stages_.emplace_back();
  if (api_->create_passes(&passes, &stage.passes) != WALR_SUCCESS) throw std::runtime_error(api_->last_error());
  if (api_->get_pass_list(stage.passes, &stage.list) != WALR_SUCCESS) throw std::runtime_error(api_->last_error());

  const WalrPassList& list = *stage.list;
  stage.images.resize(list.resource_count);
  stage.swapped.resize(list.resource_count);
  for (std::uint32_t i = 0; i < list.resource_count; ++i) {
    const WalrResource& resource = *list.resources[i];
    if (resource.kind == WALR_RESOURCE_UPLOAD || resource.kind == WALR_RESOURCE_HISTORY_PREVIOUS) continue;
    if (resource.buffer == VK_TRUE) {
      if (resource.kind != WALR_RESOURCE_TRANSIENT) throw std::runtime_error("this host connects images only");
      stage.buffers[i] = host_make_buffer(host_, resource.buffer_size, resource.buffer_usage, 0);
      continue;
    }
    const auto made = sourceOf(resource.name);
    if (resource.kind == WALR_RESOURCE_HOST && made != outputs_.end()) {
      stage.images[i] = made->second.image;
      stage.swapped[i] = made->second.swapped;
      continue;
    }
    const bool history = resource.kind == WALR_RESOURCE_HISTORY_CURRENT;
    const bool own = resource.kind != WALR_RESOURCE_HOST;
    stage.images[i] = own ? std::to_string(stages_.size()) + "/" + resource.name : resource.name;
    if (!own && !isHostImage(resource.name) && std::string(resource.name) != "denoised") {
      throw std::runtime_error(std::string("no stage before makes ") + resource.name);
    }
    makeImages(stage.images[i], resource, history ? 2 : 1);
    if (!history) continue;
    stage.images[resource.partner] = stage.images[i];
    stage.swapped[resource.partner] = true;
  }
  for (std::uint32_t i = 0; i < list.port_count; ++i) {
    const WalrPortResource& port = list.ports[i];
    if (port.output == VK_FALSE) continue;
    outputs_[port.port] = {stage.images[port.resource], stage.swapped[port.resource],
                           list.resources[port.resource]->format};
  }
}

HostImage& Chain::behind(const Stage& stage, std::uint32_t resource) {
  std::vector<HostImage>& images = images_.at(stage.images[resource]);
  return images[(frames_ + (stage.swapped[resource] ? 1 : 0)) % images.size()];
}

void Chain::record(const Stage& stage, std::uint32_t index, VkCommandBuffer commands) {
  const WalrDispatch& pass = *stage.list->passes[index];
  std::vector<WalrPassResource> resources(pass.binding_count);
  for (std::uint32_t b = 0; b < pass.binding_count; ++b) {
    const std::uint32_t resource = pass.bindings[b]->resource;
    const WalrResourceKind kind = stage.list->resources[resource]->kind;
    if (kind == WALR_RESOURCE_UPLOAD || (kind == WALR_RESOURCE_HISTORY_PREVIOUS && frames_ == 0)) continue;
    const auto buffer = stage.buffers.find(resource);
    if (buffer != stage.buffers.end()) {
      resources[b].buffer = buffer->second.buffer;
      continue;
    }
    resources[b].image = behind(stage, resource).image;
    resources[b].layout = VK_IMAGE_LAYOUT_GENERAL;
  }
  VkMemoryBarrier2 everything{};
  everything.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  everything.srcStageMask = everything.dstStageMask = kStage;
  everything.srcAccessMask = everything.dstAccessMask = kAccess;
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &everything;
  vkCmdPipelineBarrier2(commands, &dependency);
  if (api_->record_pass(stage.passes, index, commands, resources.data(), pass.binding_count) != WALR_SUCCESS) {
    throw std::runtime_error(api_->last_error());
  }
}

void Chain::frame(const WalrPassFrame& frame) {
  const VkCommandBuffer commands = host_begin(host_);
  for (auto& [name, images] : images_) {
    for (HostImage& image : images) host_transition(commands, &image, kStage, kAccess, VK_IMAGE_LAYOUT_GENERAL);
  }
  for (const Stage& stage : stages_) {
    if (api_->begin_frame(stage.passes, &frame) != WALR_SUCCESS) throw std::runtime_error(api_->last_error());
    for (std::uint32_t i = 0; i < stage.list->pass_count; ++i) record(stage, i, commands);
  }
  host_submit_and_wait(host_, commands);
  ++frames_;
}

}  // namespace stage_host
