#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "framegraph/compile/compile.h"
#include "framegraph/inspect/inspect.h"
#include "framegraph/verify/verify.h"
#include "integration/denoise_graph.h"
#include "tests/samples/process.h"
#include "tests/samples/temporary_directory.h"

/// Reads back the output of `walr graph`, with independent programs where they exist.
namespace walr {
namespace {

using nlohmann::json;

constexpr fg::Extent kExtent = {640, 360};

test::ProcessResult graph(std::vector<std::string> more) {
  std::vector<std::string> arguments = {WALR_PROGRAM, "graph", "--size", "640x360"};
  std::ranges::move(more, std::back_inserter(arguments));
  return test::runProcess(arguments, {{{"VK_DRIVER_FILES", "/nonexistent"}, {"VK_ICD_FILENAMES", "/nonexistent"}}, {}});
}

std::string printed(const std::vector<std::string>& arguments) {
  const test::ProcessResult result = graph(arguments);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_TRUE(result.err.empty()) << result.err;
  return result.out;
}

DenoiseGraph declared(const std::string& method, const std::string& preset = {}) {
  const std::unique_ptr<Denoiser> denoiser = makeDenoiser(method);
  if (!preset.empty()) denoiser->usePreset(preset);
  return declareDenoiseGraph(*denoiser, kExtent, InputConventions{}, kComputeHost);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(GraphCommand, JsonIsReadBackAsThePlan) {
  for (const std::string& method : denoiserNames()) {
    std::vector<std::string> presets = makeDenoiser(method)->presets();
    presets.emplace_back();
    for (const std::string& preset : presets) {
      std::vector<std::string> arguments = {"--json", "--method", method};
      if (!preset.empty()) arguments.insert(arguments.end(), {"--preset", preset});
      const DenoiseGraph expected = declared(method, preset);
      const fg::GraphDesc& desc = expected.graph.desc();
      const fg::Plan plan = fg::planFromJson(desc, printed(arguments));
      EXPECT_EQ(plan, fg::compile(desc, fg::TableMemoryModel()).plan) << method << " " << preset;
      EXPECT_TRUE(fg::verify(desc, plan).empty()) << method << " " << preset;
    }
  }
}

/// Recomputes the memory totals from the listed textures and buffers by their definitions.
TEST(GraphCommand, JsonReportsItsMemoryRightly) {
  for (const std::string& method : denoiserNames()) {
    const json plan = json::parse(printed({"--json", "--method", method}));
    std::vector<std::uint64_t> alive(plan["passes"].size());
    std::uint64_t unaliased = 0;
    std::uint64_t persistent = 0;
    for (const char* kind : {"textures", "buffers"}) {
      for (const json& resource : plan[kind]) {
        const auto bytes = resource["bytes"].get<std::uint64_t>();
        if (resource["lifetime"] == "HistoryCurrent") persistent += 2 * bytes;
        if (resource["heap"].is_null()) continue;
        const json& heap = plan["heaps"][resource["heap"].get<std::size_t>()];
        EXPECT_LE(resource["offset"].get<std::uint64_t>() + bytes, heap["bytes"].get<std::uint64_t>());
        if (resource["lifetime"] != "Transient") continue;
        unaliased += bytes;
        EXPECT_EQ(resource["aliases"].empty(), heap["swaps_with"].is_null()) << resource["name"];
        if (!resource["aliases"].empty()) continue;
        const auto first = resource["first_use"].get<std::size_t>();
        const auto last = resource["last_use"].get<std::size_t>();
        for (std::size_t pass = first; pass <= last; ++pass) alive[pass] += bytes;
      }
    }
    std::uint64_t peak = 0;
    std::uint64_t histories = 0;
    for (const json& heap : plan["heaps"]) {
      (heap["swaps_with"].is_null() ? peak : histories) += heap["bytes"].get<std::uint64_t>();
    }
    const json& memory = plan["memory"];
    EXPECT_EQ(memory["persistent_bytes"], persistent) << method;
    EXPECT_EQ(persistent, histories) << method;
    EXPECT_EQ(memory["transient_unaliased_bytes"], unaliased) << method;
    EXPECT_EQ(memory["transient_peak_bytes"], peak) << method;
    EXPECT_GE(peak, std::ranges::max(alive)) << method;
    EXPECT_LE(memory["transient_lower_bound_bytes"], std::ranges::max(alive)) << method;
  }
}

TEST(GraphCommand, JsonReportsItsTrafficRightly) {
  // Input and output have eight bytes per pixel each.
  EXPECT_EQ(json::parse(printed({"--json", "--method", "none"}))["traffic"]["bytes_per_pixel"], 16.0);
  const json plan = json::parse(printed({"--json"}));
  const json& traffic = plan["traffic"];
  const double bytes = traffic["bytes_read"].get<double>() + traffic["bytes_written"].get<double>();
  EXPECT_DOUBLE_EQ(traffic["bytes_per_pixel"].get<double>(), bytes / (kExtent.width * kExtent.height));
}

TEST(GraphCommand, PrintsTheTrafficOfTwoLights) {
  const auto bytesPerPixel = [](const std::vector<std::string>& arguments) {
    return json::parse(printed(arguments))["traffic"]["bytes_per_pixel"].get<double>();
  };
  const double one = bytesPerPixel({"--json"});
  const double both = bytesPerPixel({"--json", "--second-preset", "standard"});
  EXPECT_GT(both, one);
  // The second light reads no depth, normal and albedo of the host (20 bytes a pixel), and writes no guides (8).
  EXPECT_LT(both, 2 * one - 20 - 8 + 4);  // It reads the guides' depth instead (4).
  const double diffuse = bytesPerPixel({"--json"}), specular = bytesPerPixel({"--json", "--light", "specular"});
  EXPECT_GT(specular, diffuse);
  EXPECT_NEAR(bytesPerPixel({"--json", "--light", "all"}), diffuse + specular, 1e-3);
  test::expectFailure(graph({"--light", "all", "--method", "flr"}), test::kUsage, {"--light all", "flr", "diffuse"});
  test::expectFailure(graph({"--light", "all", "--second-preset", "standard"}), test::kUsage, {"--second-preset"});
  test::expectFailure(graph({"--second-preset", "magic"}), test::kUsage, {"magic", "known presets"});
  test::expectFailure(graph({"--method", "none", "--second-preset", "magic"}), test::kUsage, {"magic"});
}

TEST(GraphCommand, JsonListsBarriersWithWordsAndPlace) {
  const json plan = json::parse(printed({"--json"}));
  ASSERT_FALSE(plan["barriers"].empty());
  std::vector<std::string> names;
  for (const json& pass : plan["passes"]) names.push_back(pass["name"]);
  for (const json& barrier : plan["barriers"]) {
    EXPECT_FALSE(barrier["description"].get<std::string>().empty());
    if (barrier["before"].is_null()) continue;
    EXPECT_NE(std::ranges::find(names, barrier["before"].get<std::string>()), names.end()) << barrier;
  }
}

TEST(GraphCommand, DotIsDrawnByGraphviz) {
  const test::TemporaryDirectory directory;
  const std::string file = (directory.path() / "graph.dot").string();
  for (const std::string& method : denoiserNames()) {
    EXPECT_EQ(printed({"--dot", "--method", method, "--output", file}), "");
    const test::ProcessResult drawn = test::runProcess({"/usr/bin/dot", "-Tplain", file});
    ASSERT_EQ(drawn.exitCode, 0) << drawn.err;
    const DenoiseGraph expected = declared(method);
    for (const fg::PassDecl& pass : expected.graph.desc().passes) {
      EXPECT_EQ(count(drawn.out, "\nnode \"pass " + pass.name + "\" "), 1U) << drawn.out;
    }
  }
}

TEST(GraphCommand, SvgIsWellFormedWithARectangleForEveryTransient) {
  const test::TemporaryDirectory directory;
  const std::string file = (directory.path() / "memory.svg").string();
  for (const std::string& method : denoiserNames()) {
    printed({"--svg", "--method", method, "--output", file});
    const test::ProcessResult shapes = test::runProcess(
        {"/usr/bin/xmllint", "--xpath", "count(/*[local-name()='svg']//*[local-name()='rect'])", file});
    ASSERT_EQ(shapes.exitCode, 0) << shapes.err;
    const json plan = json::parse(printed({"--json", "--method", method}));
    std::size_t transients = 0;
    for (const char* kind : {"textures", "buffers"}) {
      for (const json& resource : plan[kind]) transients += resource["heap"].is_null() ? 0 : 1;
    }
    EXPECT_EQ(std::stoul(shapes.out), transients) << method;
  }
}

TEST(GraphCommand, SaysWhy) {
  const json plan = json::parse(printed({"--json"}));
  // Barriers are recorded before the first pass of a batch. Each is explained to the passes of the batch that need it.
  std::map<std::uint64_t, std::string> whys;
  std::map<std::string, std::uint64_t> batches;
  for (const json& pass : plan["passes"]) {
    batches[pass["name"]] = pass["batch"];
    whys[pass["batch"]] += printed({"--why", pass["name"]});
  }
  for (const json& barrier : plan["barriers"]) {
    if (barrier["before"].is_null()) continue;
    const std::string line = "'" + barrier["resource"].get<std::string>() +
                             "': " + barrier["description"].get<std::string>() + "; declared at ";
    const std::string& why = whys.at(batches.at(barrier["before"]));
    EXPECT_NE(why.find(line), std::string::npos) << why;
  }
}

TEST(GraphCommand, SaysWhyMemoryIsShared) {
  const json plan = json::parse(printed({"--json"}));
  std::vector<json> transients;
  for (const json& texture : plan["textures"]) {
    if (texture["lifetime"] == "Transient" && !texture["heap"].is_null()) transients.push_back(texture);
  }
  ASSERT_GE(transients.size(), 2U);
  const auto number = [](const json& transient, const char* field) { return transient[field].get<std::uint64_t>(); };
  const auto batch = [&](const json& transient, const char* use) {
    return plan["passes"][number(transient, use)]["batch"].get<std::uint64_t>();
  };
  const auto alive = [&](const json& a, const json& b) {
    return batch(a, "first_use") <= batch(b, "last_use") && batch(b, "first_use") <= batch(a, "last_use");
  };
  const auto overlap = [&](const json& a, const json& b) {
    return a["heap"] == b["heap"] && number(a, "offset") < number(b, "offset") + number(b, "bytes") &&
           number(b, "offset") < number(a, "offset") + number(a, "bytes");
  };
  for (std::size_t i = 1; i < transients.size(); ++i) {
    const json& a = transients[i - 1];
    const json& b = transients[i];
    const std::string why = printed({"--why", a["name"], b["name"]});
    EXPECT_EQ(why.find("alive at the same time") != std::string::npos, alive(a, b)) << why;
    EXPECT_EQ(why.ends_with("' share memory\n"), overlap(a, b)) << why;
    for (const json& image : a["aliases"]) {
      const std::string aliased = printed({"--why", a["name"], image});
      EXPECT_TRUE(aliased.ends_with("' share memory\n")) << aliased;
    }
  }
}

TEST(GraphCommand, RefusesTwoFormatsAndUnknownNames) {
  test::expectFailure(graph({"--json", "--dot"}), test::kUsage, {"--json"});
  test::expectFailure(graph({"--why", "magic"}), test::kUsage, {"no pass 'magic'"});
}

TEST(GraphCommand, NamesAFileThatCannotBeWritten) {
  test::expectFailure(graph({"--json", "--output", "/nonexistent/plan.json"}), test::kOutput,
                      {"/nonexistent/plan.json"});
}

}  // namespace
}  // namespace walr
