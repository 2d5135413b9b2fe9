// walr's passes in skaarj1989's FrameGraph. Built with cmake -DWALR_SKAARJ_FRAMEGRAPH=FOLDER.
#include <map>
#include <memory>
#include <tuple>

#include <walr/adapters/framegraph.h>

#include "conformance.h"

namespace plugin_host {
namespace {

constexpr std::uint32_t kRead = 1;
constexpr std::uint32_t kWrite = 2;

struct BufferDesc {
  std::uint64_t size = 0;
  VkBufferUsageFlags usage = 0;
};

/// A pool of images and buffers that frames reuse, with their current states.
class Pool {
 public:
  using Key = std::tuple<VkFormat, std::uint32_t, std::uint32_t, VkImageUsageFlags>;

  explicit Pool(Host& host) : host_(&host) {}
  ~Pool() {
    for (const auto& image : all_) host_destroy_image(host_, image.get());
    for (const auto& [buffer, memory] : buffers_) {
      vkDestroyBuffer(host_->device, buffer, nullptr);
      vkFreeMemory(host_->device, memory, nullptr);
    }
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  HostImage* take(const Key& key) {
    std::vector<HostImage*>& free = free_[key];
    if (free.empty()) {
      const auto [format, width, height, usage] = key;
      all_.push_back(std::make_unique<HostImage>(host_make_image(host_, format, width, height, usage)));
      return all_.back().get();
    }
    HostImage* image = free.back();
    free.pop_back();
    return image;
  }
  void give(const Key& key, HostImage* image) { free_[key].push_back(image); }
  [[nodiscard]] std::size_t size() const { return all_.size(); }

  /// Buffers are few and are not reused.
  VkBuffer makeBuffer(const BufferDesc& desc) {
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = desc.size;
    info.usage = desc.usage;
    VkBuffer buffer = VK_NULL_HANDLE;
    if (vkCreateBuffer(host_->device, &info, nullptr, &buffer) != VK_SUCCESS) throw std::runtime_error("buffer");
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(host_->device, buffer, &needs);
    const VkDeviceMemory memory = host_allocate(host_, needs, 0);
    buffers_.emplace_back(buffer, memory);
    if (vkBindBufferMemory(host_->device, buffer, memory, 0) != VK_SUCCESS) throw std::runtime_error("buffer's memory");
    return buffer;
  }

 private:
  Host* host_;
  std::vector<std::pair<VkBuffer, VkDeviceMemory>> buffers_;
  std::vector<std::unique_ptr<HostImage>> all_;
  std::map<Key, std::vector<HostImage*>> free_;
};

/// A texture of the graph. Images stay in GENERAL.
struct Texture {
  using Desc = Pool::Key;
  HostImage* image = nullptr;

  void create(const Desc& desc, void* pool) { image = static_cast<Pool*>(pool)->take(desc); }
  void destroy(const Desc& desc, void* pool) { static_cast<Pool*>(pool)->give(desc, image); }
  void preRead(const Desc& /*desc*/, std::uint32_t /*flags*/, void* context) {
    barrier(context, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
  }
  void preWrite(const Desc& /*desc*/, std::uint32_t flags, void* context) {
    barrier(context, (flags & kRead) != 0 ? VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT
                                          : VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
  }

 private:
  void barrier(void* context, VkAccessFlags2 access) const {
    host_transition(static_cast<VkCommandBuffer>(context), image, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, access,
                    VK_IMAGE_LAYOUT_GENERAL);
  }
};

struct Buffer {
  using Desc = BufferDesc;
  VkBuffer buffer = VK_NULL_HANDLE;

  void create(const Desc& desc, void* pool) { buffer = static_cast<Pool*>(pool)->makeBuffer(desc); }
  void destroy(const Desc& /*desc*/, void* /*pool*/) {}
  void preRead(const Desc& /*desc*/, std::uint32_t /*flags*/, void* context) { barrier(context); }
  void preWrite(const Desc& /*desc*/, std::uint32_t /*flags*/, void* context) { barrier(context); }

 private:
  /// A barrier for any later use.
  static void barrier(void* context) {
    VkMemoryBarrier2 everything{};
    everything.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    everything.srcStageMask = everything.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    everything.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    everything.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    VkDependencyInfo dependency{};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &everything;
    vkCmdPipelineBarrier2(static_cast<VkCommandBuffer>(context), &dependency);
  }
};

struct Binder {
  using Texture = plugin_host::Texture;
  using Buffer = plugin_host::Buffer;
  static Texture::Desc textureDesc(const WalrResource& r) { return {r.format, r.width, r.height, r.image_usage}; }
  static Buffer::Desc bufferDesc(const WalrResource& r) { return {r.buffer_size, r.buffer_usage}; }
  static std::uint32_t flags(const WalrBinding& binding) {
    return ((binding.access & VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT) != 0 ? kWrite : 0) |
           ((binding.access & ~VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT) != 0 ? kRead : 0);
  }
  static WalrPassResource bind(Texture& texture) {
    return {texture.image->image, VK_NULL_HANDLE, 0, VK_IMAGE_LAYOUT_GENERAL, 0};
  }
  static WalrPassResource bind(Buffer& buffer) {
    return {VK_NULL_HANDLE, buffer.buffer, 0, VK_IMAGE_LAYOUT_UNDEFINED, 0};
  }
  static VkCommandBuffer commands(void* context) { return static_cast<VkCommandBuffer>(context); }
};

/// The host: it creates its images and the histories once, and a graph in every frame.
class Engine {
 public:
  Engine(Host& host, const WalrApi& api, WalrPasses passes) : host_(&host), api_(&api), passes_(passes), pool_(host) {
    if (api.get_pass_list(passes, &list_) != WALR_SUCCESS) throw std::runtime_error(api.last_error());
    for (std::uint32_t i = 0; i < list_->resource_count; ++i) {
      const WalrResource& r = *list_->resources[i];
      if (r.kind == WALR_RESOURCE_HOST) own_[i] = make(r);
      if (r.kind == WALR_RESOURCE_HISTORY_CURRENT && r.used == VK_TRUE) {
        own_[i] = make(r);
        own_[r.partner] = make(r);
      }
    }
  }
  ~Engine() {
    for (auto& [index, image] : own_) host_destroy_image(host_, &image);
  }
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  HostImage& image(const std::string& name) {
    for (auto& [index, image] : own_) {
      if (list_->resources[index]->name == name && list_->resources[index]->kind == WALR_RESOURCE_HOST) return image;
    }
    throw std::out_of_range(name);
  }
  void resetHistory() { hasHistory_ = false; }
  [[nodiscard]] std::size_t transientImages() const { return pool_.size(); }
  [[nodiscard]] std::size_t transients() const {
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < list_->resource_count; ++i)
      count += list_->resources[i]->kind == WALR_RESOURCE_TRANSIENT && list_->resources[i]->used == VK_TRUE ? 1 : 0;
    return count;
  }

  void frame(const WalrPassFrame& frame) {
    if (api_->begin_frame(passes_, &frame) != WALR_SUCCESS) throw std::runtime_error(api_->last_error());
    using Passes = walr::adapters::FrameGraphPasses<Binder>;
    FrameGraph graph;
    graph.reserve(64, 256);
    bool deadRan = false;
    graph.addCallbackPass<Dead>(
        "dead",
        [](FrameGraph::Builder& builder, Dead& data) {
          data.target = builder.create<Texture>(
              "unread", {VK_FORMAT_R32_SFLOAT, 8, 8, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT});
          data.target = builder.write(data.target);
        },
        [&](const Dead& /*data*/, FrameGraphPassResources& /*resources*/, void* /*context*/) { deadRan = true; });
    std::vector<FrameGraphResource> resources(list_->resource_count, Passes::kNone);
    for (auto& [index, image] : own_) {
      const WalrResource& r = *list_->resources[index];
      if (r.kind == WALR_RESOURCE_HISTORY_PREVIOUS && !hasHistory_) continue;
      resources[index] = graph.import <Texture>(r.name, Binder::textureDesc(r), Texture{&image});
    }
    Passes(passes_, *list_, api_->record_pass, api_->last_error).add(graph, resources);
    const VkCommandBuffer commands = host_begin(host_);
    graph.compile();
    graph.execute(commands, &pool_);
    host_submit_and_wait(host_, commands);
    EXPECT_FALSE(deadRan) << "what nothing reads is culled";
    for (auto& [index, image] : own_) {
      const WalrResource& r = *list_->resources[index];
      if (r.kind == WALR_RESOURCE_HISTORY_CURRENT) std::swap(image, own_.at(r.partner));
    }
    hasHistory_ = true;
  }

 private:
  struct Dead {
    FrameGraphResource target;
  };

  HostImage make(const WalrResource& r) {
    return host_make_image(host_, r.format, r.width, r.height, r.image_usage | VK_IMAGE_USAGE_SAMPLED_BIT);
  }

  Host* host_;
  const WalrApi* api_;
  WalrPasses passes_;
  const WalrPassList* list_ = nullptr;
  Pool pool_;
  std::map<std::uint32_t, HostImage> own_;  ///< By resource.
  bool hasHistory_ = false;
};

class SkaarjFrameGraph : public PluginTest {};

TEST_F(SkaarjFrameGraph, EveryMethodGivesTheSamePixels) {
  for (const WalrPassType* type : registered.types) {
    if (type->method == VK_FALSE) continue;
    for (const Size size : {Size{61, 43}, Size{40, 45}}) {
      Opaque opaque(host, api(), info(type->name, size));
      const WalrPasses passes = makePasses(type->name, size);
      {
        Engine engine(host, api(), passes);
        for (std::uint32_t frame = 0; frame < 5; ++frame) {
          SCOPED_TRACE(std::string(type->name) + ", frame " + std::to_string(frame));
          uploadFrame(host, size, frame, [&](std::size_t i) { return &opaque.image(i); });
          uploadFrame(host, size, frame, [&](std::size_t i) { return &engine.image(kInputs[i]); });
          const bool reset = frame == 3;
          const WalrCamera camera = cameraAt(float(frame) * kStep);
          opaque.frame(camera, reset ? WALR_FRAME_RESET_HISTORY : 0);
          if (reset) engine.resetHistory();
          engine.frame(passFrame(camera));
          EXPECT_EQ(download(host, engine.image("denoised")), download(host, opaque.output()));
        }
        std::printf("%s: %zu transient images for %zu transients\n", type->name, engine.transientImages(),
                    engine.transients());
      }
      EXPECT_EQ(api().destroy_passes(passes), WALR_SUCCESS);
    }
  }
}

class SkaarjFrameGraphFeatures : public WayTest<Engine>, public testing::WithParamInterface<Feature> {};

TEST_P(SkaarjFrameGraphFeatures, GiveThePixelsOfAPlainHost) {
  check(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Every, SkaarjFrameGraphFeatures, testing::ValuesIn(features()), nameOfFeature);

}  // namespace
}  // namespace plugin_host
