// Views and counters through the C API.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <walr/walr_passes.h>

#include "passes/methods/denoiser.h"
#include "tests/integration/hosted_run.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::views_test {
namespace {

using reference::HostFrame;

constexpr glm::ivec2 kSize(45, 37);

/// A frame of a camera that moves beside a surface with sky around it.
struct Take {
  explicit Take(std::uint32_t index)
      : camera(cameraAt({0.06 * index, 0.0, 0.0}, {0.06 * (index - 1.0), 0.0, 0.0}, kSize, index)),
        frame(renderFrame(skyBesideSurface(), camera, kSize)) {}

  void fill(HostedRun& run) const { run.fill(frame); }
  [[nodiscard]] bool sky(glm::ivec2 p) const { return frame.depth[p] >= 1e9; }
  [[nodiscard]] std::uint64_t skyPixels() const {
    std::uint64_t count = 0;
    reference::forEachPixel(kSize, [&](glm::ivec2 p) { count += sky(p) ? 1 : 0; });
    return count;
  }

  FrameDescription camera;
  HostFrame frame;
};

std::map<std::string, std::uint64_t> countersOf(WalrDenoiser denoiser) {
  std::map<std::string, std::uint64_t> byName;
  for (const WalrCounter& counter : listed(walr_get_counters, denoiser))
    EXPECT_TRUE(byName.emplace(counter.name, counter.value).second);
  return byName;
}

class CApiViews : public fg::test::GpuTest {};

std::vector<std::string> viewsOf(WalrDenoiser denoiser) {
  std::vector<std::string> names;
  for (const WalrView& view : listed(walr_get_views, denoiser)) {
    EXPECT_GT(std::strlen(view.description), 0U);
    names.emplace_back(view.name);
  }
  return names;
}

// Light with a sample for 2 x 2 pixels is accumulated on a grid of its own, which offers fewer views.
TEST_F(CApiViews, ThatAreListedCanBeChosen) {
  HostedRun::Options options;
  options.conventions.struct_size = sizeof(WalrConventions);
  options.conventions.light_group[0] = options.conventions.light_group[1] = 2;
  const HostedRun run(device(), "walr", kSize, options);
  const std::vector<std::string> names = viewsOf(run.denoiser());
  EXPECT_GT(names.size(), 5U);
  EXPECT_LT(names.size(), makeDenoiser("walr")->views().size());
  for (const std::string& name : names) EXPECT_EQ(walr_set_view(run.denoiser(), name.c_str()), WALR_SUCCESS) << name;
}

TEST_F(CApiViews, AreListedForTheCurrentSettings) {
  HostedRun run(device(), "walr", kSize);
  const auto names = [&] { return viewsOf(run.denoiser()); };
  const auto method = makeDenoiser("walr");
  const auto expected = [&] {
    std::vector<std::string> listed;
    for (const ViewInfo& view : method->views()) listed.emplace_back(view.name);
    return listed;
  };
  EXPECT_EQ(names(), expected());
  require(walr_set_setting(run.denoiser(), "antialiasing.enabled", "off"));
  EXPECT_NE(names(), expected());
  method->set("antialiasing.enabled", "off");
  EXPECT_EQ(names(), expected());
}

TEST_F(CApiViews, ShowWhatHappensAndChangeNothing) {
  HostedRun plain(device(), "walr", kSize);
  HostedRun viewed(device(), "walr", kSize);
  for (std::uint32_t i = 0; i < 6; ++i) {
    if (i == 1) viewed.chooseView("no-surface");
    if (i == 3) viewed.chooseView("history");
    if (i == 5) viewed.chooseView(nullptr);
    const Take take(i);
    take.fill(plain);
    take.fill(viewed);
    EXPECT_EQ(plain.frame(take.camera), viewed.frame(take.camera)) << i;
    if (i != 1 && i != 2) continue;
    const std::vector<glm::vec4> texels = viewed.view();
    ASSERT_EQ(texels.size(), std::size_t(kSize.x) * kSize.y);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      EXPECT_EQ(texels[std::size_t(p.y) * kSize.x + p.x].x, take.sky(p) ? 1.0F : 0.0F)
          << i << ": " << p.x << " " << p.y;
    });
  }
  std::uint32_t count = 0;
  EXPECT_EQ(walr_get_counters(plain.denoiser(), &count, nullptr), WALR_ERROR_WRONG_ORDER);
}

TEST_F(CApiViews, ThatAreWrongAreErrorsWithANameInThem) {
  HostedRun run(device(), "walr", kSize);
  const auto said = [](const std::string& text) {
    return std::string(walr_last_error()).find(text) != std::string::npos;
  };
  EXPECT_EQ(walr_set_view(run.denoiser(), "edge"), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_TRUE(said("there is no view \"edge\"") && said("known views: no-surface")) << walr_last_error();
  EXPECT_EQ(walr_set_view(run.denoiser(), "clip.1"), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_TRUE(said("does not iterate")) << walr_last_error();
  const Take take(0);
  take.fill(run);
  run.frame(take.camera);  // The view is still none.

  require(walr_set_view(run.denoiser(), "clip"));
  EXPECT_THROW(run.frame(take.camera), std::runtime_error);
  EXPECT_TRUE(said("image 'view' is null")) << walr_last_error();
  require(walr_set_setting(run.denoiser(), "antialiasing.enabled", "off"));
  EXPECT_EQ(walr_prepare(run.denoiser()), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_TRUE(said("there is no view \"clip\" with these settings")) << walr_last_error();
  require(walr_set_view(run.denoiser(), nullptr));
  require(walr_prepare(run.denoiser()));
}

TEST_F(CApiViews, CountersCountTheFrameThatIsFinished) {
  HostedRun plain(device(), "walr", kSize);
  HostedRun counted(device(), "walr", kSize, {.lint = true, .counters = true});
  EXPECT_TRUE(countersOf(counted.denoiser()).empty());
  std::uint64_t sky = 0;
  for (std::uint32_t i = 0; i < 5; ++i) {
    const Take take(i);
    take.fill(plain);
    take.fill(counted);
    EXPECT_EQ(plain.frame(take.camera), counted.frame(take.camera)) << i;
    if (i == 2) sky = take.skyPixels();  // With two frames in flight, the last frame that frame 4 evaluates.
  }
  std::map<std::string, std::uint64_t> counters = countersOf(counted.denoiser());
  const std::uint64_t pixels = std::uint64_t(kSize.x) * kSize.y;
  EXPECT_GT(sky, 0U);
  EXPECT_EQ(counters["sky"], sky);
  EXPECT_EQ(counters["lint-pixels"], pixels);
  EXPECT_EQ(counters["lint-surfaces"], pixels - sky);
  EXPECT_EQ(counters.count("rejected-history-taps"), 1U);
}

TEST_F(CApiViews, CountersOfPassesAreThoseOfFinishedFrames) {
  WalrDevice host = hostDevice(device());
  WalrDenoiserInfo info = denoiserInfo(&host);
  info.counters = VK_TRUE;
  WalrPasses passes = nullptr;
  require(createPasses(info, passes));
  std::uint32_t count = 1;
  require(walr_get_pass_counters(passes, &count, nullptr));
  EXPECT_EQ(count, 0U);  // No frame is finished. PluginTest runs frames.
  require(walr_destroy_passes(passes));

  info.method = "none";  // Has no counters.
  require(createPasses(info, passes));
  count = 1;
  require(walr_get_pass_counters(passes, &count, nullptr));
  EXPECT_EQ(count, 0U);
  require(walr_destroy_passes(passes));
  info.method = nullptr;

  info.counters = VK_FALSE;
  require(createPasses(info, passes));
  EXPECT_EQ(walr_get_pass_counters(passes, &count, nullptr), WALR_ERROR_WRONG_ORDER);
  require(walr_destroy_passes(passes));
  info.counters = VK_TRUE;
  info.method = "pass_through";
  EXPECT_EQ(createPasses(info, passes), WALR_ERROR_INVALID_ARGUMENT);
  EXPECT_NE(std::string(walr_last_error()).find("WalrDenoiserInfo::counters for a whole method"), std::string::npos)
      << walr_last_error();
}

}  // namespace
}  // namespace walr::test::views_test
