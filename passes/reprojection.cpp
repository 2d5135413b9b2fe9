#include "passes/reprojection.h"

namespace walr {

void readReprojection(fg::PassBuilder& pass, const DenoiserInputs& inputs, const Guides& guides, bool dilateMotion) {
  const bool motionDepthGiven = inputs.conventions.motionDepth == InputConventions::MotionDepth::Given;
  pass.uniform("frameConstants", inputs.frame)
      .sample("motion", inputs.motion)
      .sample("depth", guides.depth)
      .sample("geometricNormal", guides.geometricNormal)
      .sample("previousDepth", guides.previousDepth)
      .sample("previousGeometricNormal", guides.previousGeometricNormal)
      .specialize("kMotionDepthGiven", motionDepthGiven)
      .specialize("kDilateMotion", dilateMotion);
}

}  // namespace walr
