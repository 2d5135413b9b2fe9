#include "passes/reprojection.h"

namespace walr {

MotionSource motionSource(const SceneDescription& scene) {
  return scene.objectMotion ? MotionSource::Texture : MotionSource::Camera;
}

void readReprojection(fg::PassBuilder& pass, const DenoiserInputs& inputs, const Guides& guides,
                      HistoryRejection rejection, MotionSource motion, bool dilateMotion) {
  pass.uniform("frameConstants", inputs.frame)
      .sample("depth", guides.depth)
      .specialize("kJitter",
                  inputs.scene.jitter && (motion == MotionSource::Camera || inputs.conventions.motionJittered))
      .specialize("kDilateMotion", dilateMotion);
  if (motion == MotionSource::Texture) {
    const bool motionDepthGiven = inputs.conventions.motionDepth == InputConventions::MotionDepth::Given;
    pass.sample("motion", inputs.motion).specialize("kMotionDepthGiven", motionDepthGiven);
  }
  if (rejection != HistoryRejection::None) pass.sample("previousDepth", guides.previousDepth);
  if (rejection == HistoryRejection::Plane) {
    pass.sample("geometricNormal", guides.geometricNormal)
        .sample("previousGeometricNormal", guides.previousGeometricNormal);
  }
}

void readObjectIds(fg::PassBuilder& pass, const ObjectIds& objects) {
  pass.sample("objects", objects.current).sample("previousObjects", objects.previous);
}

}  // namespace walr
