#include "passes/reprojection.h"

namespace walr {

void readReprojection(fg::PassBuilder& pass, const DenoiserInputs& inputs, const Guides& guides, bool dilateMotion) {
  const bool motionDepthGiven = inputs.conventions.motionDepth == InputConventions::MotionDepth::Given;
  pass.uniform("frameConstants", inputs.frame)
      .sample("motion", inputs.motion)
      .sample("depth", guides.depth)
      .sample("normals", guides.normals)
      .sample("previousDepth", guides.previousDepth)
      .sample("previousNormals", guides.previousNormals)
      .specialize("kMotionDepthGiven", motionDepthGiven)
      .specialize("kDilateMotion", dilateMotion);
}

}  // namespace walr
