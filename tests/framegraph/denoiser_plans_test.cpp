#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framegraph/compile/compile.h"
#include "framegraph/inspect/inspect.h"
#include "framegraph/verify/verify.h"
#include "integration/denoise_graph.h"

/// Compares the plans of all denoisers with recorded ones, so that every change of a plan shows in review. There is one
/// text file per method and preset, for a fixed image size and the built-in memory table. After an intended change:
///
///     cmake --build build --target update_plans
namespace walr {
namespace {

namespace fs = std::filesystem;

constexpr fg::Extent kExtent = {1920, 1080};

/// A method with one of its presets.
struct Variant {
  std::string method;
  std::string preset;  ///< Empty if the method has none.

  [[nodiscard]] std::string name() const { return preset.empty() ? method : method + "-" + preset; }
};

std::vector<Variant> variants() {
  std::vector<Variant> list;
  for (const std::string& method : denoiserNames()) {
    std::vector<std::string> presets = makeDenoiser(method)->presets();
    if (presets.empty()) presets.emplace_back();
    for (const std::string& preset : presets) list.push_back({method, preset});
  }
  return list;
}

void PrintTo(const Variant& variant, std::ostream* out) {
  *out << variant.name();
}

fs::path folder() {
  return WALR_PLANS;
}

fs::path fileOf(const Variant& variant) {
  return folder() / (variant.name() + ".txt");
}

/// True if the plans are to be written instead of compared.
bool updating() {
  return std::getenv("WALR_UPDATE_PLANS") != nullptr;
}

std::unique_ptr<Denoiser> make(const Variant& variant) {
  std::unique_ptr<Denoiser> method = makeDenoiser(variant.method);
  if (!variant.preset.empty()) method->usePreset(variant.preset);
  return method;
}

class DenoiserPlansTest : public testing::TestWithParam<Variant> {
 protected:
  void SetUp() override {
    const std::unique_ptr<Denoiser> method = make(GetParam());
    declared_ = declareDenoiseGraph(*method, kExtent, InputConventions{}, kComputeHost);
    result_ = fg::compile(desc(), fg::TableMemoryModel());
    ASSERT_TRUE(result_.diagnostics.empty()) << result_.text();
  }
  [[nodiscard]] const fg::GraphDesc& desc() const { return declared_.graph.desc(); }
  [[nodiscard]] const fg::Plan& plan() const { return result_.plan; }

 private:
  DenoiseGraph declared_;
  fg::CompileResult result_;
};

TEST_P(DenoiserPlansTest, EqualsTheRecordedPlan) {
  const std::string text = fg::toText(desc(), plan());
  const fs::path file = fileOf(GetParam());
  if (updating()) {
    std::ofstream(file) << text;
    GTEST_SKIP() << "wrote " << file.string();
  }
  ASSERT_TRUE(fs::exists(file)) << "there is no " << file.string()
                                << "; write it with cmake --build build --target update_plans";
  const fs::path now = fs::path(testing::TempDir()) / file.filename();
  std::ofstream(now) << text;
  const int differs = std::system(("diff -u '" + file.string() + "' '" + now.string() + "'").c_str());
  EXPECT_EQ(differs, 0) << "the plan differs from " << file.filename().string() << ", as shown above (-: recorded, "
                        << "+: now); if this is intended, write it with cmake --build build --target update_plans";
}

TEST_P(DenoiserPlansTest, IsAcceptedByTheVerifier) {
  const std::vector<std::string> faults = fg::verify(desc(), plan());
  EXPECT_TRUE(faults.empty()) << faults.front();
}

TEST_P(DenoiserPlansTest, NeedsAtMostTwoPercentMoreMemoryThanItsLowerBound) {
  const fg::MemoryReport& memory = plan().memory;
  // The project's goal is 2 %.
  EXPECT_LE(static_cast<double>(memory.transientPeakBytes), 1.02 * static_cast<double>(memory.transientLowerBoundBytes))
      << memory.transientPeakBytes << " bytes, at least " << memory.transientLowerBoundBytes;
}

// Settings for scene and host remove passes. The remaining ones must form a complete graph without unused passes.
TEST_P(DenoiserPlansTest, CompilesForEverySceneAndHost) {
  const std::vector<std::vector<std::pair<std::string, std::string>>> choices{
      {{"scene.host-antialiasing", "on"}},
      {{"antialiasing.enabled", "off"}},
      {{"spatial-only", "on"}},
      {{"scene.object-motion", "off"}},
      {{"scene.camera-motion", "off"}, {"scene.object-motion", "off"}, {"scene.jitter", "off"}},
      {{"scene.sky", "off"}}};
  for (const auto& choice : choices) {
    const std::unique_ptr<Denoiser> method = make(GetParam());
    const std::vector<SettingText> known = method->settings();
    for (const auto& [name, value] : choice) {
      if (std::ranges::find(known, name, &SettingText::name) == known.end()) continue;
      method->set(name, value);
    }
    const DenoiseGraph declared = declareDenoiseGraph(*method, kExtent, InputConventions{}, kComputeHost);
    const fg::CompileResult result = fg::compile(declared.graph.desc(), fg::TableMemoryModel());
    EXPECT_TRUE(result.diagnostics.empty()) << choice.front().first << ": " << result.text();
  }
}

// Where objects do not move, motion follows from the cameras, and the host need not write the texture.
TEST_P(DenoiserPlansTest, LeavesMotionUnreadIfNoObjectMoves) {
  const std::unique_ptr<Denoiser> method = make(GetParam());
  if (GetParam().method != "none") method->set("scene.object-motion", "off");
  const DenoiseGraph declared = declareDenoiseGraph(*method, kExtent, InputConventions{}, kComputeHost);
  const fg::CompileResult result = fg::compile(declared.graph.desc(), fg::TableMemoryModel());
  ASSERT_TRUE(result.ok()) << result.text();
  const std::vector<fg::ResourceDecl>& resources = declared.graph.desc().resources;
  const auto motion = std::ranges::find(resources, "motion", &fg::ResourceDecl::name);
  ASSERT_NE(motion, resources.end());
  EXPECT_FALSE(result.plan.resources[static_cast<std::size_t>(motion - resources.begin())].used);
}

/// Number of passes whose name holds a text.
std::size_t passesNamed(const fg::GraphDesc& graph, std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      graph.passes, [&](const fg::PassDecl& pass) { return pass.name.find(text) != std::string::npos; }));
}

// Without anti-aliasing the filter writes the result. Nothing copies it.
TEST(DenoiserPlans, TheFilterWritesTheResultIfTheHostAntialiases) {
  for (const char* name : {"walr", "walr_paper", "flr"}) {
    const std::unique_ptr<Denoiser> method = makeDenoiser(name);
    method->set("scene.host-antialiasing", "on");
    const DenoiseGraph declared = declareDenoiseGraph(*method, kExtent, InputConventions{}, kComputeHost);
    EXPECT_EQ(passesNamed(declared.graph.desc(), "pass through"), 0U) << name;
  }
}

// The second light has the passes of the first but those that prepare guides, under names of their own.
TEST_P(DenoiserPlansTest, TwoLightsShareTheGuides) {
  const std::unique_ptr<Denoiser> first = make(GetParam());
  const std::unique_ptr<Denoiser> second = make(GetParam());
  const auto declare = [&] {
    return declareDenoiseGraph(*first, kExtent, InputConventions{}, kComputeHost, {}, {}, {}, {.method = second.get()});
  };
  if (!first->sharesGuides()) {
    EXPECT_EQ(GetParam().method, "none");
    EXPECT_THROW((void)declare(), std::invalid_argument);
    return;
  }
  const DenoiseGraph both = declare();
  const fg::GraphDesc& graph = both.graph.desc();
  const fg::CompileResult result = fg::compile(graph, fg::TableMemoryModel());
  ASSERT_TRUE(result.diagnostics.empty()) << result.text();
  const std::vector<std::string> faults = fg::verify(graph, result.plan);
  EXPECT_TRUE(faults.empty()) << faults.front();
  EXPECT_EQ(passesNamed(graph, "guides"), 1U);
  std::set<std::string> passes;
  std::set<std::string> resources;
  for (const fg::PassDecl& pass : graph.passes) EXPECT_TRUE(passes.insert(pass.name).second) << pass.name;
  for (const fg::ResourceDecl& resource : graph.resources)
    EXPECT_TRUE(resources.insert(resource.name).second) << resource.name;
  const fg::MemoryReport& alone = plan().memory;
  const fg::MemoryReport& together = result.plan.memory;
  // What a light has to itself is less than what it has alone, at least by a guide of four bytes a pixel.
  constexpr std::uint64_t kGuide = 4ULL * kExtent.width * kExtent.height;
  EXPECT_LE(together.persistentBytes + together.transientPeakBytes + kGuide,
            2 * (alone.persistentBytes + alone.transientPeakBytes));
}

INSTANTIATE_TEST_SUITE_P(Denoisers, DenoiserPlansTest, testing::ValuesIn(variants()), [](const auto& instance) {
  std::string name = instance.param.name();
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST(DenoiserPlans, EveryRecordedPlanBelongsToAMethodAndPreset) {
  std::set<fs::path> files;
  for (const Variant& variant : variants()) files.insert(fileOf(variant));
  for (const auto& file : fs::directory_iterator(folder())) {
    if (files.contains(file.path())) continue;
    if (updating()) {
      fs::remove(file);
    } else {
      ADD_FAILURE() << file.path().string() << " belongs to no method or preset: remove it";
    }
  }
}

}  // namespace
}  // namespace walr
