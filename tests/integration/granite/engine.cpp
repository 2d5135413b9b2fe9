// Granite's headers come before any of Vulkan's.
#include <walr/adapters/granite.h>

#include "granite/engine.h"

#include <cstdlib>
#include <cstring>
#include <optional>
#include <set>
#include <stdexcept>

#include <context.hpp>
#include <global_managers_init.hpp>
#include <task_composer.hpp>

namespace granite_host {
namespace {

constexpr std::uint32_t kVertex[] = {
#include "full_screen.vert.inc"
};
constexpr std::uint32_t kCopy[] = {
#include "copy.frag.inc"
};

std::size_t texelSize(VkFormat format) {
  return format == VK_FORMAT_R32G32B32A32_SFLOAT ? 16 : format == VK_FORMAT_B10G11R11_UFLOAT_PACK32 ? 4 : 8;
}

bool writes(const WalrBinding& binding) {
  return (binding.access & VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT) != 0;
}

/// Lets Granite use the host's instance.
class Instance final : public Vulkan::InstanceFactory {
 public:
  explicit Instance(const Host& host) : instance_(host.instance) {
    application_.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application_.apiVersion = VK_API_VERSION_1_3;
    info_.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info_.pApplicationInfo = &application_;
    info_.enabledExtensionCount = 1;
    info_.ppEnabledExtensionNames = &extension_;
  }
  VkInstance create_instance(const VkInstanceCreateInfo* /*info*/) override { return instance_; }
  const VkInstanceCreateInfo* get_existing_create_info() override { return &info_; }
  bool factory_owns_created_instance() override { return true; }

 private:
  VkInstance instance_;
  const char* extension_ = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  VkApplicationInfo application_{};
  VkInstanceCreateInfo info_{};
};

/// Lets Granite use the host's device and its only queue.
class Device final : public Vulkan::DeviceFactory {
 public:
  explicit Device(Host& host) : host_(&host) {
    queue_.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue_.queueFamilyIndex = host.queue_family;
    queue_.queueCount = 1;
    queue_.pQueuePriorities = &priority_;
    info_.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info_.pNext = &host.features;
    info_.queueCreateInfoCount = 1;
    info_.pQueueCreateInfos = &queue_;
  }
  VkDevice create_device(VkPhysicalDevice /*gpu*/, const VkDeviceCreateInfo* /*info*/) override {
    return host_->device;
  }
  const VkDeviceCreateInfo* get_existing_create_info() override { return &info_; }
  bool factory_owns_created_device() override { return true; }
  VkQueue get_queue(std::uint32_t /*family*/, std::uint32_t /*index*/) override { return host_->queue; }

 private:
  Host* host_;
  float priority_ = 1.0F;
  VkDeviceQueueCreateInfo queue_{};
  VkDeviceCreateInfo info_{};
};

/// Granite's global managers.
class Globals {
 public:
  Globals() {
    setenv("GRANITE_NUM_WORKER_THREADS", "4", 1);  // The default, the number of cores, may be one.
    Granite::Global::init(Granite::Global::MANAGER_FEATURE_EVENT_BIT |
                          Granite::Global::MANAGER_FEATURE_THREAD_GROUP_BIT |
                          Granite::Global::MANAGER_FEATURE_LOGGING_BIT);
  }
  ~Globals() { Granite::Global::deinit(); }
  Globals(const Globals&) = delete;
  Globals& operator=(const Globals&) = delete;
};

}  // namespace

struct Engine::Parts {
  explicit Parts(Host& host) : instance(host), device(host) {
    if (!Vulkan::Context::init_loader(nullptr)) throw std::runtime_error("Granite finds no Vulkan loader");
    context.set_instance_factory(&instance);
    context.set_device_factory(&device);
    Vulkan::Context::SystemHandles handles;
    handles.thread_group = GRANITE_THREAD_GROUP();
    context.set_system_handles(handles);
    context.set_num_thread_indices(GRANITE_THREAD_GROUP()->get_num_threads() + 1);
    if (!context.init_instance(nullptr, 0) || !context.init_device(host.physical_device, VK_NULL_HANDLE, nullptr, 0)) {
      throw std::runtime_error("Granite does not take the device");
    }
    vulkan.set_context(context);
    copy = vulkan.request_program(kVertex, sizeof(kVertex), kCopy, sizeof(kCopy));
  }

  /// Draw two textures, one below the other, as far as the target reaches.
  void draw(Vulkan::CommandBuffer& commands, const Vulkan::ImageView& first, const Vulkan::ImageView& second) const {
    commands.set_program(copy);
    commands.set_texture(0, 0, first, Vulkan::StockSampler::NearestClamp);
    commands.set_texture(0, 1, second, Vulkan::StockSampler::NearestClamp);
    commands.set_opaque_state();
    commands.set_cull_mode(VK_CULL_MODE_NONE);
    commands.set_depth_test(false, false);
    commands.set_primitive_topology(VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST);
    commands.draw(3);
  }

  void addGbuffer();
  void addPresent();
  void makeImages(const WalrPassList& list, std::uint32_t width, std::uint32_t height);
  void upload(const std::map<std::string, std::vector<float>>& inputs);

  Globals globals;
  Instance instance;
  Device device;
  Vulkan::Context context;
  Vulkan::Device vulkan;
  Vulkan::Program* copy = nullptr;
  std::optional<walr::adapters::GranitePasses> walr;
  std::map<std::string, Vulkan::ImageHandle> sources;  ///< Source textures of the G-buffer.
  Vulkan::ImageHandle backBuffer;
  bool showsLengths = false;
  Granite::AttachmentInfo backInfo;
  Granite::RenderGraph graph;
};

Engine::Engine(Host& host) : parts_(std::make_unique<Parts>(host)) {}
Engine::~Engine() {
  drop();
}

void Engine::drop() {
  parts_->vulkan.wait_idle();
  parts_->graph.reset();
  parts_->walr.reset();
  parts_->sources.clear();
  parts_->backBuffer.reset();
}

/// A pass for each image of the G-buffer.
void Engine::Parts::addGbuffer() {
  for (const auto& [name, source] : sources) {
    Granite::RenderPass& pass = graph.add_pass("draw " + name, Granite::RENDER_GRAPH_QUEUE_GRAPHICS_BIT);
    Granite::AttachmentInfo info;
    info.size_class = Granite::SizeClass::Absolute;
    info.size_x = static_cast<float>(source->get_width());
    info.size_y = static_cast<float>(source->get_height());
    info.format = source->get_format();
    pass.add_color_output(name, info);
    pass.set_build_render_pass([this, &image = *source](Vulkan::CommandBuffer& commands) {
      draw(commands, image.get_view(), image.get_view());
    });
  }
}

void Engine::Parts::addPresent() {
  Granite::RenderPass& pass = graph.add_pass("present", Granite::RENDER_GRAPH_QUEUE_GRAPHICS_BIT);
  pass.add_color_output("back buffer", backInfo);
  Granite::RenderTextureResource& denoised = walr->readBy(pass);
  Granite::RenderTextureResource& lengths = showsLengths ? walr->readBy(pass, "history_length") : denoised;
  pass.set_build_render_pass([this, &denoised, &lengths](Vulkan::CommandBuffer& commands) {
    draw(commands, graph.get_physical_texture_resource(denoised), graph.get_physical_texture_resource(lengths));
  });
}

/// Fill an image with explicit commands: Granite's own uploads cause validation messages.
void Engine::Parts::makeImages(const WalrPassList& list, std::uint32_t width, std::uint32_t height) {
  std::set<std::uint32_t> written;
  for (std::uint32_t p = 0; p < list.pass_count; ++p) {
    for (std::uint32_t b = 0; b < list.passes[p]->binding_count; ++b) {
      if (writes(*list.passes[p]->bindings[b])) written.insert(list.passes[p]->bindings[b]->resource);
    }
  }
  VkFormat shown = VK_FORMAT_UNDEFINED;
  showsLengths = false;
  for (std::uint32_t i = 0; i < list.resource_count; ++i) {
    const WalrResource& resource = *list.resources[i];
    const std::string name = resource.name;
    if (resource.kind != WALR_RESOURCE_HOST) continue;
    if (name == "denoised") shown = resource.format;
    showsLengths = showsLengths || name == "history_length";
    if (written.contains(i)) continue;
    Vulkan::ImageCreateInfo info = Vulkan::ImageCreateInfo::immutable_2d_image(width, height, resource.format);
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.initial_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    sources[name] = vulkan.create_image(info);
  }
  const std::uint32_t backHeight = showsLengths ? 2 * height : height;
  Vulkan::ImageCreateInfo back = Vulkan::ImageCreateInfo::render_target(width, backHeight, shown);
  back.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  back.initial_layout = VK_IMAGE_LAYOUT_UNDEFINED;
  backBuffer = vulkan.create_image(back);
  Vulkan::CommandBufferHandle commands = vulkan.request_command_buffer();
  commands->image_barrier(*backBuffer, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL,
                          VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                          VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
  vulkan.submit(commands);
}

void Engine::Parts::upload(const std::map<std::string, std::vector<float>>& inputs) {
  Vulkan::CommandBufferHandle commands = vulkan.request_command_buffer();
  for (const auto& [name, texels] : inputs) {
    Vulkan::Image& source = *sources.at(name);
    Vulkan::BufferCreateInfo info;
    info.size = texels.size() * sizeof(float);
    info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    info.domain = Vulkan::BufferDomain::Host;
    const Vulkan::BufferHandle staging = vulkan.create_buffer(info, texels.data());
    commands->image_barrier(source, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                            VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_NONE, VK_PIPELINE_STAGE_2_COPY_BIT,
                            VK_ACCESS_2_TRANSFER_WRITE_BIT);
    commands->copy_buffer_to_image(source, *staging, 0, {}, {source.get_width(), source.get_height(), 1}, 0, 0,
                                   {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1});
    commands->image_barrier(source, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL,
                            VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                            VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT);
  }
  vulkan.submit(commands);
}

void Engine::build(const WalrApi& api, WalrPasses passes, const WalrPassList& list, std::uint32_t width,
                   std::uint32_t height) {
  drop();
  Parts& p = *parts_;
  p.makeImages(list, width, height);
  Granite::ResourceDimensions dimensions;
  dimensions.width = p.backBuffer->get_width();
  dimensions.height = p.backBuffer->get_height();
  dimensions.format = p.backInfo.format = p.backBuffer->get_format();

  p.graph.set_device(&p.vulkan);
  p.graph.set_backbuffer_dimensions(dimensions);
  p.walr.emplace(passes, list,
                 walr::adapters::GranitePasses::Functions{api.begin_frame, api.record_pass, api.last_error});
  p.addGbuffer();
  p.walr->add(p.graph);
  p.addPresent();
  p.graph.set_backbuffer_source("back buffer");
  p.graph.bake();
}

unsigned Engine::position(const std::string& pass) const {
  return parts_->graph.find_pass("walr/" + pass)->get_physical_pass_index();
}

void Engine::frame(const WalrPassFrame& frame, const std::map<std::string, std::vector<float>>& inputs, bool reset) {
  Parts& p = *parts_;
  p.vulkan.next_frame_context();
  p.upload(inputs);
  p.walr->begin(frame, reset);
  p.graph.setup_attachments(p.vulkan, &p.backBuffer->get_view());
  Granite::TaskComposer composer(*GRANITE_THREAD_GROUP());
  p.graph.enqueue_render_passes(p.vulkan, composer);
  composer.get_outgoing_task()->wait();
  if (const std::string error = p.walr->error(); !error.empty()) throw std::runtime_error(error);
}

std::vector<std::uint16_t> Engine::read(bool barrier) {
  Parts& p = *parts_;
  const std::uint32_t width = p.backBuffer->get_width();
  const std::uint32_t height = p.backBuffer->get_height();
  std::vector<std::uint16_t> texels(texelSize(p.backBuffer->get_format()) / sizeof(std::uint16_t) * width * height);
  Vulkan::BufferCreateInfo info;
  info.size = texels.size() * sizeof(texels[0]);
  info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  info.domain = Vulkan::BufferDomain::CachedHost;
  const Vulkan::BufferHandle buffer = p.vulkan.create_buffer(info);
  Vulkan::CommandBufferHandle commands = p.vulkan.request_command_buffer();
  commands->image_barrier(*p.backBuffer, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                          barrier ? VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT : VK_PIPELINE_STAGE_2_NONE,
                          barrier ? VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT : VK_ACCESS_2_NONE,
                          VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
  commands->copy_image_to_buffer(*buffer, *p.backBuffer, 0, {}, {width, height, 1}, 0, 0,
                                 {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1});
  commands->image_barrier(*p.backBuffer, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL,
                          VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_NONE,
                          VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
  commands->barrier(VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_HOST_BIT,
                    VK_ACCESS_2_HOST_READ_BIT);
  Vulkan::Fence fence;
  p.vulkan.submit(commands, &fence);
  fence->wait();
  std::memcpy(texels.data(), p.vulkan.map_host_buffer(*buffer, Vulkan::MEMORY_ACCESS_READ_BIT), info.size);
  p.vulkan.unmap_host_buffer(*buffer, Vulkan::MEMORY_ACCESS_READ_BIT);
  return texels;
}

}  // namespace granite_host
