// walr with Qt's QRhi as the host: QRhi creates the images, fills them and reads the result back. walr records into
// QRhi's command buffer, between its commands.
#include <memory>

#include <vulkan/vulkan.h>

#include "plugin_host.h"

#include <QtGui/private/qrhi_p.h>
#include <QtGui/private/qrhivulkan_p.h>
#include <QtGui/QGuiApplication>
#include <QtGui/QVulkanInstance>

namespace plugin_host {
namespace {

constexpr VkImageUsageFlags kInputUsage =
    VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

/// A texture of QRhi.
struct Shared {
  std::unique_ptr<QRhiTexture> texture;
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkImageUsageFlags usage = 0;

  [[nodiscard]] VkImage image() const { return reinterpret_cast<VkImage>(texture->nativeTexture().object); }
};

class QtRhiTest : public PluginTest {
 protected:
  static void SetUpTestSuite() {
    static int count = 1;
    static char name[] = "qt_rhi_test";
    static char* arguments[] = {name, nullptr};
    application = std::make_unique<QGuiApplication>(count, arguments);
  }
  static void TearDownTestSuite() { application.reset(); }

  void openHost() override {
    // QRhi queries functions of surfaces although none is created.
    constexpr const char* kExtensions[] = {"VK_KHR_surface", "VK_KHR_xcb_surface"};
    host_open_with(&host, kExtensions, 2);
  }
  void SetUp() override {
    PluginTest::SetUp();
    instance_.setVkInstance(host.instance);
    ASSERT_TRUE(instance_.create()) << "no Vulkan on Qt's platform: it takes xcb, and an X server";
    QRhiVulkanInitParams params;
    params.inst = &instance_;
    QRhiVulkanNativeHandles handles;
    handles.physDev = host.physical_device;
    handles.dev = host.device;
    handles.gfxQueueFamilyIdx = static_cast<int>(host.queue_family);
    handles.gfxQueue = host.queue;
    rhi_.reset(QRhi::create(QRhi::Vulkan, &params, {}, &handles));
    ASSERT_NE(rhi_, nullptr);
  }
  void TearDown() override {
    EXPECT_EQ(host.messages, 0);
    rhi_.reset();
    instance_.destroy();
    PluginTest::TearDown();
  }

  std::vector<Shared> makeShared(Size size) {
    std::vector<Shared> shared;
    const auto add = [&](QRhiTexture::Format format, VkFormat vulkan, bool output) {
      QRhiTexture::Flags flags = QRhiTexture::UsedAsTransferSource;
      if (output) flags |= QRhiTexture::UsedWithLoadStore;
      Shared& made = shared.emplace_back();
      made.texture.reset(rhi_->newTexture(format, QSize(int(size.width), int(size.height)), 1, flags));
      if (!made.texture->create()) throw std::runtime_error("QRhi makes no such texture");
      made.format = vulkan;
      made.usage = kInputUsage | (output ? VK_IMAGE_USAGE_STORAGE_BIT : 0);
    };
    for (const char* input : kInputs) {
      const bool depth = std::string(input) == "depth";
      add(depth ? QRhiTexture::R32F : QRhiTexture::RGBA32F,
          depth ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT, false);
    }
    add(QRhiTexture::RGBA16F, VK_FORMAT_R16G16B16A16_SFLOAT, true);
    return shared;
  }

  QRhiCommandBuffer* begin() {
    QRhiCommandBuffer* commands = nullptr;
    if (rhi_->beginOffscreenFrame(&commands) != QRhi::FrameOpSuccess) throw std::runtime_error("QRhi begins no frame");
    return commands;
  }
  void end() { rhi_->endOffscreenFrame(); }

  void upload(QRhiCommandBuffer* commands, const std::vector<Shared>& shared, Size size, std::uint32_t number) {
    QRhiResourceUpdateBatch* batch = rhi_->nextResourceUpdateBatch();
    for (std::size_t i = 0; i < std::size(kInputs); ++i) {
      const std::vector<float> values = texels(kInputs[i], size, number);
      const QByteArray bytes(reinterpret_cast<const char*>(values.data()), qsizetype(values.size() * sizeof(float)));
      const QRhiTextureSubresourceUploadDescription whole(bytes);
      batch->uploadTexture(shared[i].texture.get(), QRhiTextureUploadDescription({0, 0, whole}));
    }
    commands->resourceUpdate(batch);
  }

  void readBack(QRhiCommandBuffer* commands, const Shared& shared, QRhiReadbackResult& result) {
    QRhiResourceUpdateBatch* batch = rhi_->nextResourceUpdateBatch();
    batch->readBackTexture(QRhiReadbackDescription(shared.texture.get()), &result);
    commands->resourceUpdate(batch);
  }

  /// Record our own commands between QRhi's.
  template <typename Record>
  void external(QRhiCommandBuffer* commands, Record record) {
    commands->beginExternal();
    const auto* handles = static_cast<const QRhiVulkanCommandBufferNativeHandles*>(commands->nativeHandles());
    record(handles->commandBuffer);
    commands->endExternal();
  }

  /// Record a frame of a denoiser and tell QRhi the resulting layouts.
  void denoise(QRhiCommandBuffer* commands, WalrDenoiser denoiser, std::vector<Shared>& shared, Size size,
               const WalrCamera& camera, std::uint32_t flags) {
    std::vector<WalrImage> images;
    for (const Shared& texture : shared) {
      WalrImage& image = images.emplace_back();
      image.struct_size = sizeof(image);
      image.queue_family = VK_QUEUE_FAMILY_IGNORED;
      image.image = texture.image();
      image.format = texture.format;
      image.usage = texture.usage;
      image.width = size.width;
      image.height = size.height;
      // QRhi tracks only the layout.
      image.acquire = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT,
                       static_cast<VkImageLayout>(texture.texture->nativeTexture().layout), 0};
    }
    const WalrFrame frame = frameOf(images, camera, flags);
    external(commands, [&](VkCommandBuffer buffer) { require(api().record(denoiser, buffer, &frame)); });
    for (std::size_t i = 0; i < shared.size(); ++i) {
      WalrImageState state{};
      if (api().get_release_state(denoiser, i < std::size(kInputs) ? kInputs[i] : "denoised", &state) != WALR_SUCCESS)
        continue;  // Unused.
      shared[i].texture->setNativeLayout(int(state.layout));
    }
  }

  static std::unique_ptr<QGuiApplication> application;

 private:
  QVulkanInstance instance_;
  std::unique_ptr<QRhi> rhi_;
};

std::unique_ptr<QGuiApplication> QtRhiTest::application;

std::vector<std::uint16_t> halves(const QRhiReadbackResult& result) {
  std::vector<std::uint16_t> values(std::size_t(result.data.size()) / sizeof(std::uint16_t));
  std::memcpy(values.data(), result.data.constData(), values.size() * sizeof(std::uint16_t));
  return values;
}

// As the guide says for hosts that track only layouts, the submission ends after the denoiser.
TEST_F(QtRhiTest, RecordsBetweenItsCommandsThroughResetAndResize) {
  for (const char* method : {"walr", "svgf", "accumulate"}) {
    Size size{61, 43};
    auto own = std::make_unique<Opaque>(host, api(), info(method, size));
    const WalrDenoiserInfo described = info(method, size);
    WalrDenoiser denoiser = nullptr;
    require(api().create_denoiser(&described, &denoiser));
    std::vector<Shared> shared = makeShared(size);
    for (std::uint32_t number = 0; number < 6; ++number) {
      SCOPED_TRACE(std::string(method) + ", frame " + std::to_string(number));
      if (number == 4) {
        for (const Shared& image : shared) require(api().forget_image(denoiser, image.image(), 0));
        size = {40, 45};
        require(api().resize(denoiser, size.width, size.height));
        shared = makeShared(size);
        // A dropped history does not restart frame numbers or forget the camera.
        own = std::make_unique<Opaque>(host, api(), info(method, size));
        uploadFrame(host, size, number, [&](std::size_t i) { return &own->image(i); });
        for (std::uint32_t before = 0; before < number; ++before) own->frame(cameraAt(float(before) * kStep), 0);
      }
      const WalrCamera camera = cameraAt(float(number) * kStep);
      constexpr std::uint32_t kReset = WALR_FRAME_RESET_HISTORY;
      const std::uint32_t flags = number == 2 ? kReset : 0;
      uploadFrame(host, size, number, [&](std::size_t i) { return &own->image(i); });
      own->frame(camera, number == 4 ? kReset : flags);

      QRhiCommandBuffer* commands = begin();
      upload(commands, shared, size, number);
      denoise(commands, denoiser, shared, size, camera, flags);
      end();
      QRhiReadbackResult result;
      readBack(begin(), shared.back(), result);
      end();
      EXPECT_EQ(halves(result), download(host, own->output()));
    }
    require(api().destroy_denoiser(denoiser));
  }
}

/// QRhi's own barrier after an image was written between its commands causes a message, even without walr.
TEST_F(QtRhiTest, MessagesWithinASubmissionAreTheHosts) {
  constexpr Size kSize{61, 43};
  const auto messagesOf = [&](bool ours) {
    std::vector<Shared> shared = makeShared(kSize);
    const WalrDenoiserInfo described = info("none", kSize);
    WalrDenoiser denoiser = nullptr;
    require(api().create_denoiser(&described, &denoiser));
    const int before = host.messages;
    QRhiCommandBuffer* commands = begin();
    upload(commands, shared, kSize, 0);
    if (ours) {
      denoise(commands, denoiser, shared, kSize, cameraAt(0), 0);
    } else {
      // No walr: a clear, made visible to everything.
      external(commands, [&](VkCommandBuffer buffer) {
        HostImage image{};
        image.image = shared.back().image();
        host_transition(buffer, &image, VK_PIPELINE_STAGE_2_CLEAR_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                        VK_IMAGE_LAYOUT_GENERAL);
        const VkClearColorValue colour{};
        const VkImageSubresourceRange range{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        vkCmdClearColorImage(buffer, image.image, VK_IMAGE_LAYOUT_GENERAL, &colour, 1, &range);
        host_transition(buffer, &image, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                        VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL);
      });
      shared.back().texture->setNativeLayout(int(VK_IMAGE_LAYOUT_GENERAL));
    }
    QRhiReadbackResult result;
    readBack(commands, shared.back(), result);
    end();
    require(api().destroy_denoiser(denoiser));
    return host.messages - before;
  };
  const int without = messagesOf(false);
  EXPECT_EQ(messagesOf(true), without);
  EXPECT_LE(without, 1);
  RecordProperty("messages", without);
  host.messages = 0;
}

}  // namespace
}  // namespace plugin_host
