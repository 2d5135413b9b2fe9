#include "passes/temporal/reprojection.h"

namespace walr {

ReprojectionSettings reprojectionOf(const SceneDescription& scene, bool still, HistoryRejection rejection,
                                    bool dilateMotion) {
  if (still && scene.still()) return {MotionSource::None, HistoryRejection::None, false};
  return {scene.objectMotion ? MotionSource::Texture : MotionSource::Camera, rejection, dilateMotion};
}

void readReprojection(fg::PassBuilder& pass, const DenoiserInputs& inputs, const Guides& guides,
                      const ReprojectionSettings& settings, const StandIns& standIns) {
  const bool fromTexture = settings.motion == MotionSource::Texture;
  const bool byPlane = settings.rejection == HistoryRejection::Plane;
  const bool byDepth = settings.rejection == HistoryRejection::Depth;
  const bool normalBesideDepth = !guides.geometricNormal.valid() && (byPlane || guides.features.valid());
  const bool readsNormals = byPlane && !normalBesideDepth;
  pass.specialize("kJitter", inputs.scene.jitter && (!fromTexture || inputs.conventions.motionJittered))
      .specialize("kMotionFromCamera", !fromTexture)
      .specialize("kMotionDepthGiven", inputs.conventions.motionDepth == InputConventions::MotionDepth::Given)
      .specialize("kMotionDepthFound",
                  fromTexture && inputs.conventions.motionDepth == InputConventions::MotionDepth::Found)
      .specialize("kRejectByPlane", byPlane)
      .specialize("kRejectByDepth", byDepth)
      .sampleIf(fromTexture || !standIns.colour.valid(), "motion", fromTexture ? inputs.motion : inputs.lighting,
                standIns.colour)
      .sampleIf(byPlane || byDepth, "previousDepth", guides.previousDepth, standIns.number);
  if (settings.preparesGuides) return;
  pass.specialize("kDilateMotion", settings.dilateMotion).specialize("kNormalBesideDepth", normalBesideDepth);
  if (settings.testsNormals) {
    // Taps of specular light are given, and its views leave the normals unread.
    const bool kept = guides.previousGeometricNormal.valid() || !inputs.conventions.specular;
    pass.sampleIf(readsNormals && kept, "previousGeometricNormal", guides.previousGeometricNormal, standIns.number);
  }
  pass.sampleIf(readsNormals, "geometricNormal", guides.geometricNormal, standIns.number);
}

void readConfidence(fg::PassBuilder& pass, fg::Texture confidence, const DenoiserInputs& inputs,
                    const StandIns& standIns) {
  const bool known = confidence.valid();
  pass.specialize("kConfidence", known)
      .sampleIf(known || !standIns.colour.valid(), "confidence", known ? confidence : inputs.lighting, standIns.colour);
}

void readObjectIds(fg::PassBuilder& pass, const ObjectIds& objects, const StandIns& standIns) {
  const bool known = objects.current.valid();
  pass.specialize("kRejectByObject", known)
      .sampleIf(known, "objects", objects.current, standIns.number)
      .sampleIf(known, "previousObjects", objects.previous, standIns.number);
}

}  // namespace walr
