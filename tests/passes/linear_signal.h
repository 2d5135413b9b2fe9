#pragma once

#include <cmath>

#include "tests/passes/reference/guides.h"

namespace walr::test {

/// A wall whose light is exactly linear in the regression's features, with exponential noise.
struct LinearSignal {
  reference::HostFrame frame;  ///< Its lighting is the noisy signal.
  reference::Image<reference::Guide> guides;
  reference::Image<glm::dvec3> truth;
};

/// @param normalVariation amplitude by which the shading normals vary
LinearSignal linearSignal(glm::ivec2 size, double normalVariation);

/// Relative root mean square error of the filtered signal in one channel.
template <typename Colour>
double relativeRmse(const LinearSignal& signal, const reference::Image<Colour>& filtered) {
  double error = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < filtered.pixels().size(); ++i) {
    const double truth = signal.truth.pixels()[i].g;
    const double difference = filtered.pixels()[i].g - truth;
    error += difference * difference;
    size += truth * truth;
  }
  return std::sqrt(error / size);
}

}  // namespace walr::test
