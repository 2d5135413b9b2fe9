#include "samples/render/reflection.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "samples/render/exact/path.h"
#include "samples/render/path_tracer.h"

namespace walr::render {
namespace {

// The thresholds of the program of Fu 2022.
constexpr float kLeastMetallic = 0.5F;
constexpr float kMirrorRoughness = 0.1F;

// A path ends after this many reflections at metals.
constexpr int kMostReflections = 8;

glm::vec3 fresnel(const glm::vec3& reflectance, float cosine) {
  const float x = 1.0F - glm::clamp(cosine, 0.0F, 1.0F);
  return reflectance + (1.0F - reflectance) * (x * x * x * x * x);
}

bool leadsUnder(const Surface& surface, const glm::vec3& direction) {
  return glm::dot(surface.geometricNormal, direction) <= 0.0F;
}

// Smith's Lambda of a direction in the frame where the normal is +Z. The masking term is 1 / (1 + Lambda).
float smith(const glm::vec3& direction, float alpha) {
  const float tangent2 = (1.0F - direction.z * direction.z) / (direction.z * direction.z);
  return 0.5F * (std::sqrt(1.0F + alpha * alpha * tangent2) - 1.0F);
}

// The inverse of `exact::fromLocal`.
glm::vec3 toLocal(const glm::vec3& normal, const glm::vec3& direction) {
  const glm::vec3 x = exact::fromLocal(normal, {1.0F, 0.0F, 0.0F});
  const glm::vec3 y = exact::fromLocal(normal, {0.0F, 1.0F, 0.0F});
  return {glm::dot(x, direction), glm::dot(y, direction), glm::dot(normal, direction)};
}

glm::vec3 visibleNormal(const glm::vec3& viewer, float alpha, const glm::vec2& random) {
  const glm::vec3 stretched = glm::normalize(glm::vec3(alpha * viewer.x, alpha * viewer.y, viewer.z));
  const float angle = 2.0F * std::numbers::pi_v<float> * random.x;
  const float z = (1.0F - random.y) * (1.0F + stretched.z) - stretched.z;
  const float radius = std::sqrt(std::max(1.0F - z * z, 0.0F));
  const glm::vec3 normal = glm::vec3(radius * std::cos(angle), radius * std::sin(angle), z) + stretched;
  return glm::normalize(glm::vec3(alpha * normal.x, alpha * normal.y, std::max(normal.z, 1e-6F)));
}

}  // namespace

Gloss glossOf(const Surface& surface) {
  if (surface.metallic < kLeastMetallic) {
    return Gloss::Diffuse;
  }
  return surface.roughness > kMirrorRoughness ? Gloss::Glossy : Gloss::Specular;
}

Reflection mirrored(const Surface& surface) {
  const glm::vec3 direction = glm::reflect(-surface.towardsViewer, surface.shadingNormal);
  if (leadsUnder(surface, direction)) {
    return {direction, glm::vec3(0.0F)};
  }
  return {direction, fresnel(surface.reflectance, glm::dot(surface.shadingNormal, surface.towardsViewer))};
}

Reflection sampleReflection(const Surface& surface, const glm::vec2& random) {
  const float alpha = surface.roughness * surface.roughness;
  const glm::vec3 viewer = toLocal(surface.shadingNormal, surface.towardsViewer);
  if (viewer.z <= 0.0F) {
    return {};
  }
  const glm::vec3 normal = visibleNormal(viewer, alpha, random);
  const glm::vec3 light = glm::reflect(-viewer, normal);
  const glm::vec3 direction = exact::fromLocal(surface.shadingNormal, light);
  if (light.z <= 0.0F || leadsUnder(surface, direction)) {
    return {direction, glm::vec3(0.0F)};
  }
  const float masked = 1.0F + smith(viewer, alpha);
  return {direction,
          fresnel(surface.reflectance, glm::dot(viewer, normal)) * (masked / (masked + smith(light, alpha)))};
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
