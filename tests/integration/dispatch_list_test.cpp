// A host that executes the dispatch list as data (list_host.h), and the states in which a frame finds and leaves
// resources.
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

#include "conformance.h"
#include "list_host.h"

namespace plugin_host {
namespace {

using DispatchListTest = PluginTest;

TEST_F(DispatchListTest, HasHeapsOnlyWithADevice) {
  for (const bool withDevice : {true, false}) {
    WalrDenoiserInfo listed = info("walr", {64, 48});
    if (!withDevice) listed.device = nullptr;
    const WalrPasses passes = makePasses(listed);
    const WalrPassList* list = nullptr;
    ASSERT_EQ(api().get_pass_list(passes, &list), WALR_SUCCESS);
    EXPECT_EQ(list->heap_count > 0, withDevice);
    std::uint32_t placed = 0;
    std::uint32_t aliases = 0;
    for (std::uint32_t i = 0; i < list->resource_count; ++i) placed += list->resources[i]->heap != WALR_NONE ? 1 : 0;
    for (std::uint32_t p = 0; p < list->pass_count; ++p) {
      for (std::uint32_t b = 0; b < list->passes[p]->barrier_count; ++b) {
        aliases += list->passes[p]->barriers[b].alias_of != WALR_NONE ? 1 : 0;
      }
    }
    EXPECT_EQ(placed > 0, withDevice);
    EXPECT_EQ(aliases > 0, withDevice);
    EXPECT_EQ(api().destroy_passes(passes), WALR_SUCCESS);
  }
}

TEST_F(DispatchListTest, EveryMethodGivesThePixelsOfTheOpaqueCall) {
  constexpr Size kSize{45, 37};
  struct Submission {
    std::size_t frames;
    bool reset;
  };
  constexpr Submission kSubmissions[] = {{1, false}, {2, false}, {1, true}, {2, true}, {1, false}};
  for (const WalrPassType* type : registered.types) {
    if (type->method == VK_FALSE) continue;
    Opaque opaque(host, api(), info(type->name, kSize));
    const WalrPasses passes = makePasses(type->name, kSize);
    {
      list_host::Player player(host, api(), passes);
      std::uint32_t number = 0;
      for (const Submission& submission : kSubmissions) {
        SCOPED_TRACE(std::string(type->name) + ", frame " + std::to_string(number));
        uploadFrame(host, kSize, number, [&](std::size_t i) { return &opaque.image(i); });
        uploadFrame(host, kSize, number, [&](std::size_t i) { return &player.image(kInputs[i]); });
        std::vector<WalrCamera> cameras;
        for (std::size_t i = 0; i < submission.frames; ++i) cameras.push_back(cameraAt(float(number++) * kStep));
        std::vector<WalrPassFrame> frames;
        for (const WalrCamera& camera : cameras) {
          opaque.frame(camera, submission.reset && frames.empty() ? WALR_FRAME_RESET_HISTORY : 0);
          frames.push_back(passFrame(camera));
        }
        if (submission.reset) player.resetHistory();
        player.frames(frames);
        EXPECT_EQ(download(host, player.image("denoised")), download(host, opaque.output()));
      }
    }
    EXPECT_EQ(host.messages, 0) << type->name;
    EXPECT_EQ(api().destroy_passes(passes), WALR_SUCCESS);
  }
}

class DispatchListFeatures : public WayTest<list_host::Player>, public testing::WithParamInterface<Feature> {
 protected:
  [[nodiscard]] std::string lacks(std::string_view feature) const override {
    if (feature == "PipelineCache") return "a host that executes the list creates the pipelines itself";
    if (feature == "Counters") return "the library evaluates only what walr_record_pass has recorded";
    return WayTest::lacks(feature);
  }
};

TEST_P(DispatchListFeatures, GiveThePixelsOfAPlainHost) {
  check(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Every, DispatchListFeatures, testing::ValuesIn(features()), nameOfFeature);

TEST_F(DispatchListTest, AListOfAnotherSizeTakesOverTheHistory) {
  constexpr Size kSizes[] = {{45, 37}, {47, 39}};
  constexpr std::size_t kTurns[] = {0, 0, 1, 0};  // By frame.
  expectTheOpaqueCallAtSizes<list_host::Player>(kSizes, kTurns);
}

// A host that takes its states from the list alone shows that each of them is needed.
TEST_F(DispatchListTest, ValidationReportsAWrongState) {
  constexpr auto kOtherLayout = [](WalrImageState& state) {
    state.layout =
        state.layout == VK_IMAGE_LAYOUT_GENERAL ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_GENERAL;
  };
  constexpr auto kOtherStage = [](WalrImageState& state) {
    state.stage = VK_PIPELINE_STAGE_2_COPY_BIT;
    state.access = VK_ACCESS_2_NONE;
  };
  struct Case {
    const char* name;
    WalrResourceKind kind;
    WalrImageState WalrResource::*border;
    void (*change)(WalrImageState&);
  };
  const Case cases[] = {
      {"the layout in which a previous history enters", WALR_RESOURCE_HISTORY_PREVIOUS, &WalrResource::entry,
       kOtherLayout},
      {"the stage in which a previous history enters", WALR_RESOURCE_HISTORY_PREVIOUS, &WalrResource::entry,
       kOtherStage},
      {"the layout in which a current history leaves", WALR_RESOURCE_HISTORY_CURRENT, &WalrResource::exit,
       kOtherLayout},
      {"the layout in which the host's images enter", WALR_RESOURCE_HOST, &WalrResource::entry, kOtherLayout},
      {"the stage in which the host's images enter", WALR_RESOURCE_HOST, &WalrResource::entry, kOtherStage},
      {"the layout in which the host's images leave", WALR_RESOURCE_HOST, &WalrResource::exit, kOtherLayout},
      {"the stage in which the host's images leave", WALR_RESOURCE_HOST, &WalrResource::exit, kOtherStage},
  };
  constexpr Size kSize{45, 37};
  const WalrCamera camera = cameraAt(0);
  for (const Case& each : cases) {
    const WalrPasses passes = makePasses("accumulate", kSize);
    {
      list_host::Player player(host, api(), passes);
      player.falsify(each.kind, each.border, each.change);
      uploadFrame(host, kSize, 0, [&](std::size_t i) { return &player.image(kInputs[i]); });
      const WalrPassFrame frames[] = {passFrame(camera), passFrame(camera)};
      player.frames(frames);
      (void)download(host, player.image("denoised"));
    }
    EXPECT_GT(host.messages, 0) << each.name;
    host.messages = 0;
    EXPECT_EQ(api().destroy_passes(passes), WALR_SUCCESS);
  }
}

/// The state from which the list's first barrier of a resource leads, or that of its first use if no barrier comes
/// before it.
WalrImageState firstNeeded(const WalrPassList& list, std::uint32_t resource) {
  for (std::uint32_t p = 0; p < list.pass_count; ++p) {
    const WalrDispatch& pass = *list.passes[p];
    for (std::uint32_t b = 0; b < pass.barrier_count; ++b) {
      const WalrBarrier& barrier = pass.barriers[b];
      if (barrier.resource == resource) return {barrier.src_stage, barrier.src_access, barrier.old_layout, 0};
    }
    for (std::uint32_t b = 0; b < pass.binding_count; ++b) {
      const WalrBinding& binding = *pass.bindings[b];
      if (binding.resource == resource) return {binding.stage, binding.access, binding.layout, 0};
    }
  }
  return {};
}

TEST_F(DispatchListTest, EntryAndExitFitTheBarriersWithEveryPreset) {
  for (const WalrPassType* type : registered.types) {
    if (type->method == VK_FALSE) continue;
    std::vector<const char*> presets(type->presets, type->presets + type->preset_count);
    presets.push_back(nullptr);
    for (const char* preset : presets) {
      for (const bool withDevice : {true, false}) {
        WalrDenoiserInfo whole = info(type->name, {64, 48});
        whole.preset = preset;
        if (!withDevice) whole.device = nullptr;
        const WalrPasses passes = makePasses(whole);
        const WalrPassList* list = nullptr;
        require(api().get_pass_list(passes, &list));
        std::uint32_t histories = 0;
        for (std::uint32_t i = 0; i < list->resource_count; ++i) {
          const WalrResource& resource = *list->resources[i];
          SCOPED_TRACE(std::string(type->name) + ", " + (preset == nullptr ? "" : preset) + ", " + resource.name);
          const WalrImageState needed = firstNeeded(*list, i);
          EXPECT_EQ(resource.entry.stage, needed.stage);
          EXPECT_EQ(resource.entry.access & needed.access, needed.access);
          EXPECT_EQ(resource.entry.layout, resource.buffer == VK_TRUE ? VK_IMAGE_LAYOUT_UNDEFINED : needed.layout);
          const bool kept = resource.kind == WALR_RESOURCE_HOST || resource.kind == WALR_RESOURCE_HISTORY_PREVIOUS;
          if (resource.used == VK_TRUE && resource.buffer == VK_FALSE) {
            EXPECT_EQ(resource.entry.layout == VK_IMAGE_LAYOUT_UNDEFINED, !kept);
            EXPECT_NE(resource.exit.layout, VK_IMAGE_LAYOUT_UNDEFINED);
          }
          // Hosts keep their images in one layout from frame to frame.
          if (resource.kind == WALR_RESOURCE_HOST) {
            EXPECT_EQ(resource.exit.layout, resource.entry.layout);
          }
          if (resource.kind != WALR_RESOURCE_HISTORY_PREVIOUS || resource.used == VK_FALSE) continue;
          const WalrResource& partner = *list->resources[resource.partner];
          EXPECT_EQ(resource.entry.stage, partner.exit.stage);
          EXPECT_EQ(resource.entry.access, partner.exit.access);
          EXPECT_EQ(resource.entry.layout, partner.exit.layout);
          EXPECT_NE(resource.image_usage & VK_IMAGE_USAGE_TRANSFER_DST_BIT, 0);  // It can be cleared.
          EXPECT_NE(partner.image_usage & VK_IMAGE_USAGE_TRANSFER_DST_BIT, 0);
          ++histories;
        }
        // The method that only copies has no history.
        EXPECT_EQ(histories > 0, std::string(type->name) != "none") << type->name;
        EXPECT_EQ(api().destroy_passes(passes), WALR_SUCCESS);
      }
    }
  }
}

}  // namespace
}  // namespace plugin_host
