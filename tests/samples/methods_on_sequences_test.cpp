// Every method on path-traced sequences, if they are at hand: minimum quality that makes a method worth comparing.
#include <filesystem>
#include <memory>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "samples/denoise/gpu_denoiser.h"
#include "samples/metrics/metrics.h"
#include "samples/sequence/sequence.h"
#include "tests/shared_data.h"

namespace walr::methods_on_sequences_test {
namespace {

struct Frames {
  const char* sequence;
  FrameRange range;  ///< Frames with a moving camera.
};

class SharedDataMethods : public testing::TestWithParam<std::tuple<const char*, Frames>> {};

/// Errors of the last frame of a range.
ErrorFigures errorsOf(const GpuDevice& device, const Sequence& sequence, Denoiser& method, std::size_t frames) {
  GpuDenoiser denoiser(device, method, sequence.extent(), *sequence.layout().layout);
  ErrorFigures errors;
  for (std::size_t i = sequence.entries().size() - frames; i < sequence.entries().size(); ++i) {
    const DenoisedFrame result = denoiser.denoise(packFrame(sequence.read(i)));
    const Frame& frame = result.frame;
    const Image& truth = frame.reference->indirect;
    const PixelMask mask = diffuseMask(frame.albedo, frame.normal, frame.depth, kSkyDepth, truth);
    errors = compare(result.indirect, truth, mask);
  }
  return errors;
}

TEST_P(SharedDataMethods, BeatsItsInputAndAccumulationAlone) {
  const auto& [name, frames] = GetParam();
  const test::SharedData folder(std::filesystem::path("sequences") / frames.sequence);
  if (!folder) GTEST_SKIP() << folder.whyNot();
  SequenceOptions options;
  options.frames = frames.range;
  const Sequence sequence(folder.path(), options);
  const GpuDevice device({.device = {}, .validation = false});

  const ErrorFigures noisy = errorsOf(device, sequence, *makeDenoiser("none"), 1);
  const ErrorFigures accumulated = errorsOf(device, sequence, *makeDenoiser("accumulate"), sequence.entries().size());
  const auto method = makeDenoiser(name);
  const ErrorFigures whole = errorsOf(device, sequence, *method, sequence.entries().size());
  method->set("spatial-only", "on");
  const ErrorFigures spatial = errorsOf(device, sequence, *method, 1);
  for (const auto& [what, figures] :
       {std::pair{"noisy", noisy}, {"accumulated", accumulated}, {"whole", whole}, {"spatial", spatial}}) {
    RecordProperty(std::string(what) + "_rmse", std::to_string(*figures.rmse));
    RecordProperty(std::string(what) + "_ssim", std::to_string(*figures.ssim));
  }
  EXPECT_LT(*whole.rmse, *accumulated.rmse);
  EXPECT_GT(*whole.ssim, *accumulated.ssim);
  // Clearly better than the input: half of its error is what four samples per pixel would leave.
  EXPECT_LT(*spatial.rmse, 0.5 * *noisy.rmse);
  EXPECT_GT(*spatial.ssim, *noisy.ssim);
  EXPECT_LT(*whole.rmse, *spatial.rmse);
}

INSTANTIATE_TEST_SUITE_P(
    Methods, SharedDataMethods,
    testing::Combine(testing::Values("walr", "bmfr", "svgf", "flr", "joint_bilateral"),
                     testing::Values(Frames{"cornell_fence", {10, 12}}, Frames{"sponza", {18, 20}})),
    [](const auto& info) { return std::string(std::get<0>(info.param)) + "_" + std::get<1>(info.param).sequence; });

}  // namespace
}  // namespace walr::methods_on_sequences_test
