#include "passes/guides/shared_guides.h"

#include <stdexcept>

namespace walr {

Guides SharedGuides::guidesFor(const Made& wanted) const {
  if (prepared_->made == wanted) return prepared_->guides;
  throw std::invalid_argument(
      "the lights cannot share guides, because their settings ask for different ones: give both the same guides.*, "
      "occlusion.*, scene.*, spatial-only, *.rejection, antialiasing.enabled, regression.plane-normal and "
      "regression.occlusion-guide, or make a denoiser for each light, as for specular and diffuse light");
}

}  // namespace walr
