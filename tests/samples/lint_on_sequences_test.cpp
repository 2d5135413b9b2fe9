// The linter of inputs on path-traced sequences, if they are at hand: on the unchanged frames, and on spoiled ones.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "samples/denoise/gpu_linter.h"
#include "samples/sequence/sequence.h"
#include "tests/shared_data.h"

namespace walr::lint_on_sequences_test {
namespace {

/// Findings of the linter in a sequence after a change to its frames.
std::vector<std::string> findings(const Sequence& sequence, const std::function<void(Frame&)>& change) {
  const GpuDevice device({.device = {}, .validation = false});
  GpuLinter linter(device, sequence.extent(), *sequence.layout().layout);
  for (std::size_t i = 0; i < sequence.entries().size(); ++i) {
    Frame frame = sequence.read(i);
    change(frame);
    linter.add(frame);
  }
  std::vector<std::string> names;
  for (const LintFinding& finding : linter.findings()) names.emplace_back(finding.name);
  return names;
}

using Names = std::vector<std::string>;

class SharedDataLint : public testing::TestWithParam<const char*> {};

TEST_P(SharedDataLint, NothingLooksWrong) {
  const test::SharedData folder(std::filesystem::path("sequences") / GetParam());
  if (!folder) GTEST_SKIP() << folder.whyNot();
  EXPECT_EQ(findings(Sequence(folder.path(), {}), [](Frame&) {}), Names{});
}

INSTANTIATE_TEST_SUITE_P(Sequences, SharedDataLint, testing::Values("cornell_fence", "sponza"));

// At one sample per pixel, noise hides the contrast of an albedo left in the light; the linter must find it
// nevertheless.
TEST(SharedDataLintOnNoise, FindsAlbedoAndMotion) {
  const test::SharedData folder("sequences/sponza");
  if (!folder) GTEST_SKIP() << folder.whyNot();
  const auto leaveAlbedoIn = [](Frame& frame) {
    const auto albedo = frame.albedo.values();
    for (std::size_t i = 0; i < albedo.size(); ++i) frame.indirect.values()[i] *= albedo[i];
  };
  SequenceOptions options;
  for (const int first : {16, 19}) {
    options.frames = {first, first};
    EXPECT_EQ(findings(Sequence(folder.path(), options), leaveAlbedoIn), Names{"albedo-in-lighting"})
        << "a single frame";
  }
  options.frames = {16, 19};
  const Sequence sequence(folder.path(), options);
  EXPECT_EQ(findings(sequence, leaveAlbedoIn), Names{"albedo-in-lighting"});
  EXPECT_EQ(findings(sequence,
                     [](Frame& frame) {
                       for (float& value : frame.motion.values()) value = -value;
                     }),
            (Names{"motion-x-direction", "motion-y-direction"}));
}

}  // namespace
}  // namespace walr::lint_on_sequences_test
