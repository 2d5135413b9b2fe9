#include "samples/denoise/frame_output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "samples/denoise/averaged_frame.h"
#include "samples/image/exposure.h"
#include "samples/image/exr.h"
#include "samples/image/png.h"
#include "samples/metrics/metrics.h"
#include "samples/sequence/writer.h"

namespace walr {
namespace {

// Index into FrameWriter::Versions.
constexpr std::size_t kDenoised = 1;

float finiteOrZero(float value) {
  return std::isfinite(value) ? value : 0.0F;
}

/// The first image that is not empty.
const Image& firstOf(const Image& image, const Image& otherwise) {
  return image.empty() ? otherwise : image;
}

/// The reference of a frame, or one without images.
const Reference& referenceOf(const Frame& frame) {
  static const Reference none;
  return frame.reference ? *frame.reference : none;
}

/// Errors of a light.
/// @param half  mean of half of the samples of `reference`; may be empty
/// @param albedo  of the lobe that reflects the light
LightErrors errorsOf(const Image& denoised, const Image& noisy, const Image& reference, const Image& half,
                     const Image& albedo, const Frame& frame) {
  LightErrors errors;
  if (denoised.empty() || reference.empty()) return errors;
  const PixelMask mask = diffuseMask(albedo, frame.normal, frame.depth, kSkyDepth, reference);
  errors.denoised = compare(denoised, reference, mask);
  errors.noisy = compare(noisy, reference, mask);
  if (!half.empty()) errors.referenceNoise = referenceNoise(reference, half, mask);
  return errors;
}

/// RMSE of denoised specular light in each class of roughness.
FiguresByRoughness errorsByRoughness(const Image& denoised, const Frame& frame) {
  const Image& reference = referenceOf(frame).specular;
  if (denoised.empty() || reference.empty()) return {};
  const PixelMask mask = diffuseMask(frame.specularAlbedo, frame.normal, frame.depth, kSkyDepth, reference);
  return rmseByRoughness(display(denoised, reference, mask), mask, frame.roughness);
}

}  // namespace

Image composite(const Image& indirect, const Image& direct, const Image& albedo, const Image& emission) {
  Image lit(indirect.width(), indirect.height(), 3);
  for (std::size_t i = 0; i < lit.values().size(); ++i) {
    lit.values()[i] = finiteOrZero(albedo.values()[i]) * (finiteOrZero(direct.values()[i]) + indirect.values()[i]) +
                      finiteOrZero(emission.values()[i]);
  }
  return lit;
}

std::filesystem::path FrameWriter::path(const std::string& prefix, const Frame& frame, const char* extension) const {
  return options_.directory / frameFileName(prefix, frame.number, extension);
}

std::vector<Image> FrameWriter::litImages(const DenoisedFrame& denoised) const {
  const Frame& frame = denoised.frame;
  const Reference& reference = referenceOf(frame);
  Image undenoised;
  if (denoised.indirect.empty()) {
    undenoised = frame.indirect;
    std::ranges::transform(undenoised.values(), undenoised.values().begin(), finiteOrZero);
  }
  // Specular light is a part of the picture if it is denoised; else it is among `Frame::nonDiffuse`.
  const auto addSpecular = [&](Image lit, const Image& specular) {
    for (std::size_t i = 0; !denoised.specular.empty() && i < lit.values().size(); ++i) {
      lit.values()[i] += finiteOrZero(frame.specularAlbedo.values()[i]) * finiteOrZero(specular.values()[i]);
    }
    return lit;
  };
  const Image& indirect = firstOf(denoised.indirect, undenoised);
  const Image& direct = firstOf(denoised.direct, frame.direct);
  const auto light = [&](const Image& someIndirect, const Image& someDirect) {
    const Image& chosen = options_.referenceDirect ? firstOf(reference.direct, someDirect) : someDirect;
    Image lit = composite(someIndirect, chosen, frame.albedo, frame.emission);
    for (std::size_t i = 0; i < frame.nonDiffuse.values().size(); ++i) lit.values()[i] += frame.nonDiffuse.values()[i];
    return lit;
  };
  std::vector<Image> lit{addSpecular(light(frame.indirect, frame.direct), frame.specular),
                         addSpecular(light(indirect, direct), denoised.specular)};
  if (frame.reference) {
    lit.push_back(addSpecular(light(firstOf(reference.indirect, indirect), firstOf(reference.direct, direct)),
                              firstOf(reference.specular, denoised.specular)));
  }
  return lit;
}

void FrameWriter::write(const DenoisedFrame& denoised, const DenoisedFrame& shown) {
  std::vector<Image> lit = options_.composite ? litImages(denoised) : std::vector<Image>{};
  const int side = denoised.frame.depth.width() / shown.frame.depth.width();
  if (side > 1) {
    for (Image& image : lit) image = averaged(image, side);
  }
  writePictures(shown, lit);
  for (const ViewPicture& view : denoised.views) {
    std::vector<ExrChannel> components;
    appendChannels(components, "", "XYZ", view.image, ExrType::Float);
    writeExr(path("view_" + view.name, denoised.frame), components, {}, denoised.frame.place);
  }
  if (!denoised.slopes.front().empty()) {
    std::vector<ExrChannel> components;
    constexpr std::array kNames{"SlopeX", "SlopeY", "SlopeZ"};
    for (std::size_t axis = 0; axis < kNames.size(); ++axis)
      appendChannels(components, kNames.at(axis), "RGB", denoised.slopes.at(axis));
    writeExr(path("direction", denoised.frame), components, {}, denoised.frame.place);
  }
}

void FrameWriter::writePictures(const DenoisedFrame& shown, const std::vector<Image>& lit) {
  const Frame& frame = shown.frame;
  std::vector<ExrChannel> channels;
  std::vector<Versions> rows;
  if (!lit.empty()) {
    appendChannels(channels, "", "RGB", lit[kDenoised]);
    Versions& versions = rows.emplace_back();
    for (const Image& image : lit) versions.push_back(&image);
  }
  const auto addLight = [&](const std::string& plane, const Image& noisy, const Image& result, const Image& reference) {
    if (result.empty()) return;
    appendChannels(channels, plane, "RGB", result);
    Versions& versions = rows.emplace_back(Versions{&noisy, &result});
    if (!reference.empty()) versions.push_back(&reference);
  };
  addLight(options_.indirectPlane, frame.indirect, shown.indirect, referenceOf(frame).indirect);
  addLight(options_.directPlane, frame.direct, shown.direct, referenceOf(frame).direct);
  addLight("Specular", frame.specular, shown.specular, referenceOf(frame).specular);
  writeExr(path("denoised", frame), channels, {}, frame.place);
  if (options_.png) writePngs(frame, rows);
}

void FrameWriter::writePngs(const Frame& frame, const std::vector<Versions>& rows) {
  PictureGrid result(1);
  PictureGrid comparison;
  exposures_.resize(rows.size());
  // All rows have the same length: without the reference of some light, no reference is shown.
  const auto count = [](const Versions& versions) { return versions.size(); };
  const std::size_t shown = std::ranges::min_element(rows, {}, count)->size();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::span<const Image* const> versions = std::span(rows[i]).first(shown);
    std::optional<float>& exposure = exposures_[i];
    if (!exposure || frame.resetHistory) {
      exposure = options_.exposure ? options_.exposure : autoExposure(*versions.back());
    }
    const float stops = exposure.value_or(0.0F);
    result.front().push_back({versions[kDenoised], stops});
    std::vector<ExposedPicture>& row = comparison.emplace_back();
    for (const Image* const version : versions) row.push_back({version, stops});
  }
  writePng(path("denoised", frame, "png"), result);
  writePng(path("comparison", frame, "png"), comparison);
}

FrameReport measure(const DenoisedFrame& denoised, const DenoisedFrame& shown) {
  const Frame& frame = shown.frame;
  FrameReport report;
  report.frame = frame.number;
  report.resetHistory = frame.resetHistory;
  report.gpuMilliseconds = denoised.gpuMilliseconds;
  report.nonFiniteOutput =
      countNonFinite(denoised.indirect) + countNonFinite(denoised.direct) + countNonFinite(denoised.specular);
  report.counters = denoised.counters;
  const Reference& reference = referenceOf(frame);
  report.indirect =
      errorsOf(shown.indirect, frame.indirect, reference.indirect, reference.indirectHalf, frame.albedo, frame);
  report.direct = errorsOf(shown.direct, frame.direct, reference.direct, {}, frame.albedo, frame);
  report.specular =
      errorsOf(shown.specular, frame.specular, reference.specular, reference.specularHalf, frame.specularAlbedo, frame);
  report.byRoughness = errorsByRoughness(shown.specular, frame);
  return report;
}

}  // namespace walr
