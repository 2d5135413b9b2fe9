#include "samples/gpu_render/trace_frame.h"

#include <cmath>

#include <glm/matrix.hpp>

#include "samples/render/scene_error.h"

namespace walr::gpu_render {
namespace {

float kindOf(render::PunctualLight::Kind kind) {
  switch (kind) {
    case render::PunctualLight::Kind::Directional:
      return kDirectionalLight;
    case render::PunctualLight::Kind::Spot:
      return kSpotLight;
    case render::PunctualLight::Kind::Point:
      break;
  }
  return kPointLight;
}

std::uint32_t sequenceOf(render::Sampler::Kind kind) {
  switch (kind) {
    case render::Sampler::Kind::Sobol:
      return kSobol;
    case render::Sampler::Kind::BlueNoise:
      return kBlueNoise;
    case render::Sampler::Kind::Independent:
      break;
  }
  return kIndependent;
}

}  // namespace

std::size_t emissiveTriangles(const render::World& world) {
  std::size_t count = 0;
  for (const render::Instance& instance : world.instances()) {
    const render::Mesh& mesh = world.scene().meshes[instance.mesh];
    if (world.scene().materials[mesh.material].emits()) count += mesh.triangles.size();
  }
  return count;
}

SceneState sceneState(const render::World& world) {
  SceneState state;
  const auto& firstEmitters = world.lights().firstEmitters();
  for (std::size_t i = 0; i < world.instances().size(); ++i) {
    const render::Instance& instance = world.instances()[i];
    state.instances.push_back({instance.worldFromObject, instance.previousWorldFromObject,
                               glm::mat4(instance.normalFromObject), instance.mesh, firstEmitters[i].value_or(kAbsent),
                               (render::isDisplaced(instance) ? kDisplaced : 0) | (instance.mirrored ? kMirrored : 0),
                               0});
  }
  for (const render::PlacedLight& light : world.lights().punctual()) {
    state.punctualLights.push_back({glm::vec4(light.position, kindOf(light.light.kind)),
                                    glm::vec4(light.axis, light.light.cosInnerCone),
                                    glm::vec4(light.light.intensity, light.light.cosOuterCone)});
  }
  for (const render::Emitter& emitter : world.lights().emitters()) {
    // Random numbers are multiples of 2^-24, so that comparing with the rounded product is comparing with the double.
    const auto cumulative = static_cast<std::uint32_t>(std::ceil(emitter.cumulative * 0x1p24));
    state.emitters.push_back({glm::vec4(emitter.corners[0], emitter.area),
                              glm::vec4(emitter.corners[1], emitter.probability), glm::vec4(emitter.corners[2], 0.0F),
                              emitter.instance, emitter.triangle, cumulative, 0});
  }
  state.emitters.resize(emissiveTriangles(world), EmitterData{});
  return state;
}

TraceConstants traceConstants(const render::World& world, const render::View& view,
                              const render::SamplingSettings& settings, const render::ReferenceCoverage& coverage) {
  if (settings.reservoirs != nullptr) {
    throw render::SceneError("the path tracer on the GPU has no resampling (--resampled-frames): use --tracer cpu");
  }
  const render::Scene& scene = world.scene();
  TraceConstants constants{};
  constants.viewFromWorld = view.viewFromWorld;
  constants.worldFromView = glm::inverse(view.viewFromWorld);
  constants.previousViewFromWorld = view.previousViewFromWorld;
  constants.projection = view.projection;
  constants.skyRadiance = glm::vec4(scene.skyRadiance, 0.0F);
  constants.jitter = view.jitter;
  constants.previousJitter = view.previousJitter;
  constants.size = {view.width, view.height};
  constants.lightGroup = {settings.light.columns, settings.light.rows};
  constants.lightOffset = settings.lightOffset;
  if (scene.skyMap) constants.skySize = {scene.skyMap->width, scene.skyMap->height};
  constants.sequence = sequenceOf(settings.sampler);
  constants.seed = settings.seed;
  constants.firstSample = settings.firstSample;
  constants.samples = settings.samples;
  constants.bounces = settings.bounces;
  constants.punctualLights = static_cast<std::uint32_t>(world.lights().punctual().size());
  constants.emitters = static_cast<std::uint32_t>(world.lights().emitters().size());
  constants.stillPart = static_cast<std::uint32_t>(world.instances().size());
  constants.oneSquareIn = coverage.oneSquareIn;
  constants.squareShift = coverage.rowShift();
  constants.flags = (scene.diffuseModel == render::DiffuseModel::Disney ? kDisneyDiffuse : 0) |
                    (world.sky().isSampled() ? kSkySampled : 0) | (coverage.wholePixel ? kWholePixel : 0) |
                    (settings.gbuffer == render::GBufferMode::BehindMirrors ? kBehindMirrors : 0);
  return constants;
}

}  // namespace walr::gpu_render
