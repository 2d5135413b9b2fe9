#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "samples/denoise/packed_frame.h"
#include "samples/denoise/roughness_classes.h"
#include "samples/metrics/display.h"
#include "samples/metrics/temporal.h"
#include "samples/sequence/sequence.h"

namespace walr {

/// The light that methods denoise: the specular light of frames of which nothing else was read, else indirect light.
Light judgedLight(const Sequence& sequence);

/// A frame with the data that its measurements need.
struct BenchFrame {
  PackedFrame packed;
  Light light = Light::Indirect;
  VisibleSurfaces surfaces;  ///< Its mask holds every pixel with the lobe that reflects the light.
  PixelMask judged;          ///< The pixels of this mask that have a reference; all of them in a frame without one.

  [[nodiscard]] const Frame& frame() const { return packed.frame; }
  [[nodiscard]] const Image& noisy() const { return specular() ? frame().specular : frame().indirect; }
  /// Only of a frame with a reference, as the next one.
  [[nodiscard]] const Image& reference() const {
    return specular() ? frame().reference->specular : frame().reference->indirect;
  }
  /// The mean of one half of the samples of the reference; empty if its file does not hold it.
  [[nodiscard]] const Image& referenceHalf() const {
    return specular() ? frame().reference->specularHalf : frame().reference->indirectHalf;
  }
  [[nodiscard]] bool specular() const { return light == Light::Specular; }
};

/// `previousPixels` without the pairs of which a pixel is outside its frame's `judged`.
std::vector<std::uint32_t> judgedPairs(std::vector<std::uint32_t> previousPixels, const PixelMask& judged,
                                       const PixelMask& previousJudged);

/// Read a frame.
/// @throws InputError
BenchFrame readBenchFrame(const Sequence& sequence, std::size_t index);

/// Properties of a frame that do not depend on the method.
struct FrameFacts {
  int number = 0;
  bool resetHistory = false;
  bool hasReference = true;
  std::optional<double> disoccluded;     ///< Share of the pixels that were not visible in the previous frame.
  std::optional<double> referenceNoise;  ///< See `referenceNoise`.
  FiguresByRoughness noiseByRoughness;   ///< The same by class, of specular light.
};

/// Properties of all frames.
/// @throws InputError
std::vector<FrameFacts> survey(const Sequence& sequence);

/// Numbers of the frames whose images are kept by default: of those with a reference the last one, and the one with the
/// largest disocclusion after history has built up. The choice depends on the input alone, so that it favours no
/// method.
/// @param facts  must contain a frame with a reference
std::vector<int> pictureFrames(const std::vector<FrameFacts>& facts);

/// Numbers of all frames with a reference.
std::vector<int> judgedFrames(const std::vector<FrameFacts>& facts);

}  // namespace walr
