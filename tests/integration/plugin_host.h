#pragma once

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
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

/// The member of a frame for an image with a name.
inline const WalrImage*& imageOf(WalrFrame& frame, std::string_view name) {
  constexpr std::pair<std::string_view, const WalrImage * WalrFrame::*> kMembers[] = {
      {"lighting", &WalrFrame::lighting},
      {"depth", &WalrFrame::depth},
      {"normal", &WalrFrame::normal},
      {"motion", &WalrFrame::motion},
      {"albedo", &WalrFrame::albedo},
      {"denoised", &WalrFrame::denoised},
      {"confidence", &WalrFrame::confidence},
      {"history_length", &WalrFrame::history_length},
      {"view", &WalrFrame::view},
      {"second_lighting", &WalrFrame::second_lighting},
      {"second_denoised", &WalrFrame::second_denoised},
      {"second_confidence", &WalrFrame::second_confidence},
      {"second_history_length", &WalrFrame::second_history_length},
      {"second_light_direction", &WalrFrame::second_light_direction},
      {"light_direction", &WalrFrame::light_direction},
      {"second_expected_error", &WalrFrame::second_expected_error},
      {"expected_error", &WalrFrame::expected_error},
      {"specular_albedo", &WalrFrame::specular_albedo},
      {"roughness", &WalrFrame::roughness},
      {"specular_motion", &WalrFrame::specular_motion}};
  const auto* found = std::ranges::find(kMembers, name, [](const auto& member) { return member.first; });
  if (found == std::end(kMembers)) throw std::out_of_range(std::string(name));
  return frame.*found->second;
}

/// A frame of a denoiser that has in common with one pass by pass what both can state.
inline WalrFrame frameLike(const WalrPassFrame& like, std::uint32_t flags) {
  WalrFrame frame{};
  frame.struct_size = sizeof(frame);
  frame.flags = flags;
  frame.camera = like.camera;
  frame.frame_index = like.frame_index;
  std::ranges::copy(like.origin, frame.origin);
  frame.finished = like.finished;
  frame.finished_value = like.finished_value;
  return frame;
}

/// An image that a denoiser needs.
struct NeededImage {
  std::string name;
  VkFormat format;
  VkImageUsageFlags usage;
  Size size;

  [[nodiscard]] bool written() const { return (usage & VK_IMAGE_USAGE_STORAGE_BIT) != 0; }
};

/// Whether a denoiser is made for a kind of light.
inline bool hasLight(const WalrDenoiserInfo& info, WalrLightKind kind) {
  return info.light_kind == kind || (info.light_count == 2 && info.second_light_kind == kind);
}

/// The images of a denoiser: the inputs in the order of `kInputs`, the result, and those that it has besides. Specular
/// light alone has its own albedo in the place of the diffuse one.
inline std::vector<NeededImage> neededImages(const WalrApi& api, WalrDenoiser denoiser, const WalrDenoiserInfo& info,
                                             bool view) {
  std::vector<std::string> names(std::begin(kInputs), std::end(kInputs));
  names.emplace_back("denoised");
  if (!hasLight(info, WALR_LIGHT_DIFFUSE)) {
    names[4] = "specular_albedo";
  } else if (hasLight(info, WALR_LIGHT_SPECULAR)) {
    names.emplace_back("specular_albedo");
  }
  if (hasLight(info, WALR_LIGHT_SPECULAR)) names.insert(names.end(), {"roughness", "specular_motion"});
  if (info.confidence_format != VK_FORMAT_UNDEFINED) names.emplace_back("confidence");
  if (info.history_length == VK_TRUE) names.emplace_back("history_length");
  if (info.light_direction == VK_TRUE) names.emplace_back("light_direction");
  if (info.expected_error == VK_TRUE) names.emplace_back("expected_error");
  if (view) names.emplace_back("view");
  if (info.light_count == 2) {
    names.insert(names.end(), {"second_lighting", "second_denoised"});
    if (info.confidence_format != VK_FORMAT_UNDEFINED) names.emplace_back("second_confidence");
    if (info.history_length == VK_TRUE) names.emplace_back("second_history_length");
    if (info.light_direction == VK_TRUE) names.emplace_back("second_light_direction");
    if (info.expected_error == VK_TRUE) names.emplace_back("second_expected_error");
  }
  std::vector<NeededImage> needed;
  for (const std::string& name : names) {
    WalrImageRequirements needs{};
    needs.struct_size = sizeof(needs);
    if (api.get_image_requirements(denoiser, name.c_str(), &needs) != WALR_SUCCESS) {
      throw std::runtime_error(api.last_error());
    }
    needed.push_back({name, needs.format, needs.usage, {needs.width, needs.height}});
  }
  return needed;
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

/// All cases of a program share the host, because opening it and creating its pipelines takes longer than most cases.
/// After a failure the next case gets a new one. What the layer tells when the device is destroyed, for instance of
/// objects that a case has left behind, fails the failed case or else the program.
class PluginTest : public testing::Test {
 protected:
  void SetUp() override {
    if (host.device == VK_NULL_HANDLE) openHost();
    const WalrRegistryHost registry{sizeof(WalrRegistryHost), 0, &registered, takeApi, takeType};
    ASSERT_EQ(plugin.registerWith(&registry), WALR_SUCCESS);
    device.struct_size = sizeof(device);
    device.queue_family = host.queue_family;
    device.instance = host.instance;
    device.physical_device = host.physical_device;
    device.device = host.device;
    device.get_instance_proc_addr = vkGetInstanceProcAddr;
  }
  void TearDown() override {
    EXPECT_EQ(std::exchange(host.messages, 0), 0) << "validation messages";
    if (HasFailure()) closeHost();
  }

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
  /// A description of one or two lights of these kinds.
  [[nodiscard]] static WalrDenoiserInfo ofLights(WalrDenoiserInfo info, WalrLightKind kind,
                                                 std::optional<WalrLightKind> second = {}) {
    info.light_count = second ? 2 : 1;
    info.light_kind = kind;
    info.second_light_kind = second.value_or(WALR_LIGHT_DIFFUSE);
    if (!hasLight(info, WALR_LIGHT_SPECULAR)) return info;
    info.specular_albedo_format = VK_FORMAT_R32G32B32A32_SFLOAT;
    info.roughness_format = VK_FORMAT_R32_SFLOAT;
    info.specular_motion_format = VK_FORMAT_R32G32B32A32_SFLOAT;
    return info;
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
  /// Compare the opaque call with a way to run passes while the host alternates between passes of several sizes. The
  /// way is a class that is made from the host, the functions of the C API and passes, and has image(name),
  /// frame(WalrPassFrame) and goOnFrom(Way&).
  /// @param turns by frame: index of its size
  template <typename Way>
  void expectTheOpaqueCallAtSizes(std::span<const Size> sizes, std::span<const std::size_t> turns);

  static void closeHost() {
    if (host.device == VK_NULL_HANDLE) return;
    EXPECT_EQ(host_close(&host), 0) << "validation messages";
    host = {};
  }

  static inline Host host{};
  Plugin plugin;
  WalrDevice device{};
  Registered registered;

 private:
  /// Closes the host after the last test of the program.
  class HostOfTheProgram : public testing::Environment {
   public:
    void TearDown() override { closeHost(); }
  };
  [[maybe_unused]] static inline const testing::Environment* const hostOfTheProgram =
      testing::AddGlobalTestEnvironment(new HostOfTheProgram);
};

inline WalrCamera cameraAt(float x) {
  return {.view = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, 0, 0, 1},
          .projection = {1.5F, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1, -1, 0, 0, -0.1F, 0},
          .jitter = {0, 0}};
}

inline constexpr float kStep = 0.05F;  ///< The camera's movement to the right per frame, in scene units.

/// Texels of an input: a slanted wall behind a nearer square, seen by a camera that moves to the right, noisy light.
/// The host trusts history in the right half only. What the wall reflects is behind it, and every seventh pixel has no
/// sample of that.
inline std::vector<float> texels(const std::string& name, Size size, std::uint32_t frame) {
  std::vector<float> result;
  std::uint32_t random = 12345 + frame * 977;
  for (std::uint32_t y = 0; y < size.height; ++y) {
    for (std::uint32_t x = 0; x < size.width; ++x) {
      const float u = (float(x) + 0.5F) / float(size.width) * 2.0F - 1.0F;
      const float v = (float(y) + 0.5F) / float(size.height) * 2.0F - 1.0F;
      const bool near = std::abs(u) < 0.4F && std::abs(v) < 0.5F;
      const float depth = near ? 3.0F : 6.0F + 0.5F * v;
      if (name == "depth" || name == "confidence" || name == "roughness") {
        result.push_back(name == "depth"       ? depth
                         : name == "roughness" ? 0.1F + 0.3F * (v + 1.0F)
                         : u < 0.0F            ? 0.0F
                                               : 0.75F);
        continue;
      }
      float texel[4] = {0, 0, 0, 0};
      if (name == "normal") texel[2] = 1.0F;
      // A point at view depth d moves by focal * step / d times half the image's width.
      if (name == "motion") texel[0] = 1.5F * kStep / depth * 0.5F * float(size.width);
      if (name == "albedo") texel[0] = texel[1] = texel[2] = v > 0.9F ? 0.0F : 0.5F;
      if (name == "specular_motion") texel[1] = 0.25F * u;
      if (name == "specular_albedo") texel[0] = texel[1] = texel[2] = v < -0.9F ? 0.0F : 0.04F;
      if (name == "lighting") {
        texel[3] = (x + y) % 7 == 0 ? 0.0F : 2.0F + u;
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
  /// @param view see walr_set_view
  Opaque(Host& host, const WalrApi& api, const WalrDenoiserInfo& info, const char* view = nullptr)
      : host_(&host), api_(&api), info_(info), hasView_(view != nullptr) {
    require(api.create_denoiser(&info, &denoiser_));
    if (hasView_) require(api.set_view(denoiser_, view));
    makeImages();
  }
  ~Opaque() {
    api_->destroy_denoiser(denoiser_);
    destroyImages();
  }
  Opaque(const Opaque&) = delete;
  Opaque& operator=(const Opaque&) = delete;

  [[nodiscard]] WalrDenoiser denoiser() const { return denoiser_; }
  [[nodiscard]] const WalrDenoiserInfo& info() const { return info_; }
  [[nodiscard]] const std::vector<NeededImage>& needed() const { return needed_; }
  HostImage& image(std::size_t index) { return images_[index]; }
  HostImage& image(const std::string& name) {
    return images_.at(std::size_t(std::ranges::find(needed_, name, &NeededImage::name) - needed_.begin()));
  }
  HostImage& output() { return images_.at(5); }

  /// Change the size and create images of that size.
  void resize(Size size) {
    for (const HostImage& image : images_) api_->forget_image(denoiser_, image.image, 0);
    destroyImages();
    require(api_->resize(denoiser_, size.width, size.height));
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
    WalrFrame frame = frameLike(like, flags);
    std::vector<WalrImage> images;
    images.reserve(images_.size());
    for (std::size_t i = 0; i < images_.size(); ++i) {
      const HostImage& image = images_[i];
      WalrImage& given = images.emplace_back();
      given.struct_size = sizeof(given);
      given.queue_family = VK_QUEUE_FAMILY_IGNORED;
      given.image = image.image;
      given.format = image.format;
      given.usage = image.usage;
      given.width = image.width;
      given.height = image.height;
      given.acquire = {image.stage, image.access, image.layout, 0};
      imageOf(frame, needed_[i].name) = &given;
    }
    const VkCommandBuffer commands = host_begin(host_);
    require(api_->record(denoiser_, commands, &frame));
    host_submit_and_wait(host_, commands);
    for (std::size_t i = 0; i < images_.size(); ++i) {
      WalrImageState state{};
      if (api_->get_release_state(denoiser_, needed_[i].name.c_str(), &state) != WALR_SUCCESS) continue;  // Unused.
      images_[i].stage = state.stage;
      images_[i].access = state.access;
      images_[i].layout = state.layout;
    }
  }

 private:
  void require(WalrResult result) const {
    if (result != WALR_SUCCESS) throw std::runtime_error(api_->last_error());
  }
  void makeImages() {
    needed_ = neededImages(*api_, denoiser_, info_, hasView_);
    for (const NeededImage& needed : needed_) {
      images_.push_back(host_make_image(host_, needed.format, needed.size.width, needed.size.height,
                                        needed.usage | VK_IMAGE_USAGE_SAMPLED_BIT));
    }
  }
  void destroyImages() {
    for (HostImage& image : images_) host_destroy_image(host_, &image);
    images_.clear();
  }

  Host* host_;
  const WalrApi* api_;
  WalrDenoiserInfo info_;
  bool hasView_;
  WalrDenoiser denoiser_ = nullptr;
  std::vector<NeededImage> needed_;
  std::vector<HostImage> images_;  ///< In the order of `needed_`.
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
