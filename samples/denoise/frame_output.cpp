#include "samples/denoise/frame_output.h"

#include <cmath>
#include <vector>

#include "samples/image/exr.h"
#include "samples/image/png.h"
#include "samples/metrics/metrics.h"
#include "samples/sequence/writer.h"

namespace walr {

Image composite(const Image& indirect, const Image& direct, const Image& albedo, const Image& emission) {
  const auto known = [](float value) { return std::isfinite(value) ? value : 0.0F; };
  Image lit(indirect.width(), indirect.height(), 3);
  for (std::size_t i = 0; i < lit.values().size(); ++i) {
    lit.values()[i] =
        known(albedo.values()[i]) * (known(direct.values()[i]) + indirect.values()[i]) + known(emission.values()[i]);
  }
  return lit;
}

void writeDenoisedFrame(const DenoisedFrame& denoised, const OutputOptions& options) {
  const Frame& frame = denoised.frame;
  const auto picture = [&](const Image& indirect, const Image& direct) {
    return options.composite ? composite(indirect, direct, frame.albedo, frame.emission) : indirect;
  };
  const auto path = [&](const char* prefix, const char* extension) {
    return options.directory / frameFileName(prefix, frame.number, extension);
  };

  const Image result = picture(denoised.indirect, frame.direct);
  std::vector<ExrChannel> channels;
  appendChannels(channels, options.composite ? "" : "Indirect", "RGB", result);
  writeExr(path("denoised", "exr"), channels);
  for (const ViewPicture& view : denoised.views) {
    std::vector<ExrChannel> components;
    appendChannels(components, "", "XYZ", view.image, ExrType::Float);
    writeExr(path(("view_" + view.name).c_str(), "exr"), components);
  }
  if (!options.png) {
    return;
  }
  writePng(path("denoised", "png"), std::vector<const Image*>{&result});
  const Image noisy = picture(frame.indirect, frame.direct);
  std::vector<const Image*> pictures = {&noisy, &result};
  Image reference;
  if (frame.reference) {
    const bool hasDirect = !frame.reference->direct.empty();
    reference = picture(frame.reference->indirect, hasDirect ? frame.reference->direct : frame.direct);
    pictures.push_back(&reference);
  }
  writePng(path("comparison", "png"), pictures);
}

FrameReport measure(const DenoisedFrame& denoised) {
  const Frame& frame = denoised.frame;
  FrameReport report;
  report.frame = frame.number;
  report.resetHistory = frame.resetHistory;
  report.gpuMilliseconds = denoised.gpuMilliseconds;
  report.nonFiniteOutput = countNonFinite(denoised.indirect);
  report.counters = denoised.counters;
  if (frame.reference) {
    const Image& reference = frame.reference->indirect;
    const PixelMask mask = diffuseMask(frame.albedo, frame.normal, frame.depth, kSkyDepth, reference);
    report.denoised = compare(denoised.indirect, reference, mask);
    report.noisy = compare(frame.indirect, reference, mask);
  }
  return report;
}

}  // namespace walr
