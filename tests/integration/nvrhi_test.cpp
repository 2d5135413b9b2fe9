// walr in NVRHI's command lists. Built with cmake -DWALR_NVRHI=FOLDER.
#include <cstring>
#include <map>
#include <memory>
#include <optional>

#include <nvrhi/validation.h>
#include <walr/adapters/nvrhi.h>

#include "conformance.h"

namespace plugin_host {
namespace {

/// Counts NVRHI's own messages, including those of its validation layer.
class Complaints final : public nvrhi::IMessageCallback {
 public:
  void message(nvrhi::MessageSeverity severity, const char* text) override {
    if (severity >= nvrhi::MessageSeverity::Warning) ADD_FAILURE() << text;
  }
};

nvrhi::Format formatOf(VkFormat format) {
  constexpr nvrhi::Format kFormats[] = {nvrhi::Format::R16_FLOAT,    nvrhi::Format::R32_FLOAT,
                                        nvrhi::Format::RG32_FLOAT,   nvrhi::Format::RGBA16_FLOAT,
                                        nvrhi::Format::RGBA32_FLOAT, nvrhi::Format::R11G11B10_FLOAT};
  for (const nvrhi::Format each : kFormats) {
    if (VkFormat(nvrhi::vulkan::convertFormat(each)) == format) return each;
  }
  throw std::runtime_error("the test knows no format of NVRHI for " + std::to_string(format));
}

nvrhi::TextureHandle makeTexture(nvrhi::IDevice& rhi, VkFormat format, Size size, bool output) {
  return rhi.createTexture(nvrhi::TextureDesc()
                               .setFormat(formatOf(format))
                               .setWidth(size.width)
                               .setHeight(size.height)
                               .setIsUAV(output)
                               .setInitialState(nvrhi::ResourceStates::ShaderResource)
                               .setKeepInitialState(true));
}

void submit(nvrhi::IDevice& rhi, nvrhi::ICommandList* commands) {
  commands->close();
  rhi.executeCommandList(commands);
  rhi.waitForIdle();
  rhi.runGarbageCollection();
}

/// Let NVRHI fill a texture.
void write(nvrhi::ICommandList* commands, nvrhi::ITexture* texture, const std::vector<float>& values) {
  commands->writeTexture(texture, 0, 0, values.data(), values.size() * sizeof(float) / texture->getDesc().height);
}

/// A denoiser in one command list a frame: NVRHI fills the inputs, walr denoises, NVRHI copies the results.
class NvrhiDenoised : public HostedCall {
 public:
  NvrhiDenoised(nvrhi::IDevice& rhi, nvrhi::vulkan::IDevice& backend, const WalrApi& api, const WalrDenoiserInfo& info,
                const char* view)
      : HostedCall(api, info, view),
        rhi_(&rhi),
        backend_(&backend),
        adapter_(denoiser(), {api.record, api.forget_image, api.last_error}) {
    makeTextures();
  }
  ~NvrhiDenoised() override {
    forgetTextures();
    destroyDenoiser();
  }

  void frame(const Inputs& inputs, const WalrPassFrame& like, bool reset) override {
    const nvrhi::CommandListHandle commands = rhi_->createCommandList();
    commands->open();
    for (const auto& [name, values] : inputs) write(commands, textures_.at(name), values);
    std::string refused;
    try {
      record(commands, frameLike(like, reset ? WALR_FRAME_RESET_HISTORY : 0));
      copyOut(commands);
    } catch (const std::runtime_error& error) {
      refused = error.what();
    }
    submit(*rhi_, commands);
    if (!refused.empty()) throw std::runtime_error(refused);
  }
  Texels read(const std::string& name) override {
    nvrhi::IStagingTexture* staging = copies_.at(name);
    const nvrhi::TextureDesc& desc = staging->getDesc();
    std::size_t pitch = 0;
    const auto* bytes = static_cast<const std::byte*>(
        rhi_->mapStagingTexture(staging, nvrhi::TextureSlice(), nvrhi::CpuAccessMode::Read, &pitch));
    const std::size_t row = std::size_t(nvrhi::getFormatInfo(desc.format).bytesPerBlock) * desc.width;
    Texels values(row * desc.height / sizeof(std::uint16_t));
    for (std::uint32_t y = 0; y < desc.height; ++y)
      std::memcpy(reinterpret_cast<std::byte*>(values.data()) + y * row, bytes + y * pitch, row);
    rhi_->unmapStagingTexture(staging);
    return values;
  }
  /// NVRHI numbers its submissions and raises a semaphore to these numbers.
  std::pair<VkSemaphore, std::uint64_t> nextCompletion() override {
    constexpr auto kQueue = nvrhi::CommandQueue::Graphics;
    return {backend_->getQueueSemaphore(kQueue), backend_->queueGetCompletedInstance(kQueue) + 1};
  }

  void resize(Size size) {
    forgetTextures();
    require(api().resize(denoiser(), size.width, size.height));
    makeTextures(size);
  }

 private:
  void record(nvrhi::ICommandList* commands, const WalrFrame& frame) const {
    walr::adapters::NvrhiTextures given;
    given.lighting = textures_.at("lighting");
    given.depth = textures_.at("depth");
    given.normal = textures_.at("normal");
    given.motion = textures_.at("motion");
    given.albedo = textures_.at("albedo");
    if (textures_.contains("specular_albedo")) given.specularAlbedo = textures_.at("specular_albedo");
    if (textures_.contains("roughness")) given.roughness = textures_.at("roughness");
    if (textures_.contains("specular_motion")) given.specularMotion = textures_.at("specular_motion");
    given.denoised = textures_.at("denoised");
    if (textures_.contains("confidence")) given.confidence = textures_.at("confidence");
    if (textures_.contains("history_length")) given.historyLength = textures_.at("history_length");
    if (textures_.contains("view")) given.view = textures_.at("view");
    if (textures_.contains("second_lighting")) given.secondLighting = textures_.at("second_lighting");
    if (textures_.contains("second_denoised")) given.secondDenoised = textures_.at("second_denoised");
    adapter_.record(commands, given, frame);
  }
  void copyOut(nvrhi::ICommandList* commands) {
    for (const NeededImage& image : needed()) {
      if (!image.written()) continue;
      nvrhi::ITexture* texture = textures_.at(image.name);
      copies_[image.name] = rhi_->createStagingTexture(texture->getDesc(), nvrhi::CpuAccessMode::Read);
      commands->copyTexture(copies_[image.name], nvrhi::TextureSlice(), texture, nvrhi::TextureSlice());
    }
  }
  void makeTextures(std::optional<Size> size = {}) {
    for (const NeededImage& image : needed()) {
      textures_[image.name] = makeTexture(*rhi_, image.format, size.value_or(image.size), image.written());
    }
  }
  void forgetTextures() {
    for (const auto& [name, texture] : textures_) adapter_.forget(texture);
    textures_.clear();
  }

  nvrhi::IDevice* rhi_;
  nvrhi::vulkan::IDevice* backend_;
  walr::adapters::NvrhiDenoiser adapter_;
  std::map<std::string, nvrhi::TextureHandle> textures_;
  std::map<std::string, nvrhi::StagingTextureHandle> copies_;
};

class Nvrhi : public ConformanceTest {
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
    backend_ = nvrhi::vulkan::createDevice(desc);
    ASSERT_TRUE(backend_);
    rhi_ = nvrhi::validation::createValidationLayer(backend_);
  }
  void TearDown() override {
    rhi_ = nullptr;
    backend_ = nullptr;
    PluginTest::TearDown();
  }

  std::unique_ptr<HostedDenoiser> make(const WalrDenoiserInfo& info, const char* view) override {
    return hosted(info, view);
  }
  [[nodiscard]] std::unique_ptr<NvrhiDenoised> hosted(const WalrDenoiserInfo& info, const char* view = nullptr) {
    return std::make_unique<NvrhiDenoised>(*rhi_, *backend_, api(), info, view);
  }

  /// Compare seven frames, with a reset and a new size, with those of a plain Vulkan host.
  void compare(const char* method) {
    Size size{61, 43};
    auto opaque = std::make_unique<Opaque>(host, api(), info(method, size));
    const auto denoiser = hosted(info(method, size));
    for (std::uint32_t number = 0; number < 7; ++number) {
      SCOPED_TRACE(std::string(method) + ", frame " + std::to_string(number));
      const bool resized = number == 4;
      if (resized) {
        size = {40, 45};
        denoiser->resize(size);
        // A dropped history does not restart frame numbers or forget the camera.
        opaque = std::make_unique<Opaque>(host, api(), info(method, size));
        uploadFrame(host, size, number, [&](std::size_t i) { return &opaque->image(i); });
        for (std::uint32_t before = 0; before < number; ++before) opaque->frame(cameraAt(float(before) * kStep), 0);
      }
      constexpr std::uint32_t kReset = WALR_FRAME_RESET_HISTORY;
      const bool reset = number == 2;
      const WalrCamera camera = cameraAt(float(number) * kStep);
      uploadFrame(host, size, number, [&](std::size_t i) { return &opaque->image(i); });
      opaque->frame(camera, resized || reset ? kReset : 0);
      Inputs inputs;
      for (const char* name : kInputs) inputs[name] = texels(name, size, number);
      denoiser->frame(inputs, passFrame(camera), reset);
      EXPECT_EQ(denoiser->read("denoised"), download(host, opaque->output()));
    }
  }

  Complaints complaints_;
  nvrhi::vulkan::DeviceHandle backend_;
  nvrhi::DeviceHandle rhi_;
};

class NvrhiFeatures : public Nvrhi, public testing::WithParamInterface<Feature> {};

TEST_P(NvrhiFeatures, GiveThePixelsOfAPlainHost) {
  check(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Every, NvrhiFeatures, testing::ValuesIn(features()), nameOfFeature);

TEST_F(Nvrhi, EveryMethodGivesTheSamePixelsThroughResetAndResize) {
  for (const WalrPassType* type : registered.types)
    if (type->method == VK_TRUE) compare(type->name);
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
  walr::adapters::NvrhiTextures textures;
  const nvrhi::TextureHandle lighting = makeTexture(*rhi_, described.lighting_format, kSize, false);
  textures.lighting = lighting;
  try {
    adapter.record(commands, textures, frameLike(passFrame(camera), 0));
    FAIL() << "no depth";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("depth"), std::string::npos) << error.what();
  }
  submit(*rhi_, commands);
  require(api().destroy_denoiser(denoiser));
}

// Shows that the other tests would report missing barriers.
TEST_F(Nvrhi, ValidationReportsHazardsWithoutTheAdaptersStates) {
  constexpr Size kSize{64, 48};
  const WalrDenoiserInfo described = info("walr", kSize);
  WalrDenoiser denoiser = nullptr;
  require(api().create_denoiser(&described, &denoiser));
  const std::vector<NeededImage> needed = neededImages(api(), denoiser, described, false);
  const nvrhi::CommandListHandle commands = rhi_->createCommandList();
  commands->open();
  const WalrCamera camera = cameraAt(0);
  WalrFrame frame = frameLike(passFrame(camera), 0);
  std::vector<nvrhi::TextureHandle> textures;
  std::vector<WalrImage> images(needed.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    const bool output = needed[i].written();
    textures.push_back(makeTexture(*rhi_, needed[i].format, kSize, output));
    images[i].struct_size = sizeof(WalrImage);
    images[i].queue_family = VK_QUEUE_FAMILY_IGNORED;
    images[i].image = textures[i]->getNativeObject(nvrhi::ObjectTypes::VK_Image);
    images[i].format = needed[i].format;
    images[i].usage = VK_IMAGE_USAGE_SAMPLED_BIT | (output ? VK_IMAGE_USAGE_STORAGE_BIT : 0);
    images[i].width = kSize.width;
    images[i].height = kSize.height;
    // The layout is right, but the last write is not stated.
    images[i].acquire.layout = output ? VK_IMAGE_LAYOUT_UNDEFINED : VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    images[i].release = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT,
                         output ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0};
    imageOf(frame, needed[i].name) = &images[i];
    // Leaves it in the state of a copy's destination.
    if (!output) write(commands, textures[i], texels(needed[i].name, kSize, 0));
  }
  const VkCommandBuffer buffer = commands->getNativeObject(nvrhi::ObjectTypes::VK_CommandBuffer);
  require(api().record(denoiser, buffer, &frame));
  submit(*rhi_, commands);
  EXPECT_EQ(host.messages, std::ssize(kInputs));
  host.messages = 0;
  require(api().destroy_denoiser(denoiser));
}

}  // namespace
}  // namespace plugin_host
