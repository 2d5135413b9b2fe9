#pragma once

#include "passes/temporal_antialiasing.h"
#include "tests/passes/reference/temporal_accumulation.h"

namespace walr::reference {

/// What the postprocessing left one frame ago.
struct AntialiasingHistory {
  Image<Guide> guides;         ///< Empty while there is no history.
  Image<glm::dvec4> resolved;  ///< rgb: mean; a: number of frames.
};

/// The axes in which colours are clipped: luma, orange minus blue, green minus the others.
glm::dvec3 toYCoCg(glm::dvec3 rgb);
glm::dvec3 fromYCoCg(glm::dvec3 yCoCg);

/// Pull a colour towards a mean until no component is further from it than its deviation (Salvi 2016).
glm::dvec3 varianceClip(glm::dvec3 colour, glm::dvec3 mean, glm::dvec3 deviation);

/// The postprocessing (Meunier & Harada 2022, 4.4): bicubic history, variance clipping, moving average.
/// `Accumulated::error` bounds what single precision adds.
/// @param filtered rgb: the current frame; a: below 0 where no light is known
/// @param keptTaps whether the reprojection is the one that accumulation kept, which is rounded
Image<Accumulated> antialias(const HostFrame& frame, const Image<Guide>& guides, const Image<glm::dvec4>& filtered,
                             const AntialiasingHistory& previous, Storage storage,
                             const TemporalAntialiasingSettings& settings = {}, bool keptTaps = false);

}  // namespace walr::reference
