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
  // Taps of specular light are given, and its views leave the normals unread.
  const bool testsNormals = byPlane && settings.testsNormals && !inputs.conventions.specular;
  const bool normalBesideDepth = !guides.geometricNormal.valid() && (testsNormals || guides.features.valid());
  const bool readsNormals = testsNormals && !normalBesideDepth;
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
  if (!settings.testsNormals) return;
  pass.sampleIf(readsNormals, "geometricNormal", guides.geometricNormal, standIns.number)
      .sampleIf(readsNormals, "previousGeometricNormal", guides.previousGeometricNormal, standIns.number);
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
