#include "passes/guides/shared_guides.h"

#include <stdexcept>

namespace walr {

Guides SharedGuides::guidesFor(const Made& wanted) const {
  if (prepared_->made == wanted) return prepared_->guides;
  if (prepared_->made.specular != wanted.specular) {
    throw std::invalid_argument(
        "specular and diffuse light have guides of their own: give each of them a SharedGuides of its own");
  }
  throw std::invalid_argument(
      "the lights cannot share guides, because their settings ask for different ones: give both the same guides.*, "
      "occlusion.*, scene.*, spatial-only, *.rejection, antialiasing.enabled, regression.plane-normal and "
      "regression.occlusion-guide, or make a denoiser for each light");
}

}  // namespace walr
