// Promises of WALR's plan, on any device: traffic, memory, and no resource that no pass reads.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "framegraph/compile/compile.h"
#include "shaders/conventions/frame.h"
#include "shaders/regression/block_regression.h"
#include "tests/passes/any_walr.h"

namespace walr {
namespace {

constexpr fg::Extent kFullHd{1920, 1080};

struct Planned {
  fg::Graph graph;
  fg::Plan plan;

  /// Declared traffic in whole bytes per pixel; the frame constants add less than a thousandth.
  [[nodiscard]] std::uint64_t bytesPerPixel() const {
    return (plan.traffic.bytesRead + plan.traffic.bytesWritten) / plan.traffic.pixels;
  }
  [[nodiscard]] bool uses(const std::string& resource) const {
    for (std::size_t i = 0; i < graph.desc().resources.size(); ++i)
      if (graph.desc().resources[i].name == resource) return plan.resources[i].used;
    return false;
  }
};

Planned planWalr(const test::AnyWalr& settings, const SceneDescription& scene = {}, fg::Extent extent = kFullHd,
                 const LightPattern& light = {}) {
  const fg::ExternalState state{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  const fg::TextureDesc colour{VK_FORMAT_R16G16B16A16_SFLOAT, extent};
  Planned planned;
  fg::Graph& graph = planned.graph;
  DenoiserInputs inputs;
  inputs.lighting = graph.import("lighting", {colour.format, light.lightingExtent(extent)}, state);
  inputs.conventions.light = light;
  inputs.depth = graph.import("depth", {VK_FORMAT_R32_SFLOAT, extent}, state);
  inputs.normal = graph.import("normal", colour, state);
  inputs.motion = graph.import("motion", colour, state);
  inputs.albedo = graph.import("albedo", colour, state);
  inputs.scene = scene;
  inputs.frame = graph.upload("frame constants", sizeof(FrameConstants));
  const fg::Texture output = graph.import("output", colour, state);
  const fg::Texture denoised = settings.blocks() != nullptr ? addWalr(graph, inputs, output, *settings.blocks())
                                                            : addWalrPaper(graph, inputs, output, *settings.pixels());
  graph.exported(denoised, state);
  fg::CompileResult result = fg::compile(graph.desc(), fg::TableMemoryModel());
  EXPECT_TRUE(result.ok()) << result.text();
  planned.plan = std::move(result.plan);
  return planned;
}

// The project's budgets for the paper's pipeline at 1080p. Each pass counts every texel of each of its accesses once.
TEST(WalrPlan, ThePaperMovesNoMoreThanItsBudget) {
  WalrPaperSettings settings = paperWalr();
  EXPECT_LE(planWalr(settings).bytesPerPixel(), 350U);
  settings.regression.storage = MomentStorage::Raw11;
  EXPECT_LE(planWalr(settings).bytesPerPixel(), 280U);
}

// The project's budget for the default at 1080p: histories, and transients that cannot alias them.
TEST(WalrPlan, TheDefaultNeedsNoMoreMemoryThanItsBudget) {
  const fg::MemoryReport memory = planWalr(WalrSettings{}).plan.memory;
  EXPECT_LE(memory.persistentBytes + memory.transientPeakBytes, 91'000'000U);
}

/// Standard deviation of the coarse window at one sample per pixel, in cells. At 1080 rows a cell has 8 x 8 texels of
/// light.
float coarseSigmaOf(const Planned& planned) {
  for (const fg::PassDecl& pass : planned.graph.desc().passes) {
    const auto* work = std::get_if<fg::ComputeDispatch>(&pass.work);
    if (work == nullptr || work->shader->name != "block_coarse") continue;
    BlockRegressionConstants constants{};
    std::memcpy(&constants, work->constants.data(), sizeof(constants));
    return constants.coarseSigma;
  }
  throw std::runtime_error("the plan has no coarse window");
}

// Each pixel of a light grid stands for several, which the coarse window has to make up for. Accumulation has no light
// grid if it leaves anti-aliasing to the host: every pixel then has a mean.
TEST(WalrPlan, TheCoarseWindowIsWiderOnALightGridOnly) {
  const LightPattern quarter{.columns = 2, .rows = 2};
  const WalrSettings settings;
  const float full = settings.blocks.coarseSigma * float(kFullHd.height) / 8.0F;
  EXPECT_FLOAT_EQ(coarseSigmaOf(planWalr(settings)), full);
  EXPECT_FLOAT_EQ(coarseSigmaOf(planWalr(settings, {}, kFullHd, quarter)), std::cbrt(4.0F) * full / 2.0F);
  EXPECT_FLOAT_EQ(coarseSigmaOf(planWalr(settings, {.hostAntialiasing = true}, kFullHd, quarter)), full);
}

// The project's budget, from the size on at which blocks have their full size.
TEST(WalrPlan, MovesAtMostHalfOfWhatThePaperMoves) {
  for (const fg::Extent extent : {fg::Extent{612, 344}, fg::Extent{960, 540}, kFullHd, fg::Extent{3840, 2160}}) {
    const std::uint64_t paper = planWalr(paperWalr(), {}, extent).bytesPerPixel();
    EXPECT_LE(2 * planWalr(WalrSettings{}, {}, extent).bytesPerPixel(), paper) << extent.height;
  }
}

// The project's budget for sparse light: at one sample for four pixels, 15 % less than at one for each.
TEST(WalrPlan, SparseLightMovesFewerBytes) {
  const auto bytes = [](const LightPattern& light) {
    const fg::TrafficReport traffic = planWalr(WalrSettings{}, {}, kFullHd, light).plan.traffic;
    return double(traffic.bytesRead + traffic.bytesWritten);
  };
  EXPECT_LE(bytes({2, 2}), 0.85 * bytes({}));
}

// Blocks have 4 x 4 pixels below 215 lines and 8 x 8 from 344 lines on, unless `walr.fit-window` is off.
TEST(WalrPlan, BlocksFitThePicture) {
  const auto blocksOf = [](const WalrSettings& settings, fg::Extent extent) {
    const Planned planned = planWalr(settings, {}, extent);
    for (const auto& resource : planned.graph.desc().resources)
      if (resource.name == "block normal") return std::get<fg::TextureDesc>(resource.desc).extent;
    return fg::Extent{};
  };
  EXPECT_EQ(blocksOf({}, {192, 108}), (fg::Extent{48, 27}));
  EXPECT_EQ(blocksOf({}, {384, 216}), (fg::Extent{77, 44}));
  EXPECT_EQ(blocksOf({}, {480, 270}), (fg::Extent{80, 45}));
  EXPECT_EQ(blocksOf({}, {640, 344}), (fg::Extent{80, 43}));
  WalrSettings unfitted;
  unfitted.fitWindow = false;
  EXPECT_EQ(blocksOf(unfitted, {384, 216}), (fg::Extent{48, 27}));
  unfitted.blocks.size = 3;
  EXPECT_EQ(blocksOf(unfitted, {384, 216}), (fg::Extent{128, 72}));
}

TEST(WalrPlan, TransientMemoryIsTheLeastThatItsScheduleAllows) {
  for (const WalrPaperSettings& settings : {robustWalr(), paperWalr()}) {
    const fg::Plan plan = planWalr(settings).plan;
    EXPECT_EQ(plan.memory.transientPeakBytes, plan.memory.transientLowerBoundBytes);
  }
}

TEST(WalrPlan, HoldsOnlyWhatItsSettingsRead) {
  const Planned robust = planWalr(robustWalr());
  EXPECT_TRUE(robust.uses("albedo"));
  EXPECT_TRUE(robust.uses("guides.geometric normal.current"));
  const Planned paper = planWalr(paperWalr());
  EXPECT_FALSE(paper.uses("albedo"));
  EXPECT_FALSE(paper.uses("guides.geometric normal.current"));
  WalrPaperSettings host = robustWalr();
  host.antialiasing.enabled = false;
  const Planned withoutAntialiasing = planWalr(host);
  EXPECT_FALSE(withoutAntialiasing.uses("resolved.current"));
  EXPECT_FALSE(withoutAntialiasing.uses("filtered"));
  EXPECT_FALSE(withoutAntialiasing.uses("history taps"));
}

TEST(WalrPlan, HoldsOnlyWhatTheSceneNeeds) {
  const Planned all = planWalr(robustWalr());
  for (const char* resource : {"motion", "history taps", "resolved.current", "guides.depth.previous"})
    EXPECT_TRUE(all.uses(resource)) << resource;

  EXPECT_FALSE(planWalr(robustWalr(), {.objectMotion = false}).uses("motion"));
  EXPECT_FALSE(planWalr(robustWalr(), {.hostAntialiasing = true}).uses("resolved.current"));
  const Planned still = planWalr(robustWalr(), {.cameraMotion = false, .objectMotion = false, .jitter = false});
  for (const char* resource : {"motion", "history taps", "guides.depth.previous", "guides.geometric normal.previous"})
    EXPECT_FALSE(still.uses(resource)) << resource;
  EXPECT_LT(still.plan.memory.persistentBytes, all.plan.memory.persistentBytes);
  EXPECT_LT(still.bytesPerPixel(), all.bytesPerPixel());
}

TEST(WalrPlan, IsOneFilterAloneWithoutTemporalStages) {
  WalrPaperSettings settings = robustWalr();
  settings.spatialOnly = true;
  const Planned spatial = planWalr(settings);
  EXPECT_EQ(spatial.plan.memory.persistentBytes, 0U);
  EXPECT_EQ(spatial.plan.passes.size(), 1U + settings.regression.iterations);
}

}  // namespace
}  // namespace walr
