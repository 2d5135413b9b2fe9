#include "tests/passes/reference/walr.h"

namespace walr::reference {

Image<glm::dvec3> Walr::denoise(const HostFrame& frame) {
  const Image<Guide> guides = prepareGuides(frame, storage_, settings_.guides);
  const Image<glm::dvec4> accumulated =
      meansAndLengths(accumulate(frame, guides, accumulation_, storage_, settings_.accumulation));
  filtered_ = weightedRegression(frame, guides, accumulated, storage_, settings_.regression);
  const Image<glm::dvec4> resolved =
      meansAndLengths(antialias(frame, guides, filtered_, antialiasing_, storage_, settings_.antialiasing));
  accumulation_ = {guides, accumulated};
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
