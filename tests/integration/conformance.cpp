#include "conformance.h"

#include <algorithm>
#include <array>
#include <limits>

#include "device_calls.h"

namespace plugin_host {
namespace {

constexpr Size kSize{45, 37};
constexpr Feature kFeatures[] = {
    {"FramesWithAReset", &ConformanceTest::hasFramesWithAReset},
    {"MotionWithoutDepth", &ConformanceTest::hasMotionWithoutDepth},
    {"PipelineCache", &ConformanceTest::hasAPipelineCache},
    {"DeviceMemoryOfTheHost", &ConformanceTest::hasDeviceMemoryOfTheHost},
    {"ResultInFloats", &ConformanceTest::hasResultsInFloats},
    {"ResultIn32Bits", &ConformanceTest::hasResultsIn32Bits},
    {"LargeWorld", &ConformanceTest::hasLargeWorlds},
    {"View", &ConformanceTest::hasAView},
    {"Counters", &ConformanceTest::hasCounters},
    {"HistoryConfidenceAndLengths", &ConformanceTest::hasHistoryConfidenceAndLengths},
    {"SeveralViewsOnSharedPipelines", &ConformanceTest::hasSeveralViewsOnSharedPipelines},
    {"TwoLightsOnSharedGuides", &ConformanceTest::hasTwoLightsOnSharedGuides},
    {"DiffuseAndSpecularLight", &ConformanceTest::hasDiffuseAndSpecularLight},
    {"OrthographicCamera", &ConformanceTest::hasOrthographicCameras},
    {"CompletionByASemaphore", &ConformanceTest::hasCompletionByASemaphore},
};

/// Motion without the depth's change: two channels, or four with no numbers in the last two.
std::vector<float> motionWithoutDepth(std::vector<float> motion, VkFormat format) {
  if (format != VK_FORMAT_R32G32_SFLOAT) {
    for (std::size_t i = 0; i < motion.size(); i += 4) {
      motion[i + 2] = motion[i + 3] = std::numeric_limits<float>::quiet_NaN();
    }
    return motion;
  }
  std::vector<float> flat;
  for (std::size_t i = 0; i < motion.size(); i += 4) flat.insert(flat.end(), {motion[i], motion[i + 1]});
  return flat;
}

Inputs inputsOf(const WalrDenoiserInfo& info, std::uint32_t number, bool motionHasDepth) {
  const Size size{info.width, info.height};
  Inputs inputs;
  for (const char* name : kInputs) inputs[name] = texels(name, size, number);
  if (!motionHasDepth) inputs["motion"] = motionWithoutDepth(inputs["motion"], info.motion_format);
  if (info.confidence_format != VK_FORMAT_UNDEFINED) inputs["confidence"] = texels("confidence", size, number);
  if (hasLight(info, WALR_LIGHT_SPECULAR)) {
    for (const char* name : {"specular_albedo", "roughness", "specular_motion"})
      inputs[name] = texels(name, size, number);
  }
  if (info.light_count == 2) inputs["second_lighting"] = texels("lighting", size, number + 100);
  return inputs;
}

/// Check that history is as long as the host's confidence allows: one frame in the left half, more in the right one.
void expectLengthsByConfidence(const Texels& lengths) {
  constexpr std::uint16_t kOne = 0x3c00;
  const std::uint32_t row = kSize.height / 2 * kSize.width;
  EXPECT_EQ(lengths.at(row + 2), kOne);
  EXPECT_GT(lengths.at(row + kSize.width * 3 / 4), kOne);
}

/// A host's allocator of device memory, one allocation for each block.
class HostMemory {
 public:
  explicit HostMemory(Host& host) : host_(&host) {}
  [[nodiscard]] WalrMemoryCallbacks callbacks() {
    return {.struct_size = sizeof(WalrMemoryCallbacks), .reserved = 0, .user = this, .allocate = take, .free = give};
  }
  [[nodiscard]] std::uint32_t taken() const { return taken_; }
  [[nodiscard]] std::uint32_t live() const { return live_; }

 private:
  static VkResult take(void* user, const WalrMemoryRequest* request, WalrMemoryBlock* block) {
    auto& self = *static_cast<HostMemory*>(user);
    block->memory =
        host_allocate(self.host_, {request->size, request->alignment, request->memory_type_bits}, request->required);
    ++self.taken_;
    ++self.live_;
    if ((request->required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) == 0) return VK_SUCCESS;
    return vkMapMemory(self.host_->device, block->memory, 0, VK_WHOLE_SIZE, 0, &block->mapped);
  }
  static void give(void* user, const WalrMemoryBlock* block) {
    auto& self = *static_cast<HostMemory*>(user);
    vkFreeMemory(self.host_->device, block->memory, nullptr);
    --self.live_;
  }

  Host* host_;
  std::uint32_t taken_ = 0;
  std::uint32_t live_ = 0;
};

}  // namespace

std::span<const Feature> features() {
  return kFeatures;
}

/// What a host states beside the usual.
struct ConformanceTest::Statement {
  std::function<void(WalrDenoiserInfo& info, WalrConventions& conventions)> state = [](auto&, auto&) {};
  std::function<void(std::uint32_t number, WalrCamera& camera, WalrPassFrame& frame)> change = [](auto, auto&, auto&) {
  };
  std::uint32_t frames = 4;
  std::uint32_t resetAt = ~0U;
  bool motionHasDepth = true;
  std::vector<const char*> methods = {};  ///< Empty: the fixture's.
  std::vector<std::string> outputs = {"denoised"};
  /// Called after the last frame.
  std::function<void(HostedDenoiser& hosted, Opaque& opaque)> finally = [](auto&, auto&) {};
  const char* view = nullptr;
};

void ConformanceTest::compareFrames(HostedDenoiser& hosted, Opaque& opaque, const Statement& statement,
                                    const WalrDenoiserInfo& described) {
  for (std::uint32_t number = 0; number < statement.frames; ++number) {
    SCOPED_TRACE("frame " + std::to_string(number));
    const Inputs inputs = inputsOf(described, number, statement.motionHasDepth);
    WalrCamera camera = cameraAt(float(number) * kStep);
    WalrPassFrame frame = passFrame(camera);
    statement.change(number, camera, frame);
    const bool reset = number == statement.resetAt;
    for (const auto& [name, values] : inputs) host_upload(&host, &opaque.image(name), values.data());
    opaque.frame(frame, reset ? WALR_FRAME_RESET_HISTORY : 0);
    const auto [semaphore, value] = hosted.nextCompletion();
    frame.finished = semaphore;
    frame.finished_value = value;
    hosted.frame(inputs, frame, reset);
    for (const std::string& output : statement.outputs) {
      const Texels result = hosted.read(output);
      EXPECT_EQ(result, download(host, opaque.image(output))) << output;
      EXPECT_TRUE(std::ranges::any_of(result, [](std::uint16_t bits) { return bits != 0; })) << output;
    }
  }
  statement.finally(hosted, opaque);
}

void ConformanceTest::compare(const Statement& statement) {
  for (const char* method : statement.methods.empty() ? methods() : statement.methods) {
    SCOPED_TRACE(method);
    WalrConventions conventions{};
    conventions.struct_size = sizeof(conventions);
    WalrDenoiserInfo described = info(method, kSize);
    described.conventions = &conventions;
    statement.state(described, conventions);
    // The plain host uses neither the host's allocator nor its cache.
    WalrDenoiserInfo plain = described;
    WalrDevice plainDevice = device;
    plainDevice.device_memory = nullptr;
    plainDevice.get_instance_proc_addr = vkGetInstanceProcAddr;
    plain.device = &plainDevice;
    plain.pipeline_cache = VK_NULL_HANDLE;
    Opaque opaque(host, api(), plain, statement.view);
    const auto hosted = make(described, statement.view);
    compareFrames(*hosted, opaque, statement, described);
  }
}

void ConformanceTest::hasFramesWithAReset() {
  compare({.frames = 5, .resetAt = 2});
}

void ConformanceTest::hasMotionWithoutDepth() {
  compare({.state =
               [&](WalrDenoiserInfo& info, WalrConventions& conventions) {
                 info.motion_format = motionWithoutDepth();
                 conventions.motion_depth = WALR_MOTION_DEPTH_FOUND;
               },
           .motionHasDepth = false});
}

void ConformanceTest::hasAPipelineCache() {
  VkPipelineCacheCreateInfo empty{};
  empty.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  VkPipelineCache cache = VK_NULL_HANDLE;
  ASSERT_EQ(vkCreatePipelineCache(host.device, &empty, nullptr, &cache), VK_SUCCESS);
  device.get_instance_proc_addr = walr::test::countDeviceCalls(vkGetInstanceProcAddr);
  compare({.state = [&](WalrDenoiserInfo& info, WalrConventions&) { info.pipeline_cache = cache; },
           .frames = 1,
           .methods = {"walr"}});
  EXPECT_EQ(walr::test::deviceCalls.caches, std::set<VkPipelineCache>{cache});
  vkDestroyPipelineCache(host.device, cache, nullptr);
}

void ConformanceTest::hasDeviceMemoryOfTheHost() {
  HostMemory memory(host);
  const WalrMemoryCallbacks callbacks = memory.callbacks();
  device.device_memory = &callbacks;
  device.get_instance_proc_addr = walr::test::countDeviceCalls(vkGetInstanceProcAddr);
  const bool counters = lacks("Counters").empty();  // They have memory of their own.
  compare({.state = [=](WalrDenoiserInfo& info, WalrConventions&) { info.counters = counters ? VK_TRUE : VK_FALSE; },
           .frames = 2,
           .methods = {"walr"}});
  EXPECT_GT(memory.taken(), 0U);
  EXPECT_EQ(memory.live(), 0U);
  EXPECT_EQ(walr::test::deviceCalls.bytes, 0U) << "the library's own allocations";
}

void ConformanceTest::hasResultsInFloats() {
  compare({.state = [](WalrDenoiserInfo& info, WalrConventions&) {
    info.denoised_format = VK_FORMAT_R32G32B32A32_SFLOAT;
  }});
}

void ConformanceTest::hasResultsIn32Bits() {
  compare({.state = [](WalrDenoiserInfo& info, WalrConventions&) {
    info.denoised_format = VK_FORMAT_B10G11R11_UFLOAT_PACK32;
  }});
}

// The cameras stand still in front of an origin that moves.
void ConformanceTest::hasLargeWorlds() {
  compare({.change = [](std::uint32_t number, WalrCamera& camera, WalrPassFrame& frame) {
    camera = cameraAt(0);
    frame.origin[0] = 1e6 + double(number) * double(kStep);
  }});
}

void ConformanceTest::hasAView() {
  compare({.methods = {"walr"}, .outputs = {"denoised", "view"}, .view = "antilag"});
}

void ConformanceTest::hasCounters() {
  const auto countersOf = [&](WalrDenoiser denoiser, WalrPasses passes) {
    std::array<WalrCounter, 64> counters{};
    std::uint32_t count = counters.size();
    require(denoiser != nullptr ? api().get_counters(denoiser, &count, counters.data())
                                : api().get_pass_counters(passes, &count, counters.data()));
    std::map<std::string, std::uint64_t> byName;
    for (std::uint32_t i = 0; i < count; ++i) byName.emplace(counters.at(i).name, counters.at(i).value);
    return byName;
  };
  compare({.state =
               [](WalrDenoiserInfo& info, WalrConventions&) {
                 info.counters = VK_TRUE;
                 info.lint = VK_TRUE;
               },
           .frames = 5,
           .finally =
               [&](HostedDenoiser& hosted, Opaque& opaque) {
                 const auto expected = countersOf(opaque.denoiser(), nullptr);
                 EXPECT_EQ(countersOf(hosted.denoiser(), hosted.passes()), expected);
                 EXPECT_TRUE(expected.contains("sky"));
                 EXPECT_GT(expected.at("lint-pixels"), 0U);
               }});
}

void ConformanceTest::hasHistoryConfidenceAndLengths() {
  compare(
      {.state =
           [](WalrDenoiserInfo& info, WalrConventions&) {
             info.confidence_format = VK_FORMAT_R32_SFLOAT;
             info.history_length = VK_TRUE;
           },
       .frames = 5,
       .resetAt = 2,
       .methods = methodsWithHistory(),
       .outputs = {"denoised", "history_length"},
       .finally = [](HostedDenoiser& hosted, Opaque&) { expectLengthsByConfidence(hosted.read("history_length")); }});
}

void ConformanceTest::hasSeveralViewsOnSharedPipelines() {
  device.get_instance_proc_addr = walr::test::countDeviceCalls(vkGetInstanceProcAddr);
  WalrDenoiserInfo described = info("walr", kSize);
  const auto first = make(described, nullptr);
  require(api().prepare(first->denoiser()));
  EXPECT_GT(walr::test::deviceCalls.pipelines, 0U);
  walr::test::deviceCalls = {};
  described.shared_with = first->denoiser();
  const auto second = make(described, nullptr);
  require(api().prepare(second->denoiser()));
  EXPECT_EQ(walr::test::deviceCalls.pipelines, 0U);
  device.get_instance_proc_addr = vkGetInstanceProcAddr;
  Opaque left(host, api(), info("walr", kSize));
  Opaque right(host, api(), info("walr", kSize));
  struct Eye {
    HostedDenoiser* hosted;
    Opaque* alone;
    float beside;
  };
  const Eye eyes[] = {{first.get(), &left, 0.0F}, {second.get(), &right, 0.5F}};
  for (std::uint32_t number = 0; number < 4; ++number) {
    for (const Eye& eye : eyes) {
      SCOPED_TRACE("frame " + std::to_string(number) + ", " + std::to_string(eye.beside) + " beside");
      // Other light for the other eye, so that a mix-up shows.
      const Inputs inputs = inputsOf(described, number + (eye.beside > 0.0F ? 100 : 0), true);
      const WalrCamera camera = cameraAt(eye.beside + float(number) * kStep);
      const WalrPassFrame frame = passFrame(camera);
      for (const auto& [name, values] : inputs) host_upload(&host, &eye.alone->image(name), values.data());
      eye.alone->frame(frame, 0);
      eye.hosted->frame(inputs, frame, false);
      EXPECT_EQ(eye.hosted->read("denoised"), download(host, eye.alone->output()));
    }
  }
}

void ConformanceTest::hasTwoLightsOnSharedGuides() {
  compare({.state =
               [](WalrDenoiserInfo& info, WalrConventions&) {
                 info.light_count = 2;
                 if (std::string_view(info.method) == "bmfr") info.second_preset = "paper";
               },
           .frames = 5,
           .resetAt = 3,
           .outputs = {"denoised", "second_denoised"}});
}

void ConformanceTest::hasDiffuseAndSpecularLight() {
  compare({.state = [](WalrDenoiserInfo& info,
                       WalrConventions&) { info = ofLights(info, WALR_LIGHT_DIFFUSE, WALR_LIGHT_SPECULAR); },
           .methods = {"accumulate"},
           .outputs = {"denoised", "second_denoised"}});
}

void ConformanceTest::hasOrthographicCameras() {
  compare({.state = [](WalrDenoiserInfo&, WalrConventions& conventions) { conventions.orthographic = VK_TRUE; },
           .change =
               [](std::uint32_t, WalrCamera& camera, WalrPassFrame&) {
                 constexpr float kParallel[16] = {0.5F, 0, 0, 0, 0, 0.5F, 0, 0, 0, 0, -0.01F, 0, 0, 0, 0, 1};
                 std::ranges::copy(kParallel, camera.projection);
               }});
}

// All comparisons state when their frames are finished. Here a frame claims a value that it does not reach.
void ConformanceTest::hasCompletionByASemaphore() {
  const auto refuseTheNext = [&](HostedDenoiser& hosted, Opaque&) {
    const WalrDenoiserInfo described = info("walr", kSize);
    const Inputs inputs = inputsOf(described, 4, true);
    const WalrCamera camera = cameraAt(4.0F * kStep);
    WalrPassFrame frame = passFrame(camera);
    const auto [semaphore, value] = hosted.nextCompletion();
    frame.finished = semaphore;
    frame.finished_value = value + 1000;
    hosted.frame(inputs, frame, false);
    for (int attempt = 0; attempt < 2; ++attempt) {
      try {
        hosted.frame(inputs, frame, false);
        FAIL() << "the frame before is not finished";
      } catch (const std::runtime_error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("not finished frame 4"), std::string::npos) << text;
        EXPECT_NE(text.find("slot 0 of 1"), std::string::npos) << text;
        EXPECT_NE(text.find("must be at " + std::to_string(value + 1000)), std::string::npos) << text;
      }
    }
  };
  compare({.state = [](WalrDenoiserInfo& info, WalrConventions&) { info.frames_in_flight = 1; },
           .methods = {"walr"},
           .finally = refuseTheNext});
}

}  // namespace plugin_host
