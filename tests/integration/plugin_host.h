#pragma once

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <walr/walr_plugin.h>

#include "host/vulkan_host.h"

/// Hosts that do not link walr and load the plug-in at run time.
namespace plugin_host {

inline constexpr const char* kInputs[] = {"lighting", "depth", "normal", "motion", "albedo"};

struct Size {
  std::uint32_t width;
  std::uint32_t height;
};

/// A frame of six images: the inputs in the order of `kInputs`, then the denoised one.
inline WalrFrame frameOf(const std::vector<WalrImage>& images, const WalrCamera& camera, std::uint32_t flags = 0) {
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
  return frame;
}

/// What the plug-in registered.
struct Registered {
  const WalrApi* api = nullptr;
  std::vector<const WalrPassType*> types;
};

inline VkBool32 takeApi(void* user, const WalrApi* api) {
  static_cast<Registered*>(user)->api = api;
  return VK_TRUE;
}
inline VkBool32 takeType(void* user, const WalrPassType* type) {
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
    openHost();
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

  virtual void openHost() { host_open(&host); }

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
    // 32-bit floats, so that hosts need not convert to halves.
    info.lighting_format = info.normal_format = info.motion_format = info.albedo_format = VK_FORMAT_R32G32B32A32_SFLOAT;
    return info;
  }
  /// The same with the host's confidence in history, and with history lengths.
  [[nodiscard]] WalrDenoiserInfo infoWithHistory(const char* method, Size size) const {
    WalrDenoiserInfo result = info(method, size);
    result.confidence_format = VK_FORMAT_R32_SFLOAT;
    result.history_length = VK_TRUE;
    return result;
  }
  [[nodiscard]] WalrPasses makePasses(const char* method, Size size) const { return makePasses(info(method, size)); }
  [[nodiscard]] WalrPasses makePasses(const WalrDenoiserInfo& denoiser,
                                      std::span<const WalrSettingValue> settings = {}) const {
    WalrPassesInfo passesInfo{};
    passesInfo.settings = settings.data();
    passesInfo.setting_count = static_cast<std::uint32_t>(settings.size());
    passesInfo.struct_size = sizeof(passesInfo);
    passesInfo.denoiser = &denoiser;
    WalrPasses passes = nullptr;
    require(api().create_passes(&passesInfo, &passes));
    return passes;
  }
  /// Check `expectSameHistory` and `expectSameStatements` for a way to run passes: a class that is made from the host,
  /// the functions of the C API and passes, and has image(name), resetHistory() and frame(WalrPassFrame).
  template <typename Way>
  void expectTheHistoryOfTheOpaqueCall();
  template <typename Way>
  void expectTheStatementsOfTheOpaqueCall();
  /// The same while the host alternates between passes of several sizes. The way also has goOnFrom(Way&).
  /// @param turns by frame: index of its size
  template <typename Way>
  void expectTheOpaqueCallAtSizes(std::span<const Size> sizes, std::span<const std::size_t> turns);

  /// The methods that keep a history of light.
  [[nodiscard]] std::vector<const char*> methodsWithHistory() const {
    std::vector<const char*> names;
    for (const WalrPassType* type : registered.types)
      if (type->method == VK_TRUE && std::string(type->name) != "none") names.push_back(type->name);
    return names;
  }

  Plugin plugin;
  Host host{};
  WalrDevice device{};
  Registered registered;

 private:
  template <typename Way, typename Use>
  void withPasses(const WalrDenoiserInfo& denoiser, Use use) {
    const WalrPasses passes = makePasses(denoiser);
    {
      Way way(host, api(), passes);
      use(way);
    }
    EXPECT_EQ(api().destroy_passes(passes), WALR_SUCCESS);
  }
};

inline WalrCamera cameraAt(float x) {
  return {.view = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, 0, 0, 1},
          .projection = {1.5F, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1, -1, 0, 0, -0.1F, 0},
          .jitter = {0, 0}};
}

inline constexpr float kStep = 0.05F;  ///< The camera's movement to the right per frame, in scene units.

/// Texels of an input: a slanted wall behind a nearer square, seen by a camera that moves to the right, noisy light.
/// The host trusts history in the right half only.
inline std::vector<float> texels(const std::string& name, Size size, std::uint32_t frame) {
  std::vector<float> result;
  std::uint32_t random = 12345 + frame * 977;
  for (std::uint32_t y = 0; y < size.height; ++y) {
    for (std::uint32_t x = 0; x < size.width; ++x) {
      const float u = (float(x) + 0.5F) / float(size.width) * 2.0F - 1.0F;
      const float v = (float(y) + 0.5F) / float(size.height) * 2.0F - 1.0F;
      const bool near = std::abs(u) < 0.4F && std::abs(v) < 0.5F;
      const float depth = near ? 3.0F : 6.0F + 0.5F * v;
      if (name == "depth" || name == "confidence") {
        result.push_back(name == "depth" ? depth : u < 0.0F ? 0.0F : 0.75F);
        continue;
      }
      float texel[4] = {0, 0, 0, 0};
      if (name == "normal") texel[2] = 1.0F;
      // A point at view depth d moves by focal * step / d times half the image's width.
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
    if (info.confidence_format != VK_FORMAT_UNDEFINED) names_.emplace_back("confidence");
    if (info.history_length == VK_TRUE) names_.emplace_back("history_length");
    if (api.create_denoiser(&info, &denoiser_) != WALR_SUCCESS) throw std::runtime_error(api.last_error());
    makeImages();
  }
  ~Opaque() {
    api_->destroy_denoiser(denoiser_);
    destroyImages();
  }
  Opaque(const Opaque&) = delete;
  Opaque& operator=(const Opaque&) = delete;

  [[nodiscard]] WalrDenoiser denoiser() const { return denoiser_; }
  HostImage& image(std::size_t index) { return images_[index]; }
  HostImage& output() { return images_.at(5); }
  /// An image after the six: confidence and history lengths, if the denoiser has them.
  HostImage& further(const std::string& name) {
    for (std::size_t i = 6; i < names_.size(); ++i)
      if (names_[i] == name) return images_[i];
    throw std::out_of_range(name);
  }

  /// Change the size and create images of that size.
  void resize(Size size) {
    for (const HostImage& image : images_) api_->forget_image(denoiser_, image.image, 0);
    destroyImages();
    if (api_->resize(denoiser_, size.width, size.height) != WALR_SUCCESS) throw std::runtime_error(api_->last_error());
    makeImages();
  }

  /// @param index with WALR_FRAME_INDEX_GIVEN
  void frame(const WalrCamera& camera, std::uint32_t flags, std::uint32_t index = 0) {
    WalrPassFrame frame{};
    frame.camera = &camera;
    frame.frame_index = index;
    this->frame(frame, flags);
  }
  /// @param like what a frame has in common with one pass by pass
  void frame(const WalrPassFrame& like, std::uint32_t flags) {
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
    WalrFrame frame = frameOf(images, *like.camera, flags);
    frame.frame_index = like.frame_index;
    std::ranges::copy(like.origin, frame.origin);
    for (std::size_t i = 6; i < names_.size(); ++i) {
      (names_[i] == "confidence" ? frame.confidence : frame.history_length) = &images[i];
    }
    const VkCommandBuffer commands = host_begin(host_);
    if (api_->record(denoiser_, commands, &frame) != WALR_SUCCESS) throw std::runtime_error(api_->last_error());
    host_submit_and_wait(host_, commands);
    for (std::size_t i = 0; i < images_.size(); ++i) {
      WalrImageState state{};
      if (api_->get_release_state(denoiser_, names_[i].c_str(), &state) != WALR_SUCCESS) continue;  // Unused.
      images_[i].stage = state.stage;
      images_[i].access = state.access;
      images_[i].layout = state.layout;
    }
  }

 private:
  void makeImages() {
    for (const std::string& name : names_) {
      WalrImageRequirements needs{};
      needs.struct_size = sizeof(needs);
      if (api_->get_image_requirements(denoiser_, name.c_str(), &needs) != WALR_SUCCESS) {
        throw std::runtime_error(api_->last_error());
      }
      images_.push_back(
          host_make_image(host_, needs.format, needs.width, needs.height, needs.usage | VK_IMAGE_USAGE_SAMPLED_BIT));
    }
  }
  void destroyImages() {
    for (HostImage& image : images_) host_destroy_image(host_, &image);
    images_.clear();
  }

  Host* host_;
  const WalrApi* api_;
  WalrDenoiser denoiser_ = nullptr;
  std::vector<std::string> names_{"lighting", "depth", "normal", "motion", "albedo", "denoised"};  ///< Of the images.
  std::vector<HostImage> images_;
};

/// All texels of an image of halves.
inline std::vector<std::uint16_t> download(Host& host, HostImage& image) {
  std::vector<std::uint16_t> result(image.texel_size / sizeof(std::uint16_t) * image.width * image.height);
  host_download(&host, &image, result.data());
  return result;
}

/// All inputs of a frame, by name.
template <typename ImageOf>
void uploadFrame(Host& host, Size size, std::uint32_t frame, ImageOf imageOf) {
  for (std::size_t i = 0; i < std::size(kInputs); ++i) {
    host_upload(&host, imageOf(i), texels(kInputs[i], size, frame).data());
  }
}

inline WalrPassFrame passFrame(const WalrCamera& camera) {
  WalrPassFrame frame{};
  frame.struct_size = sizeof(frame);
  frame.camera = &camera;
  return frame;
}

/// Check that history is as long as the host's confidence allows: one frame in the left half, more in the right one.
inline void expectLengthsByConfidence(const std::vector<std::uint16_t>& lengths, Size size) {
  constexpr std::uint16_t kOne = 0x3c00;
  const std::uint32_t row = size.height / 2 * size.width;
  EXPECT_EQ(lengths[row + 2], kOne);
  EXPECT_GT(lengths[row + size.width * 3 / 4], kOne);
}

/// Compare five frames, with a reset, of the opaque call and of another way to run the same passes, both with the
/// host's confidence in history and with history lengths.
/// @param way has image(name), resetHistory() and frame(WalrPassFrame)
template <typename Way>
void expectSameHistory(Host& host, Opaque& opaque, Way& way, Size size) {
  for (std::uint32_t number = 0; number < 5; ++number) {
    SCOPED_TRACE("frame " + std::to_string(number));
    uploadFrame(host, size, number, [&](std::size_t i) { return &opaque.image(i); });
    uploadFrame(host, size, number, [&](std::size_t i) { return &way.image(kInputs[i]); });
    for (HostImage* const image : {&opaque.further("confidence"), &way.image("confidence")}) {
      host_upload(&host, image, texels("confidence", size, number).data());
    }
    const bool reset = number == 2;
    const WalrCamera camera = cameraAt(float(number) * kStep);
    opaque.frame(camera, reset ? WALR_FRAME_RESET_HISTORY : 0);
    if (reset) way.resetHistory();
    way.frame(passFrame(camera));
    EXPECT_EQ(download(host, way.image("denoised")), download(host, opaque.output()));
    const std::vector<std::uint16_t> lengths = download(host, way.image("history_length"));
    EXPECT_EQ(lengths, download(host, opaque.further("history_length")));
    if (number == 4) expectLengthsByConfidence(lengths, size);
  }
}

/// Something that a host states beside the usual.
struct Statement {
  const char* name;
  void (*state)(WalrDenoiserInfo& info, WalrConventions& conventions);
  bool farAway = false;  ///< The cameras are relative to an origin that moves.
};

inline constexpr Statement kStatements[] = {
    {"motion of two channels, depth found",
     [](WalrDenoiserInfo& info, WalrConventions& conventions) {
       info.motion_format = VK_FORMAT_R32G32_SFLOAT;
       conventions.motion_depth = WALR_MOTION_DEPTH_FOUND;
     }},
    {"orthographic camera",
     [](WalrDenoiserInfo&, WalrConventions& conventions) { conventions.orthographic = VK_TRUE; }},
    {"result in 32 bits",
     [](WalrDenoiserInfo& info, WalrConventions&) { info.denoised_format = VK_FORMAT_B10G11R11_UFLOAT_PACK32; }},
    {"result in floats",
     [](WalrDenoiserInfo& info, WalrConventions&) { info.denoised_format = VK_FORMAT_R32G32B32A32_SFLOAT; }},
    {"large world", [](WalrDenoiserInfo&, WalrConventions&) {}, true},
};

/// The texels of motion without its third and fourth channel.
inline std::vector<float> flatMotion(Size size, std::uint32_t frame) {
  const std::vector<float> whole = texels("motion", size, frame);
  std::vector<float> flat;
  for (std::size_t i = 0; i < whole.size(); i += 4) flat.insert(flat.end(), {whole[i], whole[i + 1]});
  return flat;
}

/// Compare four frames of the opaque call and of another way to run the same passes, for each of `kStatements`.
/// @param usual   the usual description
/// @param makeWay creates the other way from a description and hands it to its second argument
template <typename MakeWay>
void expectSameStatements(Host& host, const WalrApi& api, const WalrDenoiserInfo& usual, Size size, MakeWay makeWay) {
  for (const Statement& statement : kStatements) {
    SCOPED_TRACE(statement.name);
    WalrConventions conventions{};
    conventions.struct_size = sizeof(conventions);
    WalrDenoiserInfo stated = usual;
    stated.conventions = &conventions;
    statement.state(stated, conventions);
    Opaque opaque(host, api, stated);
    makeWay(stated, [&](auto& way) {
      for (std::uint32_t number = 0; number < 4; ++number) {
        for (const auto& imageOf : {std::function([&](std::size_t i) { return &opaque.image(i); }),
                                    std::function([&](std::size_t i) { return &way.image(kInputs[i]); })}) {
          uploadFrame(host, size, number, imageOf);
          if (stated.motion_format != usual.motion_format) {
            host_upload(&host, imageOf(3), flatMotion(size, number).data());
          }
        }
        WalrCamera camera = cameraAt(statement.farAway ? 0.0F : float(number) * kStep);
        if (conventions.orthographic == VK_TRUE) {
          constexpr float kParallel[16] = {0.5F, 0, 0, 0, 0, 0.5F, 0, 0, 0, 0, -0.01F, 0, 0, 0, 0, 1};
          std::ranges::copy(kParallel, camera.projection);
        }
        WalrPassFrame frame = passFrame(camera);
        if (statement.farAway) frame.origin[0] = 1e6 + double(number) * double(kStep);
        opaque.frame(frame, 0);
        way.frame(frame);
        const std::vector<std::uint16_t> result = download(host, way.image("denoised"));
        EXPECT_EQ(result, download(host, opaque.output())) << "frame " << number;
        EXPECT_GT(std::ranges::count_if(result, [](std::uint16_t bits) { return bits != 0; }), result.size() / 2);
      }
    });
  }
}

template <typename Way>
void PluginTest::expectTheHistoryOfTheOpaqueCall() {
  constexpr Size kSize{61, 43};
  for (const char* method : methodsWithHistory()) {
    SCOPED_TRACE(method);
    const WalrDenoiserInfo whole = infoWithHistory(method, kSize);
    Opaque opaque(host, api(), whole);
    withPasses<Way>(whole, [&](Way& way) { expectSameHistory(host, opaque, way, kSize); });
  }
}

template <typename Way>
void PluginTest::expectTheStatementsOfTheOpaqueCall() {
  constexpr Size kSize{61, 43};
  for (const char* method : {"walr", "svgf"}) {
    SCOPED_TRACE(method);
    expectSameStatements(host, api(), info(method, kSize), kSize,
                         [&](const WalrDenoiserInfo& stated, auto compare) { withPasses<Way>(stated, compare); });
  }
}

template <typename Way>
void PluginTest::expectTheOpaqueCallAtSizes(std::span<const Size> sizes, std::span<const std::size_t> turns) {
  WalrConventions conventions{};
  conventions.struct_size = sizeof(conventions);
  conventions.rectangle = VK_TRUE;
  for (const WalrPassType* type : registered.types) {
    if (type->method == VK_FALSE) continue;
    WalrDenoiserInfo whole = info(type->name, sizes.front());
    whole.conventions = &conventions;
    Opaque opaque(host, api(), whole);
    std::vector<WalrPasses> passes;
    std::vector<std::unique_ptr<Way>> ways;
    for (const Size size : sizes) {
      whole.width = size.width;
      whole.height = size.height;
      passes.push_back(makePasses(whole));
      ways.push_back(std::make_unique<Way>(host, api(), passes.back()));
    }
    for (std::uint32_t frame = 0; frame < turns.size(); ++frame) {
      SCOPED_TRACE(std::string(type->name) + ", frame " + std::to_string(frame));
      const std::size_t turn = turns[frame];
      Way& way = *ways[turn];
      if (frame > 0 && turn != turns[frame - 1]) {
        opaque.resize(sizes[turn]);
        require(api().continue_passes(passes[turn], passes[turns[frame - 1]]));
        way.goOnFrom(*ways[turns[frame - 1]]);
      }
      const WalrCamera camera = cameraAt(float(frame) * kStep);
      uploadFrame(host, sizes[turn], frame, [&](std::size_t i) { return &opaque.image(i); });
      uploadFrame(host, sizes[turn], frame, [&](std::size_t i) { return &way.image(kInputs[i]); });
      opaque.frame(camera, 0);
      way.frame(passFrame(camera));
      EXPECT_EQ(download(host, way.image("denoised")), download(host, opaque.output()));
    }
    EXPECT_EQ(host.messages, 0) << type->name;
    ways.clear();
    for (const WalrPasses each : passes) EXPECT_EQ(api().destroy_passes(each), WALR_SUCCESS);
  }
}

}  // namespace plugin_host
