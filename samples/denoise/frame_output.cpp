#include "samples/denoise/frame_output.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "samples/image/exposure.h"
#include "samples/image/exr.h"
#include "samples/image/png.h"
#include "samples/metrics/metrics.h"
#include "samples/sequence/writer.h"

namespace walr {
namespace {

// Indices into FrameWriter::Versions.
constexpr std::size_t kDenoised = 1;
constexpr std::size_t kReference = 2;

}  // namespace

Image composite(const Image& indirect, const Image& direct, const Image& albedo, const Image& emission) {
  const auto known = [](float value) { return std::isfinite(value) ? value : 0.0F; };
  Image lit(indirect.width(), indirect.height(), 3);
  for (std::size_t i = 0; i < lit.values().size(); ++i) {
    lit.values()[i] =
        known(albedo.values()[i]) * (known(direct.values()[i]) + indirect.values()[i]) + known(emission.values()[i]);
  }
  return lit;
}

void FrameWriter::write(const DenoisedFrame& denoised) {
  const Frame& frame = denoised.frame;
  Versions light = {frame.indirect, denoised.indirect};
  if (frame.reference) light.push_back(frame.reference->indirect);
  Versions lit;
  if (options_.composite) {
    const bool hasDirect = frame.reference && !frame.reference->direct.empty();
    for (std::size_t i = 0; i < light.size(); ++i) {
      const bool takesReference = hasDirect && (options_.referenceDirect || i == kReference);
      const Image& direct = takesReference ? frame.reference->direct : frame.direct;
      lit.push_back(composite(light[i], direct, frame.albedo, frame.emission));
    }
  }
  const auto path = [&](const std::string& prefix) {
    return options_.directory / frameFileName(prefix.c_str(), frame.number, "exr");
  };
  std::vector<ExrChannel> channels;
  appendChannels(channels, options_.composite ? "" : "Indirect", "RGB",
                 options_.composite ? lit[kDenoised] : light[kDenoised]);
  writeExr(path("denoised"), channels);
  for (const ViewPicture& view : denoised.views) {
    std::vector<ExrChannel> components;
    appendChannels(components, "", "XYZ", view.image, ExrType::Float);
    writeExr(path("view_" + view.name), components);
  }
  if (options_.png) writePngs(denoised, light, lit);
}

void FrameWriter::writePngs(const DenoisedFrame& denoised, const Versions& light, const Versions& lit) {
  PictureGrid result(1);
  PictureGrid comparison;
  const auto add = [&](const Versions& versions, std::optional<float>& exposure) {
    if (!exposure || denoised.frame.resetHistory) {
      exposure = options_.exposure ? options_.exposure : autoExposure(versions.back());
    }
    const float stops = exposure.value_or(0.0F);
    result.front().push_back({&versions[kDenoised], stops});
    std::vector<ExposedPicture>& row = comparison.emplace_back();
    for (const Image& version : versions) row.push_back({&version, stops});
  };
  if (!lit.empty()) add(lit, litExposure_);
  add(light, lightExposure_);
  const auto path = [&](const char* prefix) {
    return options_.directory / frameFileName(prefix, denoised.frame.number, "png");
  };
  writePng(path("denoised"), result);
  writePng(path("comparison"), comparison);
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
    const Image& half = frame.reference->indirectHalf;
    if (!half.empty()) report.referenceNoise = referenceNoise(reference, half, mask);
  }
  return report;
}

}  // namespace walr
