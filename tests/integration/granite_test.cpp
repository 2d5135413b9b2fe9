// walr's passes in Granite's render graph. Built with cmake -DWALR_GRANITE=FOLDER.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "conformance.h"
#include "granite/engine.h"

namespace plugin_host {
namespace {

/// The passes in a graph of their own.
class GraniteDenoiser : public HostedDenoiser {
 public:
  /// @param passes destroyed with this object
  GraniteDenoiser(Host& host, const WalrApi& api, WalrPasses passes, const WalrDenoiserInfo& info)
      : host_(&host),
        api_(&api),
        passes_(passes),
        timeline_(host.device),
        engine_(host),
        hasLengths_(info.history_length == VK_TRUE) {
    const WalrPassList* list = nullptr;
    if (api.get_pass_list(passes, &list) != WALR_SUCCESS) throw std::runtime_error(api.last_error());
    engine_.build(api, passes, *list, info.width, info.height);
  }
  ~GraniteDenoiser() override {
    engine_.drop();
    EXPECT_EQ(api_->destroy_passes(passes_), WALR_SUCCESS);
  }

  void frame(const Inputs& inputs, const WalrPassFrame& frame, bool reset) override {
    engine_.frame(frame, inputs, reset);
    shown_ = engine_.read();  // Waits for the GPU.
    if (frame.finished != VK_NULL_HANDLE) host_signal(host_, timeline_.semaphore(), timeline_.raise());
  }
  /// The lower half of what is shown are the history lengths, in its first channel.
  Texels read(const std::string& name) override {
    if (!hasLengths_ && name == "denoised") return shown_;
    const auto middle = shown_.begin() + std::ptrdiff_t(shown_.size() / 2);
    if (name == "denoised") return {shown_.begin(), middle};
    Texels lengths;
    for (auto texel = middle; texel != shown_.end(); texel += 4) lengths.push_back(*texel);
    return lengths;
  }
  std::pair<VkSemaphore, std::uint64_t> nextCompletion() override {
    return {timeline_.semaphore(), timeline_.value() + 1};
  }
  [[nodiscard]] WalrPasses passes() const override { return passes_; }

 private:
  Host* host_;
  const WalrApi* api_;
  WalrPasses passes_;
  walr::test::HostTimeline timeline_;
  granite_host::Engine engine_;
  Texels shown_;
  bool hasLengths_;
};

class Granite : public PassByPassTest {
 protected:
  std::unique_ptr<HostedDenoiser> make(const WalrDenoiserInfo& info, const char* /*view*/) override {
    return std::make_unique<GraniteDenoiser>(host, api(), makePasses(info), info);
  }
  /// Granite records every pass into its own command buffer, so hazards occur between submissions.
  void openHost() override {
    setenv("VK_LAYER_ENABLES", "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT", 1);
    PluginTest::openHost();
    unsetenv("VK_LAYER_ENABLES");
  }

  static Inputs inputs(Size size, std::uint32_t number) {
    Inputs result;
    for (const char* input : kInputs) result[input] = texels(input, size, number);
    return result;
  }

  [[nodiscard]] const WalrPassList& listOf(WalrPasses passes) const {
    const WalrPassList* list = nullptr;
    require(api().get_pass_list(passes, &list));
    return *list;
  }
  void run(granite_host::Engine& engine, Size size, std::uint32_t number, bool reset = false) {
    const WalrCamera camera = cameraAt(float(number) * kStep);
    engine.frame(passFrame(camera), inputs(size, number), reset);
  }
  static void runOpaque(Host& host, Opaque& opaque, Size size, std::uint32_t number, bool reset = false) {
    uploadFrame(host, size, number, [&](std::size_t i) { return &opaque.image(i); });
    opaque.frame(cameraAt(float(number) * kStep), reset ? WALR_FRAME_RESET_HISTORY : 0);
  }

  /// Compare five frames, with a reset, with those of the opaque call in a plain Vulkan host.
  void compare(granite_host::Engine& engine, const char* method, Size size) {
    Opaque opaque(host, api(), info(method, size));
    const WalrPasses passes = makePasses(method, size);
    engine.build(api(), passes, listOf(passes), size.width, size.height);
    for (std::uint32_t number = 0; number < 5; ++number) {
      SCOPED_TRACE(std::string(method) + ", frame " + std::to_string(number));
      const bool reset = number == 3;
      runOpaque(host, opaque, size, number, reset);
      run(engine, size, number, reset);
      EXPECT_EQ(engine.read(), download(host, opaque.output()));
    }
    engine.drop();
    require(api().destroy_passes(passes));
  }
};

TEST_F(Granite, EveryMethodGivesTheSamePixelsThroughResetAndResize) {
  granite_host::Engine engine(host);
  for (const WalrPassType* type : registered.types) {
    if (type->method == VK_FALSE) continue;
    for (const Size size : {Size{61, 43}, Size{40, 45}}) compare(engine, type->name, size);
  }
}

class GraniteFeatures : public Granite, public testing::WithParamInterface<Feature> {
 protected:
  [[nodiscard]] std::string lacks(std::string_view feature) const override {
    return feature == "TwoLightsOnSharedGuides" ? "the test's window shows one light" : Granite::lacks(feature);
  }
};

TEST_P(GraniteFeatures, GiveThePixelsOfAPlainHost) {
  check(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Every, GraniteFeatures, testing::ValuesIn(features()), nameOfFeature);

TEST_F(Granite, FramesInFlightGiveTheSamePixels) {
  constexpr Size kSize{61, 43};
  constexpr std::uint32_t kFrames = 8;
  granite_host::Engine engine(host);
  const WalrPasses passes = makePasses("walr", kSize);
  engine.build(api(), passes, listOf(passes), kSize.width, kSize.height);
  for (std::uint32_t number = 0; number < kFrames; ++number) run(engine, kSize, number);
  const std::vector<std::uint16_t> result = engine.read();
  engine.drop();
  require(api().destroy_passes(passes));
  Opaque opaque(host, api(), info("walr", kSize));
  for (std::uint32_t number = 0; number < kFrames; ++number) runOpaque(host, opaque, kSize, number);
  EXPECT_EQ(result, download(host, opaque.output()));
}

/// A list of passes that read and write numbered images. The last image is the result.
class Listed {
 public:
  struct Access {
    std::uint32_t image;
    bool write;
  };
  Listed(std::vector<std::string> names, std::uint32_t images, const std::vector<std::vector<Access>>& passes)
      : names_(std::move(names)), resources_(images), bindings_(passes.size()), dispatches_(passes.size()) {
    for (std::uint32_t i = 0; i < images; ++i) {
      imageNames_.push_back(i + 1 == images ? "denoised" : "image " + std::to_string(i));
      WalrResource& resource = resources_[i];
      resource.kind = i + 1 == images ? WALR_RESOURCE_HOST : WALR_RESOURCE_TRANSIENT;
      resource.format = VK_FORMAT_R16G16B16A16_SFLOAT;
      resource.width = resource.height = 8;
    }
    for (std::uint32_t i = 0; i < images; ++i) {
      resources_[i].name = imageNames_[i].c_str();
      resourcePointers_.push_back(&resources_[i]);
    }
    bindingPointers_.resize(passes.size());
    for (std::size_t i = 0; i < passes.size(); ++i) {
      for (const auto& [image, write] : passes[i]) {
        WalrBinding& binding = bindings_[i].emplace_back();
        binding.resource = image;
        binding.type = write ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE : VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
        binding.access = write ? VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT : VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
      }
      for (const WalrBinding& binding : bindings_[i]) bindingPointers_[i].push_back(&binding);
      dispatches_[i].name = names_[i].c_str();
      dispatches_[i].indirect = WALR_NONE;
      dispatches_[i].bindings = bindingPointers_[i].data();
      dispatches_[i].binding_count = static_cast<std::uint32_t>(bindings_[i].size());
      dispatchPointers_.push_back(&dispatches_[i]);
    }
    list_.resources = resourcePointers_.data();
    list_.resource_count = images;
    list_.passes = dispatchPointers_.data();
    list_.pass_count = static_cast<std::uint32_t>(dispatches_.size());
  }
  Listed(const Listed&) = delete;
  Listed& operator=(const Listed&) = delete;

  [[nodiscard]] const WalrPassList& list() const { return list_; }

 private:
  std::vector<std::string> names_;
  std::vector<std::string> imageNames_;
  std::vector<WalrResource> resources_;
  std::vector<const WalrResource*> resourcePointers_;
  std::vector<std::vector<WalrBinding>> bindings_;
  std::vector<std::vector<const WalrBinding*>> bindingPointers_;
  std::vector<WalrDispatch> dispatches_;
  std::vector<const WalrDispatch*> dispatchPointers_;
  WalrPassList list_{};
};

// Without the adapter's proxies Granite may run the overwriting pass first.
TEST_F(Granite, OverwritesComeAfterReads) {
  granite_host::Engine engine(host);
  for (const bool swapped : {false, true}) {
    std::vector<Listed::Access> last = {{0, false}, {1, false}, {2, true}};
    if (swapped) std::swap(last[0], last[1]);
    const Listed listed({"write", "read", "overwrite", "finish"}, 3,
                        {{{0, true}}, {{0, false}, {1, true}}, {{0, true}}, last});
    engine.build(api(), nullptr, listed.list(), 8, 8);
    EXPECT_LT(engine.position("write"), engine.position("read"));
    EXPECT_LT(engine.position("read"), engine.position("overwrite"));
    EXPECT_LT(engine.position("overwrite"), engine.position("finish"));
  }
}

std::atomic<int> inWalr{0};
std::atomic<int> mostInWalr{0};

TEST_F(Granite, OnlyOneThreadAtATimeCallsWalr) {
  WalrApi slow = api();
  slow.begin_frame = [](WalrPasses, const WalrPassFrame*) { return WALR_SUCCESS; };
  slow.record_pass = [](WalrPasses, std::uint32_t, VkCommandBuffer, const WalrPassResource*, std::uint32_t) {
    mostInWalr = std::max(mostInWalr.load(), ++inWalr);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    --inWalr;
    return WALR_SUCCESS;
  };
  granite_host::Engine engine(host);
  const Listed listed({"a", "b", "c", "finish"}, 4,
                      {{{0, true}}, {{1, true}}, {{2, true}}, {{0, false}, {1, false}, {2, false}, {3, true}}});
  engine.build(slow, nullptr, listed.list(), 8, 8);
  const WalrCamera camera = cameraAt(0);
  engine.frame(passFrame(camera), {}, false);
  engine.drop();
  EXPECT_EQ(mostInWalr, 1);
}

// Shows that the other tests would report hazards between submissions.
TEST_F(Granite, ValidationReportsAHazardBetweenSubmissions) {
  constexpr Size kSize{61, 43};
  granite_host::Engine engine(host);
  const WalrPasses passes = makePasses("none", kSize);
  engine.build(api(), passes, listOf(passes), kSize.width, kSize.height);
  run(engine, kSize, 0);
  EXPECT_EQ(host.messages, 0);
  engine.read(false);
  EXPECT_GT(host.messages, 0);
  host.messages = 0;
  engine.drop();
  require(api().destroy_passes(passes));
}

}  // namespace
}  // namespace plugin_host
