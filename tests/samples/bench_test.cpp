#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samples/bench/bench_frame.h"
#include "samples/bench/frame_errors.h"
#include "samples/bench/npy.h"
#include "samples/bench/plan_costs.h"
#include "samples/bench/run_record.h"
#include "samples/bench/spread.h"
#include "samples/bench/variant.h"
#include "samples/bench/variant_estimate.h"
#include "samples/errors.h"
#include "samples/estimate/machine.h"
#include "samples/estimate/shader_figures.h"
#include "samples/image/fingerprint.h"
#include "tests/error_text.h"
#include "tests/samples/synthetic_sequence.h"
#include "tests/samples/temporary_directory.h"

namespace walr::bench_test {
namespace {

using fg::test::expectError;
using test::Channels;
using test::SyntheticSequence;
using test::TemporaryDirectory;

TEST(Spread, IsThatOfNumPy) {
  // numpy.percentile([15, 20, 35, 40, 50], [50, 5, 95]) and of one value.
  const Spread five = spread({40, 15, 50, 35, 20});
  EXPECT_DOUBLE_EQ(five.median, 35.0);
  EXPECT_DOUBLE_EQ(five.p5, 16.0);
  EXPECT_DOUBLE_EQ(five.p95, 48.0);
  const Spread one = spread({7});
  EXPECT_EQ(one.median, 7.0);
  EXPECT_EQ(one.p5, 7.0);
}

/// Values of the FNV authors' test suite (draft-eastlake-fnv, 64-bit FNV-1a).
TEST(FingerprintTest, IsFnv1a) {
  const auto of = [](std::string_view text) { return Fingerprint().add(std::as_bytes(std::span(text))).text(); };
  EXPECT_EQ(of(""), "cbf29ce484222325");
  EXPECT_EQ(of("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(of("foobar"), "85944171f73967e8");
  EXPECT_NE(Fingerprint().add("ab").add("c").value(), Fingerprint().add("a").add("bc").value());
}

TEST(FingerprintTest, NamesAFileThatCannotBeRead) {
  EXPECT_THROW(Fingerprint().addFile("/does/not/exist"), InputError);
}

TEST(Npy, IsAnArrayOfHalves) {
  const TemporaryDirectory directory;
  Image image(2, 3, 1);
  std::iota(image.values().begin(), image.values().end(), 1.0F);
  writeNpy(directory.path() / "a.npy", image);
  const std::string bytes = test::readText(directory.path() / "a.npy");
  ASSERT_EQ(bytes.size() % 64, 12U);
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_NE(bytes.find("'shape': (3, 2, 1)"), std::string::npos);
  EXPECT_EQ(bytes.substr(bytes.size() - 12, 4), std::string("\x00\x3C\x00\x40", 4));  // 1 and 2
}

TEST(Errors, MeanAndWorstAreOverTheFramesThatHaveThem) {
  std::vector<FrameErrors> frames(3);
  frames[0].rmse = 0.1;
  frames[1].rmse = 0.3;
  frames[0].ssim = 0.9;
  frames[2].ssim = 0.5;
  frames[0].luminanceChange = 1.0;
  EXPECT_DOUBLE_EQ(*meanOf(frames, kMetrics[0]), 0.2);
  EXPECT_EQ(worstOf(frames, kMetrics[0]), 0.3);
  const Metric& ssim = *std::ranges::find(kMetrics, "ssim", &Metric::name);
  EXPECT_EQ(worstOf(frames, ssim), 0.5);
  const Metric& change = *std::ranges::find(kMetrics, "luminance_change", &Metric::name);
  EXPECT_FALSE(worstOf(frames, change).has_value());
  EXPECT_FALSE(meanOf({}, ssim).has_value());
}

TEST(Errors, ShortSequencesKeepAllFrames) {
  EXPECT_EQ(afterWarmUp(std::vector<FrameErrors>(6)).size(), 2U);
  EXPECT_EQ(afterWarmUp(std::vector<FrameErrors>(4)).size(), 4U);
}

TEST(Variants, AllHoldEveryMethodWithEveryPreset) {
  std::set<std::string> names;
  for (const Variant& variant : allMethods()) names.insert(variant.name);
  for (const std::string& method : denoiserNames()) EXPECT_TRUE(names.contains(method)) << method;
  EXPECT_TRUE(names.contains("walr_paper:robust"));
  EXPECT_EQ(parseMethods("all"), allMethods());
}

TEST(Variants, TakeSettingsUnderAName) {
  const Variant variant = parseVariant("mine=walr_paper:paper,regression.iterations=3,accumulation.max-history=8");
  EXPECT_EQ(variant.name, "mine");
  EXPECT_EQ(variant.preset, "paper");
  const auto settings = makeVariant(variant)->settings();
  EXPECT_EQ(std::ranges::find(settings, "regression.iterations", &SettingText::name)->value, "3");
  EXPECT_EQ(std::ranges::find(settings, "regression.moments", &SettingText::name)->value, "raw16");
}

TEST(Variants, NameWhatIsWrong) {
  expectError<std::exception>([] { parseMethods("walr,magic"); }, {"magic"});
  expectError<std::exception>([] { parseMethods("walr:fancy"); }, {"fancy"});
  expectError<std::exception>([] { parseVariant("x=walr,nothing=1"); }, {"nothing"});
  expectError<std::exception>([] { parseVariant("walr"); }, {"NAME=METHOD"});
  for (const char* const name : {"../x", "_reference", "svgf.errors", "svgf.change"})
    expectError<std::exception>([&] { parseVariant(std::string(name) + "=walr"); }, {"NAME=METHOD"});
  expectError<std::exception>([] { withBaseline({parseVariant("a=walr"), parseVariant("a=bmfr")}); }, {"'a'"});
  expectError<std::exception>([] { withBaseline(parseMethods("flr,flr")); }, {"'flr'"});
}

TEST(Variants, BeginWithTheBaseline) {
  const std::vector<Variant> added = withBaseline(parseMethods("bmfr"));
  ASSERT_EQ(added.size(), 2U);
  EXPECT_EQ(added.front().name, kBaseline);
  EXPECT_EQ(withBaseline(parseMethods("bmfr,walr")).front().name, kBaseline);
  EXPECT_EQ(withBaseline(parseMethods("bmfr,walr")).size(), 2U);
}

TEST(PlanCostsTest, OfACopyAreItsTexels) {
  // Reads and writes one RGBA16F texel per pixel, and has no history.
  const PlanCosts costs = planCosts(parseMethods("none").front(), {64, 48}, {});
  EXPECT_EQ(costs.bytesReadPerPixel, 8.0);
  EXPECT_EQ(costs.bytesWrittenPerPixel, 8.0);
  EXPECT_EQ(costs.persistentBytes + costs.transientPeakBytes, 0U);
}

TEST(PlanCostsTest, SharedMemoryIsNoLargerThanUnshared) {
  for (const Variant& variant : allMethods()) {
    const PlanCosts costs = planCosts(variant, {320, 180}, {});
    EXPECT_LE(costs.transientPeakBytes, costs.transientUnaliasedBytes) << variant.name;
  }
}

// The passes of sparse light are others, and the table of figures does not hold their shaders.
TEST(PassEstimates, AreOfTheLightOfTheSequence) {
  const Variant walr = parseMethods("walr").front();
  constexpr fg::Extent kExtent{1920, 1080};
  InputConventions sparse;
  sparse.light = {.columns = 2, .rows = 2};
  const auto estimatesOf = [&](const InputConventions& conventions) {
    return estimatePasses(walr, kExtent, shaderFigures(), machineNamed(kDefaultMachine), conventions);
  };
  const auto bytesOf = [](const std::vector<PassEstimate>& estimates) {
    return std::accumulate(estimates.begin(), estimates.end(), 0.0,
                           [](double sum, const PassEstimate& pass) { return sum + double(pass.bytes); });
  };
  const PlanCosts costs = planCosts(walr, kExtent, sparse);
  EXPECT_DOUBLE_EQ(bytesOf(estimatesOf(sparse)),
                   (costs.bytesReadPerPixel + costs.bytesWrittenPerPixel) * kExtent.width * kExtent.height);
  EXPECT_NE(bytesOf(estimatesOf(sparse)), bytesOf(estimatesOf({})));
  EXPECT_FALSE(costs.estimatedMicroseconds);
  EXPECT_TRUE(planCosts(walr, kExtent, {}).estimatedMicroseconds);
}

RunRecord someRecord() {
  RunRecord record;
  record.variant = "walr_paper:robust";
  record.frames.resize(2);
  record.frames[1].frame = 7;
  record.frames[1].flip = 0.125;
  record.frames[1].nonFinite = 3;
  record.timing.milliseconds = Spread{2.0, 1.0, 3.0};
  record.timing.passes = {{"a-trous 0", {0.5, 0.25, 0.75}}};
  record.timing.frames = 6;
  return record;
}

TEST(RunStoreTest, GivesBackWhatWasSaved) {
  const TemporaryDirectory directory;
  const RunStore store(directory.path() / "runs");
  EXPECT_FALSE(store.find("fence", "walr_paper:robust", "key").has_value());
  store.save("fence", someRecord(), "key");
  const auto found = store.find("fence", "walr_paper:robust", "key");
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(toJson(*found), toJson(someRecord()));
  EXPECT_FALSE(found->timing.ratio.has_value());
}

TEST(RunStoreTest, TakesNothingThatWasMadeFromSomethingElseOrIsDamaged) {
  const TemporaryDirectory directory;
  const RunStore store(directory.path());
  store.save("fence", someRecord(), "key");
  EXPECT_FALSE(store.find("fence", "walr_paper:robust", "other key").has_value());
  const std::filesystem::path file = directory.path() / "fence" / "walr_paper:robust.json";
  const std::string text = test::readText(file);
  test::writeText(file, text.substr(0, text.size() / 2));
  EXPECT_FALSE(store.find("fence", "walr_paper:robust", "key").has_value());
  test::writeText(file, R"({"key": "key", "run": {}})");
  EXPECT_FALSE(store.find("fence", "walr_paper:robust", "key").has_value());
}

class BenchFrameTest : public testing::Test {
 protected:
  [[nodiscard]] Sequence open() const { return {directory.path(), {}}; }

  TemporaryDirectory directory;
  SyntheticSequence files{directory.path(), 24, 18};
};

TEST_F(BenchFrameTest, AStillCameraDisoccludesNothing) {
  files.write(0, 2);
  const std::vector<FrameFacts> facts = survey(open());
  ASSERT_EQ(facts.size(), 3U);
  EXPECT_FALSE(facts[0].disoccluded.has_value());
  EXPECT_EQ(facts[1].disoccluded, 0.0);
  EXPECT_FALSE(facts[1].referenceNoise.has_value()) << "there are no halves";
}

TEST_F(BenchFrameTest, HalvesOfTheReferenceTellItsNoise) {
  files.write(0, 0);
  files.writeReference(0, [](Channels& channels) {
    for (const char* c : {"R", "G", "B"}) {
      Image half = channels.at(std::string("DiffInd.") + c);
      for (float& value : half.values()) value *= 1.25F;
      channels.emplace(std::string("DiffIndA.") + c, half);
    }
  });
  const std::optional<double> noise = survey(open()).front().referenceNoise;
  ASSERT_TRUE(noise.has_value());
  EXPECT_GT(*noise, 0.0);
}

TEST(PictureFrames, AreTheLastAndTheHardestAfterHistoryHasBuiltUp) {
  std::vector<FrameFacts> facts(8);
  for (std::size_t i = 0; i < facts.size(); ++i) {
    facts[i].number = 100 + static_cast<int>(i);
    facts[i].disoccluded = 0.01;
  }
  facts[2].disoccluded = 0.9;
  facts[5].disoccluded = 0.2;
  EXPECT_EQ(pictureFrames(facts), (std::vector<int>{105, 107}));
  for (FrameFacts& fact : facts) fact.disoccluded = 0.0;
  EXPECT_EQ(pictureFrames(facts), std::vector<int>{107});
  facts[7].hasReference = false;
  EXPECT_EQ(pictureFrames(facts), std::vector<int>{106}) << "a picture needs a reference beside it";
}

}  // namespace
}  // namespace walr::bench_test
