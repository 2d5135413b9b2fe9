// walr with libplacebo as the host: libplacebo creates the images, fills them and reads the result back. Semaphores
// order its work and walr's.
#include "conformance.h"

extern "C" {
#include <libplacebo/vulkan.h>
}

namespace plugin_host {
namespace {

/// libplacebo waits with vkWaitSemaphoresKHR, which a device of Vulkan 1.2 has with this extension only.
constexpr const char* kExtensions[] = {VK_KHR_TIMELINE_SEMAPHORE_EXTENSION_NAME};

/// A texture of libplacebo and its image.
struct Shared {
  pl_tex texture = nullptr;
  VkImage image = VK_NULL_HANDLE;
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkImageUsageFlags usage = 0;
};

/// A buffer for transfers. Of a caller's address, libplacebo 4.208 imports the pages if they are many, by a function of
/// VK_EXT_external_memory_host, which it calls even if the device was created without it.
class Buffer {
 public:
  /// @param contents null: none yet
  Buffer(pl_gpu gpu, std::size_t size, const void* contents) : gpu_(gpu) {
    pl_buf_params params{};
    params.size = size;
    params.host_readable = contents == nullptr;
    params.initial_data = contents;
    buffer_ = pl_buf_create(gpu, &params);
    if (buffer_ == nullptr) throw std::runtime_error("libplacebo makes no buffer");
  }
  ~Buffer() { pl_buf_destroy(gpu_, &buffer_); }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  [[nodiscard]] pl_buf get() const { return buffer_; }

 private:
  pl_gpu gpu_;
  pl_buf buffer_ = nullptr;
};

/// libplacebo's name of a format.
const char* nameOf(VkFormat format) {
  constexpr std::pair<VkFormat, const char*> kNames[] = {{VK_FORMAT_R16_SFLOAT, "r16hf"},
                                                         {VK_FORMAT_R32_SFLOAT, "r32f"},
                                                         {VK_FORMAT_R32G32_SFLOAT, "rg32f"},
                                                         {VK_FORMAT_R16G16B16A16_SFLOAT, "rgba16hf"},
                                                         {VK_FORMAT_R32G32B32A32_SFLOAT, "rgba32f"}};
  const auto* found = std::ranges::find(kNames, format, [](const auto& pair) { return pair.first; });
  if (found == std::end(kNames)) throw std::runtime_error("libplacebo has no format " + std::to_string(format));
  return found->second;
}

/// A denoiser whose images are libplacebo's textures. Semaphores hand them over and back.
class LibplaceboDenoiser : public HostedCall {
 public:
  LibplaceboDenoiser(pl_gpu gpu, Host& host, const WalrApi& api, const WalrDenoiserInfo& info, const char* view)
      : HostedCall(api, info, view), gpu_(gpu), host_(&host), timeline_(host.device) {
    for (const NeededImage& image : needed()) shared_.push_back(create(image));
  }
  ~LibplaceboDenoiser() override {
    pl_gpu_finish(gpu_);
    destroyDenoiser();
    for (Shared& image : shared_) pl_tex_destroy(gpu_, &image.texture);
  }

  void frame(const Inputs& inputs, const WalrPassFrame& like, bool reset) override {
    WalrFrame frame = frameLike(like, reset ? WALR_FRAME_RESET_HISTORY : 0);
    std::vector<WalrImage> images(shared_.size());
    for (const auto& [name, values] : inputs) upload(name, values);
    for (std::size_t i = 0; i < shared_.size(); ++i) {
      if (!hold(shared_[i].texture, {timeline_.semaphore(), timeline_.raise()})) {
        throw std::runtime_error("libplacebo holds no " + needed()[i].name);
      }
      images[i] = describe(shared_[i], needed()[i].size);
      imageOf(frame, needed()[i].name) = &images[i];
    }
    pl_gpu_flush(gpu_);

    const VkCommandBuffer commands = host_begin(host_);
    const WalrResult result = api().record(denoiser(), commands, &frame);
    const std::uint64_t waited = timeline_.value();
    const std::uint64_t done = timeline_.raise();
    host_submit_between(host_, commands, timeline_.semaphore(), waited, done);

    for (const Shared& image : shared_) {
      release(image.texture, {timeline_.semaphore(), done});
    }
    require(result);
  }

  Texels read(const std::string& name) override {
    const Shared& image = shared_.at(indexOf(name));
    Texels result(image.texture->params.format->texel_size / sizeof(std::uint16_t) *
                  std::size_t(image.texture->params.w * image.texture->params.h));
    const std::size_t bytes = result.size() * sizeof(result[0]);
    const Buffer buffer(gpu_, bytes, nullptr);
    pl_tex_transfer_params transfer{};
    transfer.tex = image.texture;
    transfer.buf = buffer.get();
    if (!pl_tex_download(gpu_, &transfer) || !pl_buf_read(gpu_, buffer.get(), 0, result.data(), bytes)) {
      throw std::runtime_error("libplacebo reads no " + name);
    }
    return result;
  }

  /// libplacebo raises the semaphore once for each image that it hands over, and the host once after the frame.
  std::pair<VkSemaphore, std::uint64_t> nextCompletion() override {
    return {timeline_.semaphore(), timeline_.value() + shared_.size() + 1};
  }

 private:
  // Newer versions of libplacebo have only the functions that take a structure, and older ones only the others.
#ifdef WALR_LIBPLACEBO_HOLDS_BY_STRUCTURE
  [[nodiscard]] bool hold(pl_tex texture, pl_vulkan_sem signalled) const {
    pl_vulkan_hold_params params{};
    params.tex = texture;
    params.layout = VK_IMAGE_LAYOUT_GENERAL;
    params.qf = VK_QUEUE_FAMILY_IGNORED;
    params.semaphore = signalled;
    return pl_vulkan_hold_ex(gpu_, &params);
  }
  void release(pl_tex texture, pl_vulkan_sem awaited) const {
    pl_vulkan_release_params params{};
    params.tex = texture;
    params.layout = VK_IMAGE_LAYOUT_GENERAL;
    params.qf = VK_QUEUE_FAMILY_IGNORED;
    params.semaphore = awaited;
    pl_vulkan_release_ex(gpu_, &params);
  }
#else
  [[nodiscard]] bool hold(pl_tex texture, pl_vulkan_sem signalled) const {
    return pl_vulkan_hold(gpu_, texture, VK_IMAGE_LAYOUT_GENERAL, signalled);
  }
  void release(pl_tex texture, pl_vulkan_sem awaited) const {
    pl_vulkan_release(gpu_, texture, VK_IMAGE_LAYOUT_GENERAL, awaited);
  }
#endif

  [[nodiscard]] Shared create(const NeededImage& image) const {
    pl_tex_params params{};
    params.w = static_cast<int>(image.size.width);
    params.h = static_cast<int>(image.size.height);
    params.format = pl_find_named_fmt(gpu_, nameOf(image.format));
    params.sampleable = true;
    params.storable = image.written();
    params.host_writable = !image.written();
    params.host_readable = image.written();
    Shared shared;
    shared.texture = pl_tex_create(gpu_, &params);
    if (shared.texture == nullptr) throw std::runtime_error("libplacebo makes no " + image.name);
    shared.image = pl_vulkan_unwrap(gpu_, shared.texture, &shared.format, &shared.usage);
    return shared;
  }

  void upload(const std::string& name, const std::vector<float>& values) {
    const Buffer buffer(gpu_, values.size() * sizeof(float), values.data());
    pl_tex_transfer_params transfer{};
    transfer.tex = shared_.at(indexOf(name)).texture;
    transfer.buf = buffer.get();
    if (!pl_tex_upload(gpu_, &transfer)) throw std::runtime_error("libplacebo fills no " + name);
  }

  static WalrImage describe(const Shared& shared, Size size) {
    WalrImage image{};
    image.struct_size = sizeof(image);
    image.queue_family = VK_QUEUE_FAMILY_IGNORED;
    image.image = shared.image;
    image.format = shared.format;
    image.usage = shared.usage;
    image.width = size.width;
    image.height = size.height;
    // All commands wait for the semaphore, so the first barrier may chain to any stage.
    image.acquire = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_GENERAL, 0};
    return image;
  }

  pl_gpu gpu_;
  Host* host_;
  walr::test::HostTimeline timeline_;
  std::vector<Shared> shared_;  ///< In the order of `needed()`.
};

class LibplaceboTest : public ConformanceTest {
 protected:
  void openHost() override { host_open_with(&host, nullptr, 0, kExtensions, std::size(kExtensions)); }
  void SetUp() override {
    PluginTest::SetUp();
    pl_vulkan_import_params params{};
    params.extensions = kExtensions;
    params.num_extensions = std::size(kExtensions);
    params.instance = host.instance;
    params.get_proc_addr = vkGetInstanceProcAddr;
    params.phys_device = host.physical_device;
    params.device = host.device;
    params.queue_graphics = params.queue_compute = params.queue_transfer = {host.queue_family, 1};
    params.features = &host.features;
    vulkan_ = pl_vulkan_import(nullptr, &params);
    ASSERT_NE(vulkan_, nullptr);
    // libplacebo queries functions of extensions that were not enabled. These messages come before any call of ours.
    hostMessages_ = host.messages;
  }
  void TearDown() override {
    EXPECT_EQ(host.messages, hostMessages_) << "messages after libplacebo's import";
    pl_vulkan_destroy(&vulkan_);
    host.messages = 0;
    PluginTest::TearDown();
  }

  std::unique_ptr<HostedDenoiser> make(const WalrDenoiserInfo& info, const char* view) override {
    return std::make_unique<LibplaceboDenoiser>(vulkan_->gpu, host, api(), info, view);
  }

  [[nodiscard]] std::string lacks(std::string_view feature) const override {
    return feature == "ResultIn32Bits" ? "libplacebo has no format B10G11R11_UFLOAT" : "";
  }

 private:
  pl_vulkan vulkan_ = nullptr;
  int hostMessages_ = 0;
};

class LibplaceboFeatures : public LibplaceboTest, public testing::WithParamInterface<Feature> {};

TEST_P(LibplaceboFeatures, GiveThePixelsOfAPlainHost) {
  check(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Every, LibplaceboFeatures, testing::ValuesIn(features()), nameOfFeature);

}  // namespace
}  // namespace plugin_host
