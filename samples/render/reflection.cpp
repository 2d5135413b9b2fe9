#include "samples/render/reflection.h"

#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "samples/render/exact/specular.h"
#include "samples/render/path_tracer.h"

namespace walr::render {
namespace {

// The thresholds of the program of Fu 2022.
constexpr float kLeastMetallic = 0.5F;
constexpr float kMirrorRoughness = 0.1F;

// A path ends after this many reflections at metals.
constexpr int kMostReflections = 8;

bool leadsUnder(const Surface& surface, const glm::vec3& direction) {
  return glm::dot(surface.geometricNormal, direction) <= 0.0F;
}

glm::vec3 fresnel(const Surface& surface, float grazing) {
  return glm::mix(exact::reflectanceOf(surface.reflectance, surface.metallic), glm::vec3(1.0F), grazing);
}

}  // namespace

Gloss glossOf(const Surface& surface) {
  if (surface.metallic < kLeastMetallic) {
    return Gloss::Diffuse;
  }
  return surface.roughness > kMirrorRoughness ? Gloss::Glossy : Gloss::Specular;
}

Reflection mirrored(const Surface& surface) {
  const glm::vec3 direction = exact::mirrorDirection(surface.shadingNormal, surface.towardsViewer);
  if (leadsUnder(surface, direction)) {
    return {direction, glm::vec3(0.0F)};
  }
  const float cosine = glm::dot(surface.shadingNormal, surface.towardsViewer);
  return {direction, fresnel(surface, exact::grazing(cosine))};
}

Reflection sampleReflection(const Surface& surface, const glm::vec2& random) {
  const float alpha = exact::alphaOf(surface.roughness);
  const glm::vec3 direction = exact::reflectionDirection(surface.shadingNormal, surface.towardsViewer, alpha, random);
  const float cosine = exact::lightCosine(surface.geometricNormal, surface.shadingNormal, direction);
  if (cosine <= 0.0F) {
    return {direction, glm::vec3(0.0F)};
  }
  const exact::SpecularLobe lobe = exact::specularLobe(surface.shadingNormal, surface.towardsViewer, direction, alpha);
  return {direction, fresnel(surface, lobe.grazing) * (lobe.value * cosine / lobe.density)};
}

GlossySample traceGlossy(const World& world, const Surface& surface, std::uint32_t bounces, Sampler& sampler,
                         bool lit) {
  GlossySample result;
  glm::vec3 weight(1.0F);
  Surface from = surface;
  for (int i = 0; i < kMostReflections; ++i) {
    const glm::vec2 random = sampler.next2D();
    const Reflection reflection = glossOf(from) == Gloss::Specular ? mirrored(from) : sampleReflection(from, random);
    weight *= reflection.weight;
    if (weight == glm::vec3(0.0F)) {
      return result;
    }
    ++result.rays;
    const Ray ray{rayOrigin(from, reflection.direction), reflection.direction};
    const std::optional<Hit> hit = world.rays().closest(ray);
    if (!hit) {
      result.albedo = weight;
      result.radiance += weight * world.sky().radiance(reflection.direction);
      return result;
    }
    const Surface next = evaluateSurface(world.scene(), world.instances()[hit->instance], *hit, ray);
    result.radiance += weight * next.emission;
    if (glossOf(next) == Gloss::Diffuse) {
      const bool isLamp = next.emission != glm::vec3(0.0F);
      result.albedo = weight * (isLamp ? glm::vec3(1.0F) : next.albedo);
      if (lit && next.albedo != glm::vec3(0.0F)) {
        const PathSample path = tracePath(world, next, bounces, sampler);
        result.radiance += weight * next.albedo * (path.direct + path.indirect);
        result.rays += path.rays;
      }
      return result;
    }
    from = next;
  }
  return result;
}

}  // namespace walr::render
