// The plug-in in hosts of different kinds. They denoise the same frames with one opaque call and pass by pass in the
// host's own graph.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "conformance.h"
#include "stage_host.h"
#include "tests/guide_table.h"
#include "tiny_host.h"

namespace plugin_host {
namespace {

TEST_F(PluginTest, RegistersEveryPassTypeAndTheFunctionTable) {
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

TEST_F(PluginTest, EveryMethodGivesTheSamePixelsPassByPass) {
  for (const WalrPassType* type : registered.types) {
    if (type->method == VK_FALSE) continue;
    for (const Size size : {Size{45, 37}, Size{40, 45}}) {
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

class TinyGraphFeatures : public WayTest<tiny_host::Graph>, public testing::WithParamInterface<Feature> {};

TEST_P(TinyGraphFeatures, GiveThePixelsOfAPlainHost) {
  check(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Every, TinyGraphFeatures, testing::ValuesIn(features()), nameOfFeature);

// A host keeps its history while it alternates between passes of different sizes.
TEST_F(PluginTest, HistoryIsKeptPassByPassAtAnotherSize) {
  constexpr Size kSizes[] = {{45, 37}, {47, 39}};
  constexpr std::size_t kTurns[] = {0, 0, 1, 0};  // By frame.
  expectTheOpaqueCallAtSizes<tiny_host::Graph>(kSizes, kTurns);
}

TEST_F(PluginTest, PassesContinueOnlyFromPassesOfTheSameMethod) {
  WalrConventions conventions{};
  conventions.struct_size = sizeof(conventions);
  conventions.rectangle = VK_TRUE;
  const auto make = [&](const char* method, Size size, bool rectangle) {
    WalrDenoiserInfo whole = info(method, size);
    if (rectangle) whole.conventions = &conventions;
    return makePasses(whole);
  };
  const WalrPasses small = make("svgf", {48, 36}, true);
  const WalrPasses large = make("svgf", {64, 48}, true);
  const WalrPasses whole = make("svgf", {64, 48}, false);
  const WalrPasses other = make("accumulate", {64, 48}, true);
  const auto refused = [&](WalrPasses passes, WalrPasses last, WalrResult result, const char* why) {
    EXPECT_EQ(api().continue_passes(passes, last), result);
    EXPECT_NE(std::string(api().last_error()).find(why), std::string::npos) << api().last_error();
  };
  refused(large, small, WALR_ERROR_WRONG_ORDER, "walr_begin_frame");
  const WalrCamera camera = cameraAt(0);
  const WalrPassFrame frame = passFrame(camera);
  EXPECT_EQ(api().begin_frame(small, &frame), WALR_SUCCESS);
  refused(large, large, WALR_ERROR_INVALID_ARGUMENT, "themselves");
  refused(whole, small, WALR_ERROR_INVALID_ARGUMENT, "WalrConventions::rectangle");
  refused(other, small, WALR_ERROR_INVALID_ARGUMENT, "same method");
  refused(large, nullptr, WALR_ERROR_INVALID_HANDLE, "null");
  refused(nullptr, small, WALR_ERROR_INVALID_HANDLE, "null");
  EXPECT_EQ(api().continue_passes(large, small), WALR_SUCCESS);
  for (const WalrPasses passes : {small, large, whole, other}) EXPECT_EQ(api().destroy_passes(passes), WALR_SUCCESS);
  refused(large, small, WALR_ERROR_INVALID_HANDLE, "destroyed");
}

TEST_F(PluginTest, ChecksInputsAndMeasuresTimesPassByPass) {
  constexpr Size kSize{45, 37};
  WalrConventions conventions{};
  conventions.struct_size = sizeof(conventions);
  conventions.motion_scale[0] = conventions.motion_scale[1] = -1.0F;  // Wrong.
  WalrDenoiserInfo checked = info("walr", kSize);
  checked.conventions = &conventions;
  checked.lint = checked.timestamps = checked.counters = VK_TRUE;
  Opaque opaque(host, api(), checked);
  const WalrPasses passes = makePasses(checked);
  const WalrPassList* list = nullptr;
  ASSERT_EQ(api().get_pass_list(passes, &list), WALR_SUCCESS);
  {
    tiny_host::Graph graph(host, api(), passes);
    for (std::uint32_t frame = 0; frame < 6; ++frame) {
      const WalrCamera camera = cameraAt(float(frame) * kStep);
      uploadFrame(host, kSize, frame, [&](std::size_t i) { return &opaque.image(i); });
      uploadFrame(host, kSize, frame, [&](std::size_t i) { return &graph.image(kInputs[i]); });
      opaque.frame(camera, 0);
      graph.frame(passFrame(camera));
      EXPECT_EQ(download(host, graph.image("denoised")), download(host, opaque.output()));
    }
  }
  std::array<WalrFinding, 16> expected{};
  std::array<WalrFinding, 16> found{};
  std::uint32_t expectedCount = 16;
  std::uint32_t foundCount = 16;
  ASSERT_EQ(api().get_findings(opaque.denoiser(), &expectedCount, expected.data()), WALR_SUCCESS);
  ASSERT_EQ(api().get_pass_findings(passes, &foundCount, found.data()), WALR_SUCCESS);
  ASSERT_GT(foundCount, 0U);
  ASSERT_EQ(foundCount, expectedCount);
  for (std::uint32_t i = 0; i < foundCount; ++i) EXPECT_STREQ(found.at(i).what, expected.at(i).what);
  std::array<WalrCounter, 64> expectedCounters{};
  std::array<WalrCounter, 64> counters{};
  expectedCount = foundCount = 64;
  ASSERT_EQ(api().get_counters(opaque.denoiser(), &expectedCount, expectedCounters.data()), WALR_SUCCESS);
  ASSERT_EQ(api().get_pass_counters(passes, &foundCount, counters.data()), WALR_SUCCESS);
  ASSERT_GT(foundCount, 0U);
  ASSERT_EQ(foundCount, expectedCount);
  EXPECT_STREQ(counters[0].name, "sky");
  EXPECT_TRUE(std::ranges::any_of(counters, [](const WalrCounter& counter) {
    return counter.name != nullptr && std::string(counter.name) == "lint-pixels" && counter.value > 0;
  }));
  for (std::uint32_t i = 0; i < foundCount; ++i) {
    EXPECT_STREQ(counters.at(i).name, expectedCounters.at(i).name);
    EXPECT_EQ(counters.at(i).value, expectedCounters.at(i).value) << counters.at(i).name;
  }
  std::vector<WalrPassTime> times(list->pass_count);
  std::uint32_t timeCount = list->pass_count;
  ASSERT_EQ(api().get_pass_timings(passes, &timeCount, times.data()), WALR_SUCCESS);
  ASSERT_EQ(timeCount, list->pass_count);
  for (std::uint32_t i = 0; i < timeCount; ++i) {
    EXPECT_STREQ(times[i].name, list->passes[i]->name);
    EXPECT_GE(times[i].milliseconds, 0.0);
  }
  EXPECT_EQ(api().destroy_passes(passes), WALR_SUCCESS);

  // Without lint there are no findings to return, and a single stage cannot have it.
  const WalrPasses unchecked = makePasses("walr", kSize);
  EXPECT_EQ(api().get_pass_findings(unchecked, &foundCount, nullptr), WALR_ERROR_WRONG_ORDER);
  EXPECT_EQ(api().destroy_passes(unchecked), WALR_SUCCESS);
  WalrPasses stage = nullptr;
  checked.method = "pass_through";
  checked.conventions = nullptr;
  WalrPassesInfo stageInfo{};
  stageInfo.struct_size = sizeof(stageInfo);
  stageInfo.denoiser = &checked;
  EXPECT_EQ(api().create_passes(&stageInfo, &stage), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_NE(std::string(api().last_error()).find("whole method"), std::string::npos) << api().last_error();
}

TEST_F(PluginTest, AFramesIndexSeedsItsRandomNumbers) {
  constexpr Size kSize{45, 37};
  Opaque counted(host, api(), info("walr", kSize));
  Opaque given(host, api(), info("walr", kSize));
  Opaque other(host, api(), info("walr", kSize));
  bool differs = false;
  for (std::uint32_t frame = 0; frame < 4; ++frame) {
    const WalrCamera camera = cameraAt(float(frame) * kStep);
    for (Opaque* opaque : {&counted, &given, &other}) {
      uploadFrame(host, kSize, frame, [&](std::size_t i) { return &opaque->image(i); });
    }
    counted.frame(camera, 0);
    given.frame(camera, WALR_FRAME_INDEX_GIVEN, frame);
    other.frame(camera, WALR_FRAME_INDEX_GIVEN, 1000 + frame);
    EXPECT_EQ(download(host, given.output()), download(host, counted.output()));
    differs = differs || download(host, other.output()) != download(host, counted.output());
  }
  EXPECT_TRUE(differs);
}

/// A stage of a chain with its settings.
struct Link {
  const char* stage;
  std::vector<WalrSettingValue> settings;
  std::map<std::string, std::string> renamed = {};
};

TEST_F(PluginTest, SingleStagesGiveThePixelsOfTheWholeMethod) {
  constexpr Size kSize{640, 360};  // `walr` derives settings from the size; the chain's settings are for this one.
  const std::vector<WalrSettingValue> packed{{"accumulation.storage", "packed"}, {"antialiasing.storage", "packed"}};
  const auto with = [&](std::vector<WalrSettingValue> settings) {
    settings.insert(settings.end(), packed.begin(), packed.end());
    return settings;
  };
  const std::map<std::string, std::vector<Link>> chains{
      {"accumulate",
       {{"prepare_guides", {}}, {"temporal_accumulation", {}}, {"pass_through", {}, {{"filtered", "accumulated"}}}}},
      {"walr",
       {{"prepare_guides_with_occlusion", {}},
        {"temporal_accumulation_with_taps", with({{"accumulation.max-history", "8"},
                                                  {"accumulation.plane-tolerance", "0.005"},
                                                  {"accumulation.normal-threshold", "0.9"},
                                                  {"accumulation.antilag", "on"}})},
        {"block_regression",
         with({{"blocks.iterations", "2"}, {"accumulation.max-history", "8"}, {"accumulation.antilag", "on"}})},
        {"temporal_antialiasing_with_taps",
         {{"antialiasing.clip-gamma", "5"},
          {"antialiasing.plane-tolerance", "0.005"},
          {"antialiasing.normal-threshold", "0.9"},
          {"antialiasing.storage", "packed"}}}}}};
  const auto compare = [&](const std::string& method, const std::vector<Link>& links, VkFormat confidence) {
    const auto described = [&](const char* name) {
      WalrDenoiserInfo result = info(name, kSize);
      result.confidence_format = confidence;
      return result;
    };
    Opaque opaque(host, api(), described(method.c_str()));
    // No stage steers the history of another one.
    if (method == "walr") require(api().set_setting(opaque.denoiser(), "blocks.residual", "off"));
    stage_host::Chain chain(host, api());
    for (const Link& link : links) chain.add(described(link.stage), link.settings, link.renamed);
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
      SCOPED_TRACE(method + ", frame " + std::to_string(frame));
      if (confidence != VK_FORMAT_UNDEFINED) {
        for (HostImage* const image : {&opaque.image("confidence"), chain.image("confidence")}) {
          host_upload(&host, image, texels("confidence", kSize, frame).data());
        }
      }
      uploadFrame(host, kSize, frame, [&](std::size_t i) { return &opaque.image(i); });
      for (const char* name : kInputs) {
        if (HostImage* image = chain.image(name)) host_upload(&host, image, texels(name, kSize, frame).data());
      }
      const WalrCamera camera = cameraAt(float(frame) * kStep);
      opaque.frame(camera, 0);
      chain.frame(passFrame(camera));
      EXPECT_EQ(download(host, *chain.image("denoised")), download(host, opaque.output()));
    }
  };
  for (const auto& [method, links] : chains) {
    compare(method, links, VK_FORMAT_UNDEFINED);
    compare(method, links, VK_FORMAT_R32_SFLOAT);
  }
}

TEST_F(PluginTest, WrongUseOfStagesIsAnError) {
  const auto refused = [&](const WalrDenoiserInfo& whole, std::vector<WalrPortFormat> ports, const char* why) {
    WalrPassesInfo passesInfo{};
    passesInfo.struct_size = sizeof(passesInfo);
    passesInfo.denoiser = &whole;
    passesInfo.ports = ports.data();
    passesInfo.port_count = static_cast<std::uint32_t>(ports.size());
    WalrPasses passes = nullptr;
    EXPECT_EQ(api().create_passes(&passesInfo, &passes), WALR_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(api().last_error()).find(why), std::string::npos) << api().last_error();
  };
  constexpr Size kSize{64, 48};
  const WalrDenoiserInfo stage = info("weighted_regression", kSize);
  refused(stage, {{"acumulated", VK_FORMAT_R32_UINT, 0}}, "no input \"acumulated\"; with these settings it has: ");
  refused(stage, {{"accumulated", VK_FORMAT_R32_SFLOAT, 0}}, "takes R16G16B16A16_SFLOAT, but R32_SFLOAT");
  refused(stage, {{nullptr, VK_FORMAT_R32_SFLOAT, 0}}, "WalrPortFormat::port is null");
  refused(info("prepare_guides", kSize), {{"depth", VK_FORMAT_D32_SFLOAT, 0}}, "WalrDenoiserInfo");
  refused(info("walr", kSize), {{"accumulated", VK_FORMAT_R32_UINT, 0}}, "whole method");
  refused(info("weighted_regresion", kSize), {}, "weighted_regresion");
  WalrConventions conventions{};
  conventions.struct_size = sizeof(conventions);
  conventions.depth = WALR_DEPTH_DEVICE;
  WalrDenoiserInfo converted = info("prepare_guides", kSize);
  converted.conventions = &conventions;
  refused(converted, {}, "takes linear depth");
  WalrDenoiser denoiser = nullptr;
  EXPECT_EQ(api().create_denoiser(&stage, &denoiser), WALR_ERROR_INVALID_ARGUMENT);
}

// Hosts with synchronization2 may leave inputs in this layout.
TEST_F(PluginTest, ReadsFromReadOnlyOptimal) {
  constexpr Size kSize{45, 37};
  Opaque opaque(host, api(), info("none", kSize));
  const WalrPasses passes = makePasses("none", kSize);
  const WalrPassList* list = nullptr;
  require(api().get_pass_list(passes, &list));
  ASSERT_EQ(list->pass_count, 1);
  const WalrCamera camera = cameraAt(0);
  const auto imageOf = [&](std::size_t i) { return &opaque.image(i); };
  uploadFrame(host, kSize, 0, imageOf);
  opaque.frame(camera, 0);
  const std::vector<std::uint16_t> expected = download(host, opaque.output());
  uploadFrame(host, kSize, 1, imageOf);
  opaque.frame(camera, 0);
  EXPECT_NE(download(host, opaque.output()), expected);
  uploadFrame(host, kSize, 0, imageOf);
  const WalrPassFrame frame = passFrame(camera);
  require(api().begin_frame(passes, &frame));
  const VkCommandBuffer commands = host_begin(&host);
  std::vector<WalrPassResource> resources;
  for (std::uint32_t b = 0; b < list->passes[0]->binding_count; ++b) {
    const WalrBinding& binding = *list->passes[0]->bindings[b];
    const bool output = binding.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    HostImage& image = output ? opaque.output() : opaque.image(0);
    host_transition(commands, &image, binding.stage, binding.access,
                    output ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL);
    resources.push_back({image.image, VK_NULL_HANDLE, 0, image.layout, 0});
  }
  const auto count = static_cast<std::uint32_t>(resources.size());
  require(api().record_pass(passes, 0, commands, resources.data(), count));
  host_submit_and_wait(&host, commands);
  EXPECT_EQ(download(host, opaque.output()), expected);
  EXPECT_EQ(api().destroy_passes(passes), WALR_SUCCESS);
}

// Missing barriers do not change pixels here, so validation must report them. This shows that it is enabled.
TEST_F(PluginTest, ValidationReportsMissingBarriers) {
  const WalrPasses passes = makePasses("walr", {45, 37});
  {
    tiny_host::Graph graph(host, api(), passes);
    uploadFrame(host, {45, 37}, 0, [&](std::size_t i) { return &graph.image(kInputs[i]); });
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

// Compares the table of memory in the integration guide with the driver's values.
TEST_F(PluginTest, MemoryInTheGuideIsWhatTheDriverRequires) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(host.physical_device, &properties);
  if (properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU) {
    GTEST_SKIP() << "the guide's sizes are those of lavapipe; " << properties.deviceName << " aligns otherwise";
  }
  constexpr double kMebibyte = 1024.0 * 1024.0;
  std::string table =
      "| size | opaque, MiB | each further view, MiB | pass by pass, MiB |\n"
      "| --- | --- | --- | --- |\n";
  for (const Size size : {Size{1920, 1080}, Size{2560, 1440}, Size{3840, 2160}}) {
    WalrDenoiserInfo whole = info("walr", size);
    WalrDenoiser denoiser = nullptr;
    WalrDenoiser further = nullptr;
    require(api().create_denoiser(&whole, &denoiser));
    whole.shared_with = denoiser;
    require(api().create_denoiser(&whole, &further));
    WalrMemory memory{};
    memory.struct_size = sizeof(memory);
    for (const WalrDenoiser each : {denoiser, further}) {
      require(api().prepare(each));
      require(api().get_memory(each, &memory));
    }
    require(api().destroy_denoiser(further));
    require(api().destroy_denoiser(denoiser));
    const WalrPasses passes = makePasses("walr", size);
    {
      const tiny_host::Graph graph(host, api(), passes);
      EXPECT_EQ(graph.bytes(), graph.listedBytes());
      EXPECT_EQ(graph.listedBytes(), memory.persistent + memory.transient_unaliased);
      EXPECT_LT(memory.allocated, graph.bytes());
      char row[128];
      std::snprintf(row, sizeof(row), "| %u x %u | %.1f | %.1f | %.1f |\n", size.width, size.height,
                    double(memory.allocated) / kMebibyte, double(memory.allocated - memory.shared) / kMebibyte,
                    double(graph.bytes()) / kMebibyte);
      table += row;
    }
    EXPECT_EQ(api().destroy_passes(passes), WALR_SUCCESS);
  }
  const walr::test::GuideTable guide(WALR_GUIDE "/frames.md", "Memory");
  if (walr::test::GuideTable::writing()) return guide.write(table);
  EXPECT_EQ(guide.text(), table) << "build the target update_guide";
}

TEST_F(PluginTest, WrongUseOfPassesIsAnError) {
  const WalrPasses passes = makePasses("walr", {45, 37});
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

  // Without a device, passes can only be listed.
  WalrDenoiserInfo listed = info("walr", {64, 48});
  listed.device = nullptr;
  const WalrSettingValue settings[] = {{"blocks.iterations", "9"}};
  WalrPassesInfo passesInfo{sizeof(WalrPassesInfo), 1, &listed, settings, nullptr, 0, 0};
  WalrPasses plain = nullptr;
  EXPECT_EQ(api().create_passes(&passesInfo, &plain), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_NE(text().find("1..4"), std::string::npos);
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
}  // namespace plugin_host
