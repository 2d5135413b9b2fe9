#pragma once

#include "passes/temporal/temporal_antialiasing.h"
#include "tests/passes/reference/temporal_accumulation.h"

namespace walr::reference {

/// Guides and anti-aliased result of the previous frame.
struct AntialiasingHistory {
  Image<Guide> guides;         ///< Empty while there is no history.
  Image<glm::dvec4> resolved;  ///< rgb: mean; a: number of frames.
};

/// Convert to and from YCoCg, the axes in which colours are clipped: luma, orange minus blue, green minus the others.
glm::dvec3 toYCoCg(glm::dvec3 rgb);
glm::dvec3 fromYCoCg(glm::dvec3 yCoCg);

/// Variance clipping (Salvi 2016; h' of passes/WALR.md, 10): scale a colour's offset from a mean until no component
/// exceeds its deviation.
glm::dvec3 varianceClip(glm::dvec3 colour, glm::dvec3 mean, glm::dvec3 deviation);

/// Whether anti-aliasing averages a frame over the area of pixels: it is jittered (passes/WALR.md, 10).
bool coversPixelArea(const HostFrame& frame, const TemporalAntialiasingSettings& settings);

/// This frame's light of a pixel: in jittered frames an estimate of the mean over its area, from the samples around it
/// (Karis 2014; passes/WALR.md, 10), else its own sample.
/// @param filtered as for `antialias`; the pixel itself must have light
glm::dvec3 lightOfFrame(const HostFrame& frame, const Image<Guide>& guides, const Image<glm::dvec4>& filtered,
                        glm::ivec2 p, const TemporalAntialiasingSettings& settings);

/// How anti-aliasing finds history.
/// @param keptTaps see `antialias`
ReprojectionOptions reprojectionOf(const HostFrame& frame, const TemporalAntialiasingSettings& settings, bool keptTaps);
HistoryTests historyTestsOf(const HostFrame& frame, const TemporalAntialiasingSettings& settings);
/// How it reads history.
HistoryReading historyReadingOf(const HostFrame& frame, const TemporalAntialiasingSettings& settings);

/// Temporal anti-aliasing, the postprocessing phase (Meunier & Harada 2022, 4.4; passes/WALR.md, 10): bicubic history,
/// variance clipping, moving average. `Accumulated::error` bounds what single precision adds.
/// @param filtered rgb: the current frame; a: below 0 where no light is known
/// @param keptTaps whether the history taps are those that accumulation kept, for which the motion is rounded
Image<Accumulated> antialias(const HostFrame& frame, const Image<Guide>& guides, const Image<glm::dvec4>& filtered,
                             const AntialiasingHistory& previous, Storage storage,
                             const TemporalAntialiasingSettings& settings = {}, bool keptTaps = false);

}  // namespace walr::reference
