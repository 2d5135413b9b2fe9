// walr with Qt's QRhi as the host: QRhi creates the images, fills them and reads the result back. walr records into
// QRhi's command buffer, between its commands.
#include <memory>

#include <vulkan/vulkan.h>

#include "conformance.h"

#include <QtGui/private/qrhi_p.h>
#include <QtGui/private/qrhivulkan_p.h>
#include <QtGui/QGuiApplication>
#include <QtGui/QVulkanInstance>

namespace plugin_host {
namespace {

constexpr VkImageUsageFlags kInputUsage =
    VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

QRhiTexture::Format formatOf(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R16_SFLOAT:
      return QRhiTexture::R16F;
    case VK_FORMAT_R32_SFLOAT:
      return QRhiTexture::R32F;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
      return QRhiTexture::RGBA16F;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
      return QRhiTexture::RGBA32F;
    default:
      throw std::runtime_error("QRhi has no format " + std::to_string(format));
  }
}

/// A denoiser whose images are QRhi's textures. It records into QRhi's command buffer, between QRhi's commands. As the
/// guide says for hosts that track only layouts, the submission ends after the denoiser.
class QtRhiDenoiser : public HostedCall {
 public:
  QtRhiDenoiser(QRhi& rhi, Host& host, const WalrApi& api, const WalrDenoiserInfo& info, const char* view)
      : HostedCall(api, info, view), rhi_(&rhi), host_(&host), timeline_(host.device) {
    for (const NeededImage& image : needed()) textures_.push_back(create(image));
  }
  ~QtRhiDenoiser() override { destroyDenoiser(); }

  void frame(const Inputs& inputs, const WalrPassFrame& like, bool reset) override {
    QRhiCommandBuffer* commands = begin();
    upload(commands, inputs);
    const WalrResult result = record(commands, frameLike(like, reset ? WALR_FRAME_RESET_HISTORY : 0));
    rhi_->endOffscreenFrame();
    require(result);
    // QRhi tells of its submissions by fences of its own, so the host raises a semaphore after them.
    if (like.finished != VK_NULL_HANDLE) host_signal(host_, timeline_.semaphore(), timeline_.raise());
  }
  Texels read(const std::string& name) override {
    QRhiReadbackResult result;
    readBack(begin(), name, result);
    rhi_->endOffscreenFrame();
    Texels values(std::size_t(result.data.size()) / sizeof(std::uint16_t));
    std::memcpy(values.data(), result.data.constData(), values.size() * sizeof(std::uint16_t));
    return values;
  }
  std::pair<VkSemaphore, std::uint64_t> nextCompletion() override {
    return {timeline_.semaphore(), timeline_.value() + 1};
  }

  void resize(Size size) {
    for (const auto& texture : textures_) require(api().forget_image(denoiser(), imageOfTexture(*texture), 0));
    require(api().resize(denoiser(), size.width, size.height));
    textures_.clear();
    for (NeededImage image : needed()) {
      image.size = size;
      textures_.push_back(create(image));
    }
  }

  QRhiCommandBuffer* begin() {
    QRhiCommandBuffer* commands = nullptr;
    if (rhi_->beginOffscreenFrame(&commands) != QRhi::FrameOpSuccess) throw std::runtime_error("QRhi begins no frame");
    return commands;
  }
  void upload(QRhiCommandBuffer* commands, const Inputs& inputs) {
    QRhiResourceUpdateBatch* batch = rhi_->nextResourceUpdateBatch();
    for (const auto& [name, values] : inputs) {
      const QByteArray bytes(reinterpret_cast<const char*>(values.data()), qsizetype(values.size() * sizeof(float)));
      const QRhiTextureSubresourceUploadDescription whole(bytes);
      batch->uploadTexture(textures_.at(indexOf(name)).get(), QRhiTextureUploadDescription({0, 0, whole}));
    }
    commands->resourceUpdate(batch);
  }
  void readBack(QRhiCommandBuffer* commands, const std::string& name, QRhiReadbackResult& result) {
    QRhiResourceUpdateBatch* batch = rhi_->nextResourceUpdateBatch();
    batch->readBackTexture(QRhiReadbackDescription(textures_.at(indexOf(name)).get()), &result);
    commands->resourceUpdate(batch);
  }
  /// Record a frame and tell QRhi the resulting layouts.
  WalrResult record(QRhiCommandBuffer* commands, WalrFrame frame) {
    std::vector<WalrImage> images(textures_.size());
    for (std::size_t i = 0; i < textures_.size(); ++i) {
      images[i] = describe(*textures_[i], needed()[i]);
      imageOf(frame, needed()[i].name) = &images[i];
    }
    WalrResult result = WALR_SUCCESS;
    external(commands, [&](VkCommandBuffer buffer) { result = api().record(denoiser(), buffer, &frame); });
    for (std::size_t i = 0; i < textures_.size(); ++i) {
      WalrImageState state{};
      if (api().get_release_state(denoiser(), needed()[i].name.c_str(), &state) != WALR_SUCCESS) continue;  // Unused.
      textures_[i]->setNativeLayout(int(state.layout));
    }
    return result;
  }
  /// No walr: clear the result, and make it visible to everything.
  void clear(QRhiCommandBuffer* commands) {
    QRhiTexture& texture = *textures_.at(indexOf("denoised"));
    external(commands, [&](VkCommandBuffer buffer) {
      HostImage image{};
      image.image = imageOfTexture(texture);
      host_transition(buffer, &image, VK_PIPELINE_STAGE_2_CLEAR_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                      VK_IMAGE_LAYOUT_GENERAL);
      const VkClearColorValue colour{};
      const VkImageSubresourceRange range{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
      vkCmdClearColorImage(buffer, image.image, VK_IMAGE_LAYOUT_GENERAL, &colour, 1, &range);
      host_transition(buffer, &image, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                      VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL);
    });
    texture.setNativeLayout(int(VK_IMAGE_LAYOUT_GENERAL));
  }

 private:
  [[nodiscard]] std::unique_ptr<QRhiTexture> create(const NeededImage& image) const {
    QRhiTexture::Flags flags = QRhiTexture::UsedAsTransferSource;
    if (image.written()) flags |= QRhiTexture::UsedWithLoadStore;
    std::unique_ptr<QRhiTexture> made(
        rhi_->newTexture(formatOf(image.format), QSize(int(image.size.width), int(image.size.height)), 1, flags));
    if (!made->create()) throw std::runtime_error("QRhi makes no such texture");
    return made;
  }
  static VkImage imageOfTexture(QRhiTexture& texture) {
    return reinterpret_cast<VkImage>(texture.nativeTexture().object);
  }
  static WalrImage describe(QRhiTexture& texture, const NeededImage& needed) {
    WalrImage image{};
    image.struct_size = sizeof(image);
    image.queue_family = VK_QUEUE_FAMILY_IGNORED;
    image.image = imageOfTexture(texture);
    image.format = needed.format;
    image.usage = kInputUsage | (needed.written() ? VK_IMAGE_USAGE_STORAGE_BIT : 0);
    image.width = std::uint32_t(texture.pixelSize().width());
    image.height = std::uint32_t(texture.pixelSize().height());
    // QRhi tracks only the layout.
    image.acquire = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT,
                     static_cast<VkImageLayout>(texture.nativeTexture().layout), 0};
    return image;
  }
  /// Record our own commands between QRhi's.
  template <typename Record>
  void external(QRhiCommandBuffer* commands, Record record) {
    commands->beginExternal();
    const auto* handles = static_cast<const QRhiVulkanCommandBufferNativeHandles*>(commands->nativeHandles());
    record(handles->commandBuffer);
    commands->endExternal();
  }

  QRhi* rhi_;
  Host* host_;
  walr::test::HostTimeline timeline_;
  std::vector<std::unique_ptr<QRhiTexture>> textures_;  ///< In the order of `needed()`.
};

class QtRhiTest : public ConformanceTest {
 protected:
  static void SetUpTestSuite() {
    static int count = 1;
    static char name[] = "qt_rhi_test";
    static char* arguments[] = {name, nullptr};
    application = std::make_unique<QGuiApplication>(count, arguments);
  }
  static void TearDownTestSuite() {
    closeHost();
    application.reset();
  }

  void openHost() override {
    // QRhi queries functions of surfaces although none is created.
    constexpr const char* kExtensions[] = {"VK_KHR_surface", "VK_KHR_xcb_surface"};
    host_open_with(&host, kExtensions, 2, nullptr, 0);
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

  std::unique_ptr<HostedDenoiser> make(const WalrDenoiserInfo& info, const char* view) override {
    return hosted(info, view);
  }
  [[nodiscard]] std::string lacks(std::string_view feature) const override {
    return feature == "ResultIn32Bits" ? "QRhi has no texture of B10G11R11_UFLOAT" : "";
  }
  /// QRhi has no texture of two 32-bit channels.
  [[nodiscard]] VkFormat motionWithoutDepth() const override { return VK_FORMAT_R32G32B32A32_SFLOAT; }

  [[nodiscard]] std::unique_ptr<QtRhiDenoiser> hosted(const WalrDenoiserInfo& info, const char* view = nullptr) {
    return std::make_unique<QtRhiDenoiser>(*rhi_, host, api(), info, view);
  }
  void endFrame() { rhi_->endOffscreenFrame(); }
  static Inputs inputs(Size size, std::uint32_t number) {
    Inputs result;
    for (const char* name : kInputs) result[name] = texels(name, size, number);
    return result;
  }

  static std::unique_ptr<QGuiApplication> application;

 private:
  QVulkanInstance instance_;
  std::unique_ptr<QRhi> rhi_;
};

std::unique_ptr<QGuiApplication> QtRhiTest::application;

class QtRhiFeatures : public QtRhiTest, public testing::WithParamInterface<Feature> {};

TEST_P(QtRhiFeatures, GiveThePixelsOfAPlainHost) {
  check(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Every, QtRhiFeatures, testing::ValuesIn(features()), nameOfFeature);

TEST_F(QtRhiTest, RecordsBetweenItsCommandsThroughANewSize) {
  for (const char* method : {"walr", "svgf", "accumulate"}) {
    Size size{45, 37};
    auto own = std::make_unique<Opaque>(host, api(), info(method, size));
    const auto denoiser = hosted(info(method, size));
    for (std::uint32_t number = 0; number < 4; ++number) {
      SCOPED_TRACE(std::string(method) + ", frame " + std::to_string(number));
      const bool resized = number == 2;
      if (resized) {
        size = {40, 45};
        denoiser->resize(size);
        // A dropped history does not restart frame numbers or forget the camera.
        own = std::make_unique<Opaque>(host, api(), info(method, size));
        uploadFrame(host, size, number, [&](std::size_t i) { return &own->image(i); });
        for (std::uint32_t before = 0; before < number; ++before) own->frame(cameraAt(float(before) * kStep), 0);
      }
      const WalrCamera camera = cameraAt(float(number) * kStep);
      uploadFrame(host, size, number, [&](std::size_t i) { return &own->image(i); });
      own->frame(camera, resized ? WALR_FRAME_RESET_HISTORY : 0);
      denoiser->frame(inputs(size, number), passFrame(camera), false);
      EXPECT_EQ(denoiser->read("denoised"), download(host, own->output()));
    }
  }
}

/// QRhi's own barrier after an image was written between its commands causes a message, even without walr.
TEST_F(QtRhiTest, MessagesWithinASubmissionAreTheHosts) {
  constexpr Size kSize{45, 37};
  const auto messagesOf = [&](bool ours) {
    const auto denoiser = hosted(info("none", kSize));
    const int before = host.messages;
    QRhiCommandBuffer* commands = denoiser->begin();
    denoiser->upload(commands, inputs(kSize, 0));
    const WalrCamera camera = cameraAt(0);
    if (ours) {
      require(denoiser->record(commands, frameLike(passFrame(camera), 0)));
    } else {
      denoiser->clear(commands);
    }
    QRhiReadbackResult result;
    denoiser->readBack(commands, "denoised", result);
    endFrame();
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
