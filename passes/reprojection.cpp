#include "passes/reprojection.h"

namespace walr {

void readReprojection(fg::PassBuilder& pass, const DenoiserInputs& inputs, const Guides& guides,
                      HistoryRejection rejection, bool dilateMotion) {
  const bool motionDepthGiven = inputs.conventions.motionDepth == InputConventions::MotionDepth::Given;
  pass.uniform("frameConstants", inputs.frame)
      .sample("motion", inputs.motion)
      .sample("depth", guides.depth)
      .specialize("kMotionDepthGiven", motionDepthGiven)
      .specialize("kDilateMotion", dilateMotion);
  if (rejection != HistoryRejection::None) pass.sample("previousDepth", guides.previousDepth);
  if (rejection == HistoryRejection::Plane) {
    pass.sample("geometricNormal", guides.geometricNormal)
        .sample("previousGeometricNormal", guides.previousGeometricNormal);
  }
}

}  // namespace walr
