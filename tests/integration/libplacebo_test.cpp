// walr with libplacebo as the host: libplacebo creates the images, fills them and reads the result back. Semaphores
// order its work and walr's.
#include <map>

#include "plugin_host.h"
#include "tests/integration/host_timeline.h"

extern "C" {
#include <libplacebo/vulkan.h>
}

namespace plugin_host {
namespace {

constexpr Size kSize{61, 43};

/// A texture of libplacebo and its image.
struct Shared {
  pl_tex texture = nullptr;
  VkImage image = VK_NULL_HANDLE;
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkImageUsageFlags usage = 0;
};

class LibplaceboTest : public PluginTest {
 protected:
  void SetUp() override {
    PluginTest::SetUp();
    pl_vulkan_import_params params{};
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

  [[nodiscard]] pl_gpu gpu() const { return vulkan_->gpu; }

  Shared make(const char* format, bool output) const {
    pl_tex_params params{};
    params.w = static_cast<int>(kSize.width);
    params.h = static_cast<int>(kSize.height);
    params.format = pl_find_named_fmt(gpu(), format);
    params.sampleable = true;
    params.storable = output;
    params.host_writable = !output;
    params.host_readable = output;
    Shared shared;
    shared.texture = pl_tex_create(gpu(), &params);
    if (shared.texture == nullptr) throw std::runtime_error(std::string("libplacebo makes no ") + format);
    shared.image = pl_vulkan_unwrap(gpu(), shared.texture, &shared.format, &shared.usage);
    return shared;
  }

 private:
  pl_vulkan vulkan_ = nullptr;
  int hostMessages_ = 0;
};

WalrImage describe(const Shared& shared) {
  WalrImage image{};
  image.struct_size = sizeof(image);
  image.queue_family = VK_QUEUE_FAMILY_IGNORED;
  image.image = shared.image;
  image.format = shared.format;
  image.usage = shared.usage;
  image.width = kSize.width;
  image.height = kSize.height;
  // All commands wait for the semaphore, so the first barrier may chain to any stage.
  image.acquire = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_GENERAL, 0};
  return image;
}

TEST_F(LibplaceboTest, SemaphoresHandImagesOverAndBack) {
  Opaque own(host, api(), info("walr", kSize));
  WalrDenoiserInfo described = info("walr", kSize);
  WalrDenoiser denoiser = nullptr;
  require(api().create_denoiser(&described, &denoiser));
  walr::test::HostTimeline timeline(host.device);
  std::vector<Shared> shared;
  for (const char* input : kInputs) shared.push_back(make(std::string(input) == "depth" ? "r32f" : "rgba32f", false));
  shared.push_back(make("rgba16hf", true));

  for (std::uint32_t number = 0; number < 4; ++number) {
    const WalrCamera camera = cameraAt(float(number) * kStep);
    uploadFrame(host, kSize, number, [&](std::size_t i) { return &own.image(i); });
    own.frame(camera, 0);

    std::vector<WalrImage> images;
    for (std::size_t i = 0; i < shared.size(); ++i) {
      if (i < std::size(kInputs)) {
        std::vector<float> values = texels(kInputs[i], kSize, number);
        pl_tex_transfer_params transfer{};
        transfer.tex = shared[i].texture;
        transfer.ptr = values.data();
        ASSERT_TRUE(pl_tex_upload(gpu(), &transfer));
      }
      ASSERT_TRUE(
          pl_vulkan_hold(gpu(), shared[i].texture, VK_IMAGE_LAYOUT_GENERAL, {timeline.semaphore(), timeline.raise()}));
      images.push_back(describe(shared[i]));
    }
    pl_gpu_flush(gpu());

    const WalrFrame frame = frameOf(images, camera);
    const VkCommandBuffer commands = host_begin(&host);
    require(api().record(denoiser, commands, &frame));
    const std::uint64_t waited = timeline.value();
    const std::uint64_t done = timeline.raise();
    host_submit_between(&host, commands, timeline.semaphore(), waited, done);

    for (const Shared& image : shared) {
      pl_vulkan_release(gpu(), image.texture, VK_IMAGE_LAYOUT_GENERAL, {timeline.semaphore(), done});
    }
    std::vector<std::uint16_t> result(std::size_t{4} * kSize.width * kSize.height);
    pl_tex_transfer_params transfer{};
    transfer.tex = shared.back().texture;
    transfer.ptr = result.data();
    ASSERT_TRUE(pl_tex_download(gpu(), &transfer));
    EXPECT_EQ(result, download(host, own.output())) << "frame " << number;
  }
  pl_gpu_finish(gpu());
  require(api().destroy_denoiser(denoiser));
  for (Shared& image : shared) pl_tex_destroy(gpu(), &image.texture);
}

}  // namespace
}  // namespace plugin_host
