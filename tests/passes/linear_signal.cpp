#include "tests/passes/linear_signal.h"

#include "tests/passes/reference/storage.h"
#include "tests/passes/synthetic_scene.h"

namespace walr::test {

LinearSignal linearSignal(glm::ivec2 size, double normalVariation) {
  LinearSignal signal;
  signal.frame = renderStill(bumpyWall(normalVariation), size, 3);
  signal.guides = reference::prepareGuides(signal.frame, reference::Storage::Quantised);
  signal.truth = reference::Image<glm::dvec3>(size);
  const reference::HostFrame clean = renderStill(bumpyWall(normalVariation), size, 3, Noise::None);
  reference::forEachPixel(size, [&](glm::ivec2 p) {
    const glm::dvec2 x = signal.guides[p].features;
    signal.truth[p] = glm::dvec3(1.0 + x.x - 0.7 * x.y);
    // Exponential noise, as in the samples of the synthetic scenes.
    const double sample = signal.truth[p].g * signal.frame.lighting[p].g / clean.lighting[p].g;
    signal.frame.lighting[p] = glm::dvec3(reference::roundToHalf(sample));
  });
  return signal;
}

}  // namespace walr::test
