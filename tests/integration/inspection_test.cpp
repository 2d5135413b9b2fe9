// Views and counters of methods. No device is needed.

#include "passes/stage/inspection.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "framegraph/compile/compile.h"
#include "integration/denoise_graph.h"
#include "tests/error_text.h"

namespace walr::inspection_test {
namespace {

constexpr fg::Extent kExtent{640, 720};

DenoiseGraph declare(const std::string& method, const std::string& preset, const InspectionWish& wanted) {
  const auto denoiser = makeDenoiser(method);
  if (!preset.empty()) denoiser->usePreset(preset);
  return declareDenoiseGraph(*denoiser, kExtent, {}, kComputeHost, {}, {}, wanted);
}

/// The error of a method and preset for a view; empty if it exists.
std::string rejection(const std::string& method, const std::string& preset, const std::string& view) {
  return fg::test::errorText([&] { (void)declare(method, preset, {.views = {&view, 1}}); });
}

TEST(Inspection, ErrorsNameTheKnownViews) {
  EXPECT_NE(rejection("walr_paper", "robust", "edge").find("known views: no-surface, "), std::string::npos);
  EXPECT_NE(rejection("walr_paper", "robust", "edge").find(", edges, samples, "), std::string::npos);
  EXPECT_NE(rejection("walr_paper", "robust", "edges.4").find("0 to 3"), std::string::npos)
      << rejection("walr_paper", "robust", "edges.4");
  EXPECT_NE(rejection("walr_paper", "robust", "edges.").find("0 to 3"), std::string::npos);
  EXPECT_NE(rejection("walr_paper", "robust", "edges.1x").find("0 to 3"), std::string::npos);
  EXPECT_NE(rejection("walr_paper", "robust", "history.1").find("does not iterate"), std::string::npos);
  EXPECT_NE(rejection("none", "", "edges").find("known views: none"), std::string::npos);
  EXPECT_EQ(rejection("walr_paper", "robust", "edges.3"), "");
  EXPECT_EQ(rejection("walr_paper", "robust", "edges"), "");
}

TEST(Inspection, ListsViewsForTheCurrentSettings) {
  const auto has = [](Denoiser& method, std::string_view name) {
    const std::vector<ViewInfo> views = method.views();
    return std::ranges::any_of(views, [&](const ViewInfo& view) { return view.name == name; });
  };
  const auto walr = makeDenoiser("walr");
  EXPECT_TRUE(has(*walr, "slope-occlusion"));
  EXPECT_FALSE(has(*walr, "slope-u"));
  EXPECT_TRUE(has(*walr, "clip"));
  walr->set("antialiasing.enabled", "off");
  EXPECT_FALSE(has(*walr, "clip"));
  EXPECT_TRUE(has(*makeDenoiser("walr_paper"), "slope-u"));
  EXPECT_TRUE(makeDenoiser("none")->views().empty());
}

TEST(Inspection, NamesAreUniqueInEveryMethod) {
  for (const std::string& method : denoiserNames()) {
    std::vector<std::string> presets = makeDenoiser(method)->presets();
    if (presets.empty()) presets.emplace_back();
    for (const std::string& preset : presets) {
      SCOPED_TRACE(method + " " + preset);
      const DenoiseGraph declared = declare(method, preset, {.counters = true});
      std::set<std::string> names;
      for (const ViewInfo& view : declared.inspection.known())
        EXPECT_TRUE(names.insert(std::string(view.name)).second) << view.name;
      names.clear();
      for (const Counter& counter : declared.inspection.counters())
        EXPECT_TRUE(names.insert(counter.name).second) << counter.name;
      const fg::CompileResult compiled = fg::compile(declared.graph.desc(), fg::TableMemoryModel());
      EXPECT_TRUE(compiled.ok()) << compiled.text();
    }
  }
}

TEST(Inspection, EveryViewOfEveryMethodCompiles) {
  for (const std::string& method : denoiserNames()) {
    std::vector<std::string> presets = makeDenoiser(method)->presets();
    if (presets.empty()) presets.emplace_back();
    for (const std::string& preset : presets) {
      SCOPED_TRACE(method + " " + preset);
      const auto denoiser = makeDenoiser(method);
      if (!preset.empty()) denoiser->usePreset(preset);
      std::vector<std::string> names;
      for (const ViewInfo& view : denoiser->views()) names.emplace_back(view.name);
      const DenoiseGraph declared = declare(method, preset, {.views = names});
      const fg::CompileResult compiled = fg::compile(declared.graph.desc(), fg::TableMemoryModel());
      EXPECT_TRUE(compiled.ok()) << compiled.text();
    }
  }
}

TEST(Inspection, AddsNothingUnlessRequested) {
  const DenoiseGraph plain = declare("walr_paper", "robust", {});
  for (const fg::ResourceDecl& resource : plain.graph.desc().resources) {
    EXPECT_FALSE(resource.name.starts_with("count")) << resource.name;
    EXPECT_FALSE(resource.name.starts_with("view")) << resource.name;
  }
  for (const fg::PassDecl& pass : plain.graph.desc().passes) {
    const auto& dispatch = std::get<fg::ComputeDispatch>(pass.work);
    EXPECT_EQ(dispatch.shader->name.find("view"), std::string_view::npos) << pass.name;
    EXPECT_EQ(dispatch.shader->name.find("count"), std::string_view::npos) << pass.name;
  }
  // The method's own passes do not change; those for views and counters are added.
  const DenoiseGraph counted = declare("walr_paper", "robust", {.counters = true});
  std::vector<std::string> left;
  for (const fg::PassDecl& pass : counted.graph.desc().passes) {
    const auto& name = std::get<fg::ComputeDispatch>(pass.work).shader->name;
    if (name.find("view") == std::string_view::npos && name.find("count") == std::string_view::npos)
      left.push_back(pass.name);
  }
  std::vector<std::string> expected;
  for (const fg::PassDecl& pass : plain.graph.desc().passes) expected.push_back(pass.name);
  EXPECT_EQ(left, expected);
}

TEST(Inspection, ACounterSumsItsWords) {
  const Counter counter{"clamped", {1, 2, 4}};
  const std::vector<std::uint32_t> words{1000, 1, 0xffffffff, 1000, 3};
  EXPECT_EQ(counter.value(words), 0x100000003U);
}

}  // namespace
}  // namespace walr::inspection_test
