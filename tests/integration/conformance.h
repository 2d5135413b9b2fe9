#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_timeline.h"
#include "plugin_host.h"

/// What each host under test must be able to use. Every picture is compared with that of the opaque call in a plain
/// Vulkan host, to the bit.
namespace plugin_host {

using Texels = std::vector<std::uint16_t>;                 ///< As 16-bit words, rows without padding.
using Inputs = std::map<std::string, std::vector<float>>;  ///< Texels by the image's name.

/// A denoiser, or its passes, in a host under test.
class HostedDenoiser {
 public:
  HostedDenoiser() = default;
  virtual ~HostedDenoiser() = default;
  HostedDenoiser(const HostedDenoiser&) = delete;
  HostedDenoiser& operator=(const HostedDenoiser&) = delete;

  /// Run a frame with the host's own means.
  /// @param reset drop the history
  /// @throws std::runtime_error with the library's text if it refuses the frame; the host stays usable
  virtual void frame(const Inputs& inputs, const WalrPassFrame& frame, bool reset) = 0;
  /// An image that the last frame has written.
  virtual Texels read(const std::string& name) = 0;
  /// The semaphore and the value that tell when the next frame is finished.
  virtual std::pair<VkSemaphore, std::uint64_t> nextCompletion() = 0;
  /// Null if the host runs the passes itself.
  [[nodiscard]] virtual WalrDenoiser denoiser() const { return nullptr; }
  /// Null if the host records an opaque call.
  [[nodiscard]] virtual WalrPasses passes() const { return nullptr; }
};

class ConformanceTest;

struct Feature {
  const char* name;
  void (ConformanceTest::*check)();
};
std::span<const Feature> features();
inline void PrintTo(const Feature& feature, std::ostream* out) {
  *out << feature.name;
}
/// The name of a parameter, for INSTANTIATE_TEST_SUITE_P.
inline std::string nameOfFeature(const testing::TestParamInfo<Feature>& info) {
  return info.param.name;
}

/// A fixture of a host under test.
class ConformanceTest : public PluginTest {
 public:
  void hasFramesWithAReset();
  void hasMotionWithoutDepth();
  void hasAPipelineCache();
  void hasDeviceMemoryOfTheHost();
  void hasResultsInFloats();
  void hasResultsIn32Bits();
  void hasLargeWorlds();
  void hasAView();
  void hasCounters();
  void hasHistoryConfidenceAndLengths();
  void hasSeveralViewsOnSharedPipelines();
  void hasTwoLightsOnSharedGuides();
  void hasDiffuseAndSpecularLight();
  void hasOrthographicCameras();
  void hasCompletionByASemaphore();

 protected:
  /// @param view see walr_set_view; null: none
  virtual std::unique_ptr<HostedDenoiser> make(const WalrDenoiserInfo& info, const char* view) = 0;
  /// Why the host cannot have a feature; empty if it can.
  [[nodiscard]] virtual std::string lacks(std::string_view /*feature*/) const { return {}; }
  /// Format of motion without depth in the host. With four channels, the last two hold no numbers.
  [[nodiscard]] virtual VkFormat motionWithoutDepth() const { return VK_FORMAT_R32G32_SFLOAT; }
  /// The methods to try.
  [[nodiscard]] virtual std::vector<const char*> methods() const { return {"walr"}; }
  /// Those to try with history confidence and lengths.
  [[nodiscard]] virtual std::vector<const char*> methodsWithHistory() const { return methods(); }

  /// Check a feature, or skip it with the reason why the host lacks it.
  void check(const Feature& feature) {
    if (const std::string reason = lacks(feature.name); !reason.empty()) GTEST_SKIP() << feature.name << ": " << reason;
    (this->*feature.check)();
  }

 private:
  struct Statement;

  /// For each method, compare frames of the host with those of a plain host.
  void compare(const Statement& statement);
  void compareFrames(HostedDenoiser& hosted, Opaque& opaque, const Statement& statement,
                     const WalrDenoiserInfo& described);
};

/// A denoiser that a host records with one opaque call.
class HostedCall : public HostedDenoiser {
 public:
  HostedCall(const WalrApi& api, const WalrDenoiserInfo& info, const char* view) : api_(&api) {
    require(api.create_denoiser(&info, &denoiser_));
    if (view != nullptr) require(api.set_view(denoiser_, view));
    needed_ = neededImages(api, denoiser_, info, view != nullptr);
  }
  ~HostedCall() override { destroyDenoiser(); }
  [[nodiscard]] WalrDenoiser denoiser() const override { return denoiser_; }

 protected:
  /// Call it before the host's images are destroyed.
  void destroyDenoiser() {
    if (denoiser_ != nullptr) api_->destroy_denoiser(denoiser_);
    denoiser_ = nullptr;
  }
  [[nodiscard]] const WalrApi& api() const { return *api_; }
  [[nodiscard]] const std::vector<NeededImage>& needed() const { return needed_; }
  [[nodiscard]] std::size_t indexOf(const std::string& name) const {
    return std::size_t(std::ranges::find(needed_, name, &NeededImage::name) - needed_.begin());
  }
  void require(WalrResult result) const {
    if (result != WALR_SUCCESS) throw std::runtime_error(api_->last_error());
  }

 private:
  const WalrApi* api_;
  WalrDenoiser denoiser_ = nullptr;
  std::vector<NeededImage> needed_;
};

/// Passes that a host runs itself, without a semaphore of its own.
/// @tparam Way made from the host, the functions of the C API and passes; has image(name), resetHistory() and
///         frame(WalrPassFrame), which waits for the GPU
template <typename Way>
class HostedPasses : public HostedDenoiser {
 public:
  /// @param passes destroyed with this object
  HostedPasses(Host& host, const WalrApi& api, WalrPasses passes)
      : host_(&host),
        api_(&api),
        passes_(passes),
        timeline_(host.device),
        way_(std::make_unique<Way>(host, api, passes)) {}
  ~HostedPasses() override {
    way_.reset();
    EXPECT_EQ(api_->destroy_passes(passes_), WALR_SUCCESS);
  }

  void frame(const Inputs& inputs, const WalrPassFrame& frame, bool reset) override {
    for (const auto& [name, values] : inputs) host_upload(host_, &way_->image(name), values.data());
    if (reset) way_->resetHistory();
    way_->frame(frame);
    if (frame.finished != VK_NULL_HANDLE) host_signal(host_, timeline_.semaphore(), timeline_.raise());
  }
  Texels read(const std::string& name) override { return download(*host_, way_->image(name)); }
  std::pair<VkSemaphore, std::uint64_t> nextCompletion() override {
    return {timeline_.semaphore(), timeline_.value() + 1};
  }
  [[nodiscard]] WalrPasses passes() const override { return passes_; }

 private:
  Host* host_;
  const WalrApi* api_;
  WalrPasses passes_;
  walr::test::HostTimeline timeline_;
  std::unique_ptr<Way> way_;
};

/// A fixture of a host that runs the passes itself.
class PassByPassTest : public ConformanceTest {
 protected:
  [[nodiscard]] std::string lacks(std::string_view feature) const override {
    if (feature == "View") return "the C API has views with the opaque call only; in C++ hosts have them by Inspection";
    if (feature == "SeveralViewsOnSharedPipelines") {
      return "pass by pass a host shares memory and a pipeline cache itself, and walr_create_passes refuses "
             "shared_with";
    }
    return {};
  }
  [[nodiscard]] std::vector<const char*> methods() const override { return {"walr", "svgf"}; }
  [[nodiscard]] std::vector<const char*> methodsWithHistory() const override {
    std::vector<const char*> names;
    for (const WalrPassType* type : registered.types) {
      if (type->method == VK_TRUE && std::string_view(type->name) != "none") names.push_back(type->name);
    }
    return names;
  }
};

/// The fixture of a way to run passes: see HostedPasses.
template <typename Way>
class WayTest : public PassByPassTest {
 protected:
  std::unique_ptr<HostedDenoiser> make(const WalrDenoiserInfo& info, const char* /*view*/) override {
    return std::make_unique<HostedPasses<Way>>(host, api(), makePasses(info));
  }
};

}  // namespace plugin_host
