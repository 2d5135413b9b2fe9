// walr in NVRHI's command lists. Built with cmake -DWALR_NVRHI=FOLDER.
#include <cstring>
#include <memory>

#include <nvrhi/validation.h>
#include <walr/adapters/nvrhi.h>

#include "plugin_host.h"

namespace plugin_host {
namespace {

/// Counts NVRHI's own messages, including those of its validation layer.
class Complaints final : public nvrhi::IMessageCallback {
 public:
  void message(nvrhi::MessageSeverity severity, const char* text) override {
    if (severity >= nvrhi::MessageSeverity::Warning) ADD_FAILURE() << text;
  }
};

using Textures = std::vector<nvrhi::TextureHandle>;  ///< In the order of `kInputs`, then the denoised one.

class Nvrhi : public PluginTest {
 protected:
  void SetUp() override {
    PluginTest::SetUp();
    makeDevice(true);
  }
  /// @param newBarriers whether NVRHI uses synchronization2 for its barriers
  void makeDevice(bool newBarriers) {
    const char* extensions[] = {VK_KHR_SYNCHRONIZATION_2_EXTENSION_NAME};
    nvrhi::vulkan::DeviceDesc desc{};
    desc.errorCB = &complaints_;
    desc.instance = host.instance;
    desc.physicalDevice = host.physical_device;
    desc.device = host.device;
    desc.graphicsQueue = host.queue;
    desc.graphicsQueueIndex = static_cast<int>(host.queue_family);
    desc.deviceExtensions = extensions;
    desc.numDeviceExtensions = newBarriers ? 1 : 0;
    const nvrhi::DeviceHandle device = nvrhi::vulkan::createDevice(desc);
    ASSERT_TRUE(device);
    rhi_ = nvrhi::validation::createValidationLayer(device);
  }
  void TearDown() override {
    rhi_ = nullptr;
    PluginTest::TearDown();
  }

  nvrhi::TextureHandle make(nvrhi::Format format, Size size, bool output) {
    return rhi_->createTexture(nvrhi::TextureDesc()
                                   .setFormat(format)
                                   .setWidth(size.width)
                                   .setHeight(size.height)
                                   .setIsUAV(output)
                                   .setInitialState(nvrhi::ResourceStates::ShaderResource)
                                   .setKeepInitialState(true));
  }
  Textures makeTextures(Size size) {
    Textures textures;
    for (const char* input : kInputs) {
      const bool depth = std::string(input) == "depth";
      textures.push_back(make(depth ? nvrhi::Format::R32_FLOAT : nvrhi::Format::RGBA32_FLOAT, size, false));
    }
    textures.push_back(make(nvrhi::Format::RGBA16_FLOAT, size, true));
    return textures;
  }

  static void upload(nvrhi::ICommandList* commands, const Textures& textures, Size size, std::uint32_t number) {
    for (std::size_t i = 0; i < std::size(kInputs); ++i) {
      const std::vector<float> values = texels(kInputs[i], size, number);
      commands->writeTexture(textures[i], 0, 0, values.data(), values.size() * sizeof(float) / size.height);
    }
  }

  nvrhi::StagingTextureHandle copyOut(nvrhi::ICommandList* commands, nvrhi::ITexture* texture) {
    nvrhi::StagingTextureHandle staging = rhi_->createStagingTexture(texture->getDesc(), nvrhi::CpuAccessMode::Read);
    commands->copyTexture(staging, nvrhi::TextureSlice(), texture, nvrhi::TextureSlice());
    return staging;
  }
  /// Texels of `components` halves.
  std::vector<std::uint16_t> read(nvrhi::IStagingTexture* staging, Size size, std::size_t components = 4) {
    std::size_t pitch = 0;
    const auto* bytes = static_cast<const std::byte*>(
        rhi_->mapStagingTexture(staging, nvrhi::TextureSlice(), nvrhi::CpuAccessMode::Read, &pitch));
    std::vector<std::uint16_t> values(components * size.width * size.height);
    const std::size_t row = components * size.width * sizeof(std::uint16_t);
    for (std::uint32_t y = 0; y < size.height; ++y)
      std::memcpy(reinterpret_cast<std::byte*>(values.data()) + y * row, bytes + y * pitch, row);
    rhi_->unmapStagingTexture(staging);
    return values;
  }

  void submit(nvrhi::ICommandList* commands) {
    commands->close();
    rhi_->executeCommandList(commands);
    rhi_->waitForIdle();
    rhi_->runGarbageCollection();
  }

  /// One frame in one command list: NVRHI fills the inputs, walr denoises, NVRHI copies the result.
  std::vector<std::uint16_t> frame(const walr::adapters::NvrhiDenoiser& denoiser, const Textures& textures, Size size,
                                   std::uint32_t number, std::uint32_t flags) {
    const nvrhi::CommandListHandle commands = rhi_->createCommandList();
    commands->open();
    upload(commands, textures, size, number);
    const WalrCamera camera = cameraAt(float(number) * kStep);
    WalrFrame frame{};
    frame.struct_size = sizeof(frame);
    frame.flags = flags;
    frame.camera = &camera;
    denoiser.record(commands, {textures[0], textures[1], textures[2], textures[3], textures[4], textures[5]}, frame);
    const nvrhi::StagingTextureHandle staging = copyOut(commands, textures.back());
    submit(commands);
    return read(staging, size);
  }

  /// Compare seven frames, with a reset and a new size, with those of a plain Vulkan host.
  void compare(const char* method) {
    Size size{61, 43};
    auto opaque = std::make_unique<Opaque>(host, api(), info(method, size));
    const WalrDenoiserInfo described = info(method, size);
    WalrDenoiser denoiser = nullptr;
    require(api().create_denoiser(&described, &denoiser));
    const walr::adapters::NvrhiDenoiser adapter(denoiser, {api().record, api().forget_image, api().last_error});
    Textures textures = makeTextures(size);
    for (std::uint32_t number = 0; number < 7; ++number) {
      SCOPED_TRACE(std::string(method) + ", frame " + std::to_string(number));
      const bool resized = number == 4;
      if (resized) {
        for (nvrhi::ITexture* texture : textures) adapter.forget(texture);
        size = {40, 45};
        require(api().resize(denoiser, size.width, size.height));
        textures = makeTextures(size);
        // A dropped history does not restart frame numbers or forget the camera.
        opaque = std::make_unique<Opaque>(host, api(), info(method, size));
        uploadFrame(host, size, number, [&](std::size_t i) { return &opaque->image(i); });
        for (std::uint32_t before = 0; before < number; ++before) opaque->frame(cameraAt(float(before) * kStep), 0);
      }
      constexpr std::uint32_t kReset = WALR_FRAME_RESET_HISTORY;
      const std::uint32_t flags = number == 2 ? kReset : 0;
      uploadFrame(host, size, number, [&](std::size_t i) { return &opaque->image(i); });
      opaque->frame(cameraAt(float(number) * kStep), resized ? kReset : flags);
      EXPECT_EQ(frame(adapter, textures, size, number, flags), download(host, opaque->output()));
    }
    for (nvrhi::ITexture* texture : textures) adapter.forget(texture);
    require(api().destroy_denoiser(denoiser));
  }

  Complaints complaints_;
  nvrhi::DeviceHandle rhi_;
};

TEST_F(Nvrhi, EveryMethodGivesTheSamePixelsThroughResetAndResize) {
  for (const WalrPassType* type : registered.types)
    if (type->method == VK_TRUE) compare(type->name);
}

TEST_F(Nvrhi, HistoryConfidenceAndLengthsAreTheSame) {
  constexpr Size kSize{61, 43};
  const WalrDenoiserInfo whole = infoWithHistory("walr", kSize);
  Opaque opaque(host, api(), whole);
  WalrDenoiser denoiser = nullptr;
  require(api().create_denoiser(&whole, &denoiser));
  const walr::adapters::NvrhiDenoiser adapter(denoiser, {api().record, api().forget_image, api().last_error});
  const Textures textures = makeTextures(kSize);
  const nvrhi::TextureHandle confidence = make(nvrhi::Format::R32_FLOAT, kSize, false);
  const nvrhi::TextureHandle lengths = make(nvrhi::Format::R16_FLOAT, kSize, true);
  for (std::uint32_t number = 0; number < 4; ++number) {
    SCOPED_TRACE("frame " + std::to_string(number));
    const std::vector<float> trust = texels("confidence", kSize, number);
    const WalrCamera camera = cameraAt(float(number) * kStep);
    uploadFrame(host, kSize, number, [&](std::size_t i) { return &opaque.image(i); });
    host_upload(&host, &opaque.further("confidence"), trust.data());
    opaque.frame(camera, 0);

    const nvrhi::CommandListHandle commands = rhi_->createCommandList();
    commands->open();
    upload(commands, textures, kSize, number);
    commands->writeTexture(confidence, 0, 0, trust.data(), kSize.width * sizeof(float));
    WalrFrame frame{};
    frame.struct_size = sizeof(frame);
    frame.camera = &camera;
    walr::adapters::NvrhiTextures given{textures[0], textures[1], textures[2], textures[3], textures[4], textures[5]};
    given.confidence = confidence;
    given.historyLength = lengths;
    adapter.record(commands, given, frame);
    const nvrhi::StagingTextureHandle denoised = copyOut(commands, textures.back());
    const nvrhi::StagingTextureHandle history = copyOut(commands, lengths);
    submit(commands);
    EXPECT_EQ(read(denoised, kSize), download(host, opaque.output()));
    const std::vector<std::uint16_t> found = read(history, kSize, 1);
    EXPECT_EQ(found, download(host, opaque.further("history_length")));
    if (number == 3) expectLengthsByConfidence(found, kSize);
  }
  for (nvrhi::ITexture* texture : textures) adapter.forget(texture);
  for (nvrhi::ITexture* texture : {confidence.Get(), lengths.Get()}) adapter.forget(texture);
  require(api().destroy_denoiser(denoiser));
}

TEST_F(Nvrhi, GivesTheSamePixelsWithOldBarriers) {
  makeDevice(false);
  compare("walr");
}

TEST_F(Nvrhi, AMissingImageIsAnErrorAndTheCommandListStaysUsable) {
  constexpr Size kSize{64, 48};
  const WalrDenoiserInfo described = info("walr", kSize);
  WalrDenoiser denoiser = nullptr;
  require(api().create_denoiser(&described, &denoiser));
  const walr::adapters::NvrhiDenoiser adapter(denoiser, {api().record, api().forget_image, api().last_error});
  const nvrhi::CommandListHandle commands = rhi_->createCommandList();
  commands->open();
  const WalrCamera camera = cameraAt(0);
  WalrFrame frame{};
  frame.struct_size = sizeof(frame);
  frame.camera = &camera;
  walr::adapters::NvrhiTextures textures;
  const nvrhi::TextureHandle lighting = make(nvrhi::Format::RGBA32_FLOAT, kSize, false);
  textures.lighting = lighting;
  try {
    adapter.record(commands, textures, frame);
    FAIL() << "no depth";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("depth"), std::string::npos) << error.what();
  }
  submit(commands);
  require(api().destroy_denoiser(denoiser));
}

// Shows that the other tests would report missing barriers.
TEST_F(Nvrhi, ValidationReportsHazardsWithoutTheAdaptersStates) {
  constexpr Size kSize{64, 48};
  const WalrDenoiserInfo described = info("walr", kSize);
  WalrDenoiser denoiser = nullptr;
  require(api().create_denoiser(&described, &denoiser));
  const Textures textures = makeTextures(kSize);
  std::vector<WalrImage> images(textures.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    images[i].struct_size = sizeof(WalrImage);
    images[i].queue_family = VK_QUEUE_FAMILY_IGNORED;
    images[i].image = textures[i]->getNativeObject(nvrhi::ObjectTypes::VK_Image);
    images[i].format = nvrhi::vulkan::convertFormat(textures[i]->getDesc().format);
    images[i].usage = VK_IMAGE_USAGE_SAMPLED_BIT | (i + 1 == images.size() ? VK_IMAGE_USAGE_STORAGE_BIT : 0);
    images[i].width = kSize.width;
    images[i].height = kSize.height;
    // The layout is right, but the last write is not stated.
    const bool output = i + 1 == images.size();
    images[i].acquire.layout = output ? VK_IMAGE_LAYOUT_UNDEFINED : VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    images[i].release = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT,
                         output ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0};
  }
  const nvrhi::CommandListHandle commands = rhi_->createCommandList();
  commands->open();
  upload(commands, textures, kSize, 0);  // Leaves them in the state of copy destinations.
  const WalrCamera camera = cameraAt(0);
  const WalrFrame frame = frameOf(images, camera);
  const VkCommandBuffer buffer = commands->getNativeObject(nvrhi::ObjectTypes::VK_CommandBuffer);
  require(api().record(denoiser, buffer, &frame));
  submit(commands);
  EXPECT_EQ(host.messages, std::ssize(kInputs));
  host.messages = 0;
  require(api().destroy_denoiser(denoiser));
}

}  // namespace
}  // namespace plugin_host
