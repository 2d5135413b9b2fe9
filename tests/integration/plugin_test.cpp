// The plug-in in a host that was not built with walr: it links none of it and opens the shared library while it runs.
// The same frames go through the whole method in one opaque pass and, pass by pass, through a graph of the host's own.
#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "list_host.h"
#include "tiny_host.h"

namespace {

constexpr const char* kInputs[] = {"lighting", "depth", "normal", "motion", "albedo"};

struct Size {
  std::uint32_t width;
  std::uint32_t height;
};

/// What the plug-in handed over.
struct Registered {
  const WalrApi* api = nullptr;
  std::vector<const WalrPassType*> types;
};

VkBool32 takeApi(void* user, const WalrApi* api) {
  static_cast<Registered*>(user)->api = api;
  return VK_TRUE;
}
VkBool32 takeType(void* user, const WalrPassType* type) {
  static_cast<Registered*>(user)->types.push_back(type);
  return VK_TRUE;
}

class Plugin {
 public:
  Plugin() : library_(dlopen(WALR_PLUGIN, RTLD_NOW | RTLD_LOCAL)) {
    if (library_ == nullptr) throw std::runtime_error(dlerror());
    register_ = reinterpret_cast<WalrRegisterPlugin>(dlsym(library_, "walr_register_plugin"));
    if (register_ == nullptr) throw std::runtime_error(dlerror());
  }
  ~Plugin() { dlclose(library_); }
  Plugin(const Plugin&) = delete;
  Plugin& operator=(const Plugin&) = delete;

  [[nodiscard]] WalrResult registerWith(const WalrRegistryHost* host) const { return register_(host); }

 private:
  void* library_;
  WalrRegisterPlugin register_ = nullptr;
};

class PluginTest : public testing::Test {
 protected:
  void SetUp() override {
    host_open(&host);
    const WalrRegistryHost registry{sizeof(WalrRegistryHost), 0, &registered, takeApi, takeType};
    ASSERT_EQ(plugin.registerWith(&registry), WALR_SUCCESS);
    device.struct_size = sizeof(device);
    device.queue_family = host.queue_family;
    device.instance = host.instance;
    device.physical_device = host.physical_device;
    device.device = host.device;
    device.get_instance_proc_addr = vkGetInstanceProcAddr;
  }
  void TearDown() override { EXPECT_EQ(host_close(&host), 0) << "validation messages"; }

  [[nodiscard]] const WalrApi& api() const { return *registered.api; }
  void require(WalrResult result) const {
    if (result != WALR_SUCCESS) throw std::runtime_error(api().last_error());
  }

  [[nodiscard]] WalrDenoiserInfo info(const char* method, Size size) const {
    WalrDenoiserInfo info{};
    info.struct_size = sizeof(info);
    info.device = &device;
    info.method = method;
    info.width = size.width;
    info.height = size.height;
    // So that a host without halves can fill them.
    info.lighting_format = info.normal_format = info.motion_format = info.albedo_format = VK_FORMAT_R32G32B32A32_SFLOAT;
    return info;
  }
  [[nodiscard]] WalrPasses makePasses(const char* method, Size size) const {
    const WalrDenoiserInfo denoiser = info(method, size);
    WalrPassesInfo passesInfo{};
    passesInfo.struct_size = sizeof(passesInfo);
    passesInfo.denoiser = &denoiser;
    WalrPasses passes = nullptr;
    require(api().create_passes(&passesInfo, &passes));
    return passes;
  }

  Plugin plugin;
  Host host{};
  WalrDevice device{};
  Registered registered;
};

WalrCamera cameraAt(float x) {
  return {.view = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, 0, 0, 1},
          .projection = {1.5F, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1, -1, 0, 0, -0.1F, 0},
          .jitter = {0, 0}};
}

constexpr float kStep = 0.05F;  ///< Scene units that the camera moves to the right each frame.

/// Texels of an input: a slanted wall behind a nearer square, seen by a camera that moves to the right, noisy light.
std::vector<float> texels(const std::string& name, Size size, std::uint32_t frame) {
  std::vector<float> result;
  std::uint32_t random = 12345 + frame * 977;
  for (std::uint32_t y = 0; y < size.height; ++y) {
    for (std::uint32_t x = 0; x < size.width; ++x) {
      const float u = (float(x) + 0.5F) / float(size.width) * 2.0F - 1.0F;
      const float v = (float(y) + 0.5F) / float(size.height) * 2.0F - 1.0F;
      const bool near = std::abs(u) < 0.4F && std::abs(v) < 0.5F;
      const float depth = near ? 3.0F : 6.0F + 0.5F * v;
      if (name == "depth") {
        result.push_back(depth);
        continue;
      }
      float texel[4] = {0, 0, 0, 0};
      if (name == "normal") texel[2] = 1.0F;
      // A point at view depth d moves by focal * step / d of half the picture's width.
      if (name == "motion") texel[0] = 1.5F * kStep / depth * 0.5F * float(size.width);
      if (name == "albedo") texel[0] = texel[1] = texel[2] = v > 0.9F ? 0.0F : 0.5F;
      if (name == "lighting") {
        for (int c = 0; c < 3; ++c) {
          random = random * 1664525U + 1013904223U;
          texel[c] = (near ? 0.5F : 1.0F + u) * -std::log(float((random >> 8) + 1) * 0x1p-24F);
        }
      }
      result.insert(result.end(), texel, texel + 4);
    }
  }
  return result;
}

/// The whole method as one opaque pass in the host's command buffer.
class Opaque {
 public:
  Opaque(Host& host, const WalrApi& api, const WalrDenoiserInfo& info) : host_(&host), api_(&api) {
    if (api.create_denoiser(&info, &denoiser_) != WALR_SUCCESS) throw std::runtime_error(api.last_error());
    for (const char* name : {"lighting", "depth", "normal", "motion", "albedo", "denoised"}) {
      WalrImageRequirements needs{};
      needs.struct_size = sizeof(needs);
      if (api.get_image_requirements(denoiser_, name, &needs) != WALR_SUCCESS) {
        throw std::runtime_error(api.last_error());
      }
      const std::uint32_t texel = std::string(name) == "depth" ? 4 : std::string(name) == "denoised" ? 8 : 16;
      images_.push_back(host_make_image(&host, needs.format, texel, needs.width, needs.height,
                                        needs.usage | VK_IMAGE_USAGE_SAMPLED_BIT));
    }
  }
  ~Opaque() {
    api_->destroy_denoiser(denoiser_);
    for (HostImage& image : images_) host_destroy_image(host_, &image);
  }
  Opaque(const Opaque&) = delete;
  Opaque& operator=(const Opaque&) = delete;

  [[nodiscard]] WalrDenoiser denoiser() const { return denoiser_; }
  HostImage& image(std::size_t index) { return images_[index]; }
  HostImage& output() { return images_.back(); }

  void frame(const WalrCamera& camera, std::uint32_t flags) {
    std::vector<WalrImage> images;
    for (const HostImage& image : images_) {
      WalrImage& given = images.emplace_back();
      given.struct_size = sizeof(given);
      given.queue_family = VK_QUEUE_FAMILY_IGNORED;
      given.image = image.image;
      given.format = image.format;
      given.usage = image.usage;
      given.width = image.width;
      given.height = image.height;
      given.acquire = {image.stage, image.access, image.layout, 0};
    }
    WalrFrame frame{};
    frame.struct_size = sizeof(frame);
    frame.flags = flags;
    frame.lighting = &images[0];
    frame.depth = &images[1];
    frame.normal = &images[2];
    frame.motion = &images[3];
    frame.albedo = &images[4];
    frame.denoised = &images[5];
    frame.camera = &camera;
    const VkCommandBuffer commands = host_begin(host_);
    if (api_->record(denoiser_, commands, &frame) != WALR_SUCCESS) throw std::runtime_error(api_->last_error());
    host_submit_and_wait(host_, commands);
    for (std::size_t i = 0; i < images_.size(); ++i) {
      WalrImageState state{};
      const char* name = i < 5 ? kInputs[i] : "denoised";
      if (api_->get_release_state(denoiser_, name, &state) != WALR_SUCCESS) continue;  // Not touched.
      images_[i].stage = state.stage;
      images_[i].access = state.access;
      images_[i].layout = state.layout;
    }
  }

 private:
  Host* host_;
  const WalrApi* api_;
  WalrDenoiser denoiser_ = nullptr;
  std::vector<HostImage> images_;
};

std::vector<std::uint16_t> download(Host& host, HostImage& image) {
  std::vector<std::uint16_t> result(std::size_t{4} * image.width * image.height);
  host_download(&host, &image, result.data());
  return result;
}

TEST_F(PluginTest, RegistersEveryPassTypeAndAnApiOfItsOwnSize) {
  EXPECT_EQ(api().struct_size, sizeof(WalrApi));
  EXPECT_EQ(registered.types.size(), api().pass_type_count());
  EXPECT_NE(std::string(api().version()), "");
  const auto* const* functions = reinterpret_cast<void* const*>(&api().version);
  for (std::size_t i = 0; i < (sizeof(WalrApi) - offsetof(WalrApi, version)) / sizeof(void*); ++i) {
    EXPECT_NE(functions[i], nullptr) << i;
  }
}

TEST_F(PluginTest, RefusesAHostThatItCannotServe) {
  WalrRegistryHost registry{sizeof(WalrRegistryHost), 0, &registered, nullptr, takeType};
  EXPECT_EQ(plugin.registerWith(nullptr), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(plugin.registerWith(&registry), WALR_ERROR_INVALID_ARGUMENT);
  registry.struct_size = 8;
  EXPECT_EQ(plugin.registerWith(&registry), WALR_ERROR_STRUCT_SIZE);
  registry.struct_size = sizeof(registry);
  registry.register_api = [](void*, const WalrApi*) -> VkBool32 { return VK_FALSE; };
  EXPECT_EQ(plugin.registerWith(&registry), WALR_ERROR_WRONG_ORDER);
  registry.register_api = takeApi;
  registry.register_pass_type = [](void*, const WalrPassType*) -> VkBool32 { return VK_FALSE; };
  EXPECT_EQ(plugin.registerWith(&registry), WALR_ERROR_WRONG_ORDER);
  EXPECT_NE(std::string(api().last_error()).find("prepare_guides"), std::string::npos);
}

/// Every input of a frame, by name.
template <typename ImageOf>
void uploadFrame(Host& host, Size size, std::uint32_t frame, ImageOf imageOf) {
  for (std::size_t i = 0; i < std::size(kInputs); ++i) {
    host_upload(&host, imageOf(i), texels(kInputs[i], size, frame).data());
  }
}

WalrPassFrame passFrame(const WalrCamera& camera) {
  WalrPassFrame frame{};
  frame.struct_size = sizeof(frame);
  frame.camera = &camera;
  return frame;
}

TEST_F(PluginTest, EveryMethodGivesTheSamePixelsPassByPass) {
  for (const WalrPassType* type : registered.types) {
    if (type->method == VK_FALSE) continue;
    for (const Size size : {Size{61, 43}, Size{40, 45}}) {
      const WalrDenoiserInfo whole = info(type->name, size);
      Opaque opaque(host, api(), whole);
      const WalrPasses passes = makePasses(type->name, size);
      {
        tiny_host::Graph graph(host, api(), passes);
        for (std::uint32_t frame = 0; frame < 5; ++frame) {
          SCOPED_TRACE(std::string(type->name) + ", frame " + std::to_string(frame));
          uploadFrame(host, size, frame, [&](std::size_t i) { return &opaque.image(i); });
          uploadFrame(host, size, frame, [&](std::size_t i) { return &graph.image(kInputs[i]); });
          const bool reset = frame == 3;
          const WalrCamera camera = cameraAt(float(frame) * kStep);
          opaque.frame(camera, reset ? WALR_FRAME_RESET_HISTORY : 0);
          if (reset) graph.resetHistory();
          graph.frame(passFrame(camera));
          const std::vector<std::uint16_t> result = download(host, graph.image("denoised"));
          EXPECT_EQ(result, download(host, opaque.output()));
          EXPECT_GT(std::ranges::count_if(result, [](std::uint16_t half) { return half != 0; }), result.size() / 2);
        }
      }
      EXPECT_EQ(api().destroy_passes(passes), WALR_SUCCESS);
    }
  }
}

TEST_F(PluginTest, EveryMethodGivesTheSamePixelsAsADispatchListWithItsHeapsAndBarriers) {
  constexpr Size kSize{61, 43};
  for (const WalrPassType* type : registered.types) {
    if (type->method == VK_FALSE) continue;
    Opaque opaque(host, api(), info(type->name, kSize));
    const WalrPasses passes = makePasses(type->name, kSize);
    {
      list_host::Player player(host, api(), passes);
      for (std::uint32_t frame = 0; frame < 4; ++frame) {
        SCOPED_TRACE(std::string(type->name) + ", frame " + std::to_string(frame));
        uploadFrame(host, kSize, frame, [&](std::size_t i) { return &opaque.image(i); });
        uploadFrame(host, kSize, frame, [&](std::size_t i) { return &player.image(kInputs[i]); });
        const WalrCamera camera = cameraAt(float(frame) * kStep);
        opaque.frame(camera, 0);
        player.frame(passFrame(camera));
        EXPECT_EQ(download(host, player.image("denoised")), download(host, opaque.output()));
      }
    }
    EXPECT_EQ(api().destroy_passes(passes), WALR_SUCCESS);
  }
}

// Pixels say nothing about barriers here, so that validation must; and it must be on.
TEST_F(PluginTest, AHostWithoutBarriersIsFoundOut) {
  const WalrPasses passes = makePasses("walr", {64, 48});
  {
    tiny_host::Graph graph(host, api(), passes);
    uploadFrame(host, {64, 48}, 0, [&](std::size_t i) { return &graph.image(kInputs[i]); });
    const WalrCamera camera = cameraAt(0);
    const WalrPassFrame frame = passFrame(camera);
    graph.frame(frame);
    EXPECT_EQ(host.messages, 0);
    graph.leaveOutReadBarriers();
    graph.frame(frame);
    EXPECT_GT(host.messages, 0);
  }
  EXPECT_EQ(api().destroy_passes(passes), WALR_SUCCESS);
  host.messages = 0;
}

// The figures are in the integration guide: what a host pays that shares no memory between our passes.
TEST_F(PluginTest, MemoryOfBothWaysIsWhatTheDriverSays) {
  constexpr double kMebibyte = 1024.0 * 1024.0;
  std::ifstream file(WALR_GUIDE);
  const std::string guide{std::istreambuf_iterator<char>(file), {}};
  for (const Size size : {Size{1920, 1080}, Size{2560, 1440}, Size{3840, 2160}}) {
    const WalrDenoiserInfo whole = info("walr", size);
    WalrDenoiser denoiser = nullptr;
    require(api().create_denoiser(&whole, &denoiser));
    require(api().prepare(denoiser));
    WalrMemory memory{};
    memory.struct_size = sizeof(memory);
    require(api().get_memory(denoiser, &memory));
    require(api().destroy_denoiser(denoiser));
    const WalrPasses passes = makePasses("walr", size);
    {
      const tiny_host::Graph graph(host, api(), passes);
      EXPECT_EQ(graph.bytes(), graph.listedBytes());
      EXPECT_EQ(graph.listedBytes(), memory.persistent + memory.transient_unaliased);
      EXPECT_LT(memory.allocated, graph.bytes());
      char row[128];
      std::snprintf(row, sizeof(row), "| %u x %u | %.1f | %.1f |\n", size.width, size.height,
                    double(memory.allocated) / kMebibyte, double(graph.bytes()) / kMebibyte);
      EXPECT_NE(guide.find(row), std::string::npos) << "integration/README.md should say " << row;
    }
    EXPECT_EQ(api().destroy_passes(passes), WALR_SUCCESS);
  }
}

TEST_F(PluginTest, WrongUseOfPassesIsAnError) {
  const WalrPasses passes = makePasses("walr", {64, 48});
  const WalrPassList* list = nullptr;
  ASSERT_EQ(api().get_pass_list(passes, &list), WALR_SUCCESS);
  const VkCommandBuffer commands = host_begin(&host);
  std::vector<WalrPassResource> none(list->passes[0]->binding_count);
  const auto count = static_cast<std::uint32_t>(none.size());
  const auto text = [&] { return std::string(api().last_error()); };
  EXPECT_EQ(api().get_pass_list(passes, nullptr), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(api().record_pass(passes, 0, commands, none.data(), count), WALR_ERROR_WRONG_ORDER);
  EXPECT_NE(text().find("walr_begin_frame"), std::string::npos);
  WalrPassFrame frame{};
  frame.struct_size = sizeof(frame);
  EXPECT_EQ(api().begin_frame(passes, &frame), WALR_ERROR_INVALID_ARGUMENT);
  const WalrCamera camera = cameraAt(0);
  frame.camera = &camera;
  EXPECT_EQ(api().begin_frame(passes, &frame), WALR_SUCCESS);
  EXPECT_EQ(api().record_pass(passes, 99, commands, none.data(), count), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(api().record_pass(passes, 0, VK_NULL_HANDLE, none.data(), count), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(api().record_pass(passes, 0, commands, nullptr, count), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(api().record_pass(passes, 0, commands, none.data(), 1), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(api().record_pass(passes, 0, commands, none.data(), count), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_NE(text().find("null VkImage"), std::string::npos) << text();
  EXPECT_EQ(api().forget_pass_image(passes, VK_NULL_HANDLE, 0), WALR_ERROR_INVALID_ARGUMENT);
  host_submit_and_wait(&host, commands);
  EXPECT_EQ(api().destroy_passes(passes), WALR_SUCCESS);
  EXPECT_EQ(api().destroy_passes(passes), WALR_ERROR_INVALID_HANDLE);
  EXPECT_EQ(api().begin_frame(passes, &frame), WALR_ERROR_INVALID_HANDLE);

  // Without a device passes can be listed, and that is all.
  WalrDenoiserInfo listed = info("walr", {64, 48});
  listed.device = nullptr;
  const WalrSettingValue settings[] = {{"regression.iterations", "9"}};
  WalrPassesInfo passesInfo{sizeof(WalrPassesInfo), 1, &listed, settings};
  WalrPasses plain = nullptr;
  EXPECT_EQ(api().create_passes(&passesInfo, &plain), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_NE(text().find("1..5"), std::string::npos);
  passesInfo.setting_count = 0;
  ASSERT_EQ(api().create_passes(&passesInfo, &plain), WALR_SUCCESS);
  ASSERT_EQ(api().get_pass_list(plain, &list), WALR_SUCCESS);
  std::uint32_t upload = 0;
  while (list->resources[upload]->kind != WALR_RESOURCE_UPLOAD) ++upload;
  std::size_t size = 0;
  EXPECT_EQ(api().get_frame_constants(plain, upload, nullptr, &size), WALR_ERROR_WRONG_ORDER);
  EXPECT_EQ(api().begin_frame(plain, &frame), WALR_SUCCESS);
  EXPECT_EQ(api().get_frame_constants(plain, upload + 1, nullptr, &size), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(api().get_frame_constants(plain, upload, nullptr, &size), WALR_SUCCESS);
  EXPECT_EQ(size, list->resources[upload]->buffer_size);
  EXPECT_EQ(api().record_pass(plain, 0, commands, none.data(), count), WALR_ERROR_WRONG_ORDER);
  EXPECT_NE(text().find("without a device"), std::string::npos);
  EXPECT_EQ(api().destroy_passes(plain), WALR_SUCCESS);
}

}  // namespace
