#include "tests/passes/reference/walr.h"

#include "tests/passes/reference/antilag.h"

namespace walr::reference {

Image<glm::dvec3> Walr::denoise(const HostFrame& frame) {
  const bool keepTaps = sharesReprojection(settings_.antialiasing, settings_.accumulation);
  const Image<Guide> guides = prepareGuides(frame, storage_, settings_.guides);
  const Image<Accumulated> mean = accumulate(frame, guides, accumulation_, storage_, settings_.accumulation, keepTaps);
  const Image<glm::dvec4> accumulated = meansAndLengths(mean);
  filtered_ = weightedRegression(frame, guides, accumulated, storage_, settings_.regression);
  Image<glm::dvec4> filtered(frame.size());
  forEachPixel(frame.size(), [&](glm::ivec2 p) { filtered[p] = glm::dvec4(filtered_[p], 1.0); });
  const Image<glm::dvec4> resolved =
      meansAndLengths(antialias(frame, guides, filtered, antialiasing_, storage_, settings_.antialiasing, keepTaps));
  accumulation_ = {guides, accumulated};
  if (settings_.accumulation.antilag.enabled) accumulation_.antilag = antilagOf(mean, settings_.accumulation.antilag);
  antialiasing_ = {guides, resolved};
  Image<glm::dvec3> output(frame.size());
  forEachPixel(frame.size(), [&](glm::ivec2 p) { output[p] = glm::dvec3(resolved[p]); });
  return output;
}

void Walr::reset() {
  accumulation_ = {};
  antialiasing_ = {};
}

}  // namespace walr::reference
