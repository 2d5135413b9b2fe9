#include "samples/gpu_report/validation_run.h"

#include <memory>

#include "framegraph/vulkan/error.h"
#include "samples/bench/response_scene.h"
#include "samples/denoise/gpu_denoiser.h"
#include "samples/gpu_report/bandwidth.h"
#include "samples/gpu_report/frame_loop.h"

namespace walr {
namespace {

constexpr fg::Extent kExtent{128, 72};
constexpr int kFrames = 3;
constexpr std::uint32_t kProbeSide = 128;

void runFrames(const GpuDevice& device, const Variant& variant, const TimedContent& content) {
  GpuDenoiser denoiser(device, *makeVariant(variant), kExtent, *content.layout, {}, 2);
  for (int i = 0; i < kFrames; ++i) {
    if (denoiser.full()) denoiser.finish();
    PackedFrame frame = slabFrame(kExtent, i).packed;
    frame.frame.resetHistory = i == 0;
    denoiser.submit(std::move(frame));
  }
  while (denoiser.finish()) {
  }
  FrameLoop(device, variant, content).run({.least = kFrames, .most = kFrames}, nullptr);
}

}  // namespace

ValidationRun validate(GpuDevice::Options options, std::span<const Variant> variants) {
  ValidationRun run;
  options.validation = true;
  std::unique_ptr<GpuDevice> device;
  try {
    device = std::make_unique<GpuDevice>(options);
  } catch (const fg::vk::Unsupported& error) {
    if (error.result() != VK_ERROR_LAYER_NOT_PRESENT) throw;
    run.whyNot = error.what();
    return run;
  }
  run.layer = true;
  const TimedContent content = syntheticContent(kExtent);
  for (const Variant& variant : variants) {
    runFrames(*device, variant, content);
    run.methods.push_back(variant.name);
  }
  measureBandwidth(*device, kProbeSide, 1);
  run.messages = device->takeMessages();
  return run;
}

}  // namespace walr
