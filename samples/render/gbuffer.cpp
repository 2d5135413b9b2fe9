#include "samples/render/gbuffer.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "samples/render/exact/specular.h"

namespace walr::render {
namespace {

// Image motion of a point whose position in the previous view space is `previous`. A point that was behind the camera
// or far outside the image gets a motion that leads outside the image and still fits a half float.
glm::vec2 imageMotion(const View& view, std::uint32_t x, std::uint32_t y, const glm::vec3& previous) {
  const glm::vec2 size(static_cast<float>(view.width), static_cast<float>(view.height));
  const glm::vec2 outside = 2.0F * size;
  if (!(previous.z < 0.0F)) {
    return outside;
  }
  const glm::vec2 center = glm::vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5F;
  return glm::clamp(project(view, previous) - view.previousJitter - center, -outside, outside);
}

// The share of the light from `direction` that a mirror reflects; 0 if the direction leads below the surface.
glm::vec3 mirrorWeight(const Surface& surface, const glm::vec3& direction) {
  if (glm::dot(surface.geometricNormal, direction) <= 0.0F) {
    return glm::vec3(0.0F);
  }
  const float cosine = glm::dot(surface.shadingNormal, surface.towardsViewer);
  return glm::mix(exact::reflectanceOf(surface.reflectance, surface.metallic), glm::vec3(1.0F), exact::grazing(cosine));
}

}  // namespace

PrimaryHit tracePrimary(const World& world, const View& view, std::uint32_t x, std::uint32_t y, GBufferMode mode) {
  const Ray primary = primaryRay(view, x, y);
  PrimaryHit result;
  Ray ray = primary;
  glm::mat4 imageFromWorld(1.0F);  // From a point to its virtual image behind the mirrors so far.
  for (int mirrors = 0;; ++mirrors) {
    const std::optional<Hit> hit = world.rays().closest(ray);
    if (!hit) {
      result.pixel.emission += result.tint * world.sky().radiance(ray.direction);
      const glm::vec3 previousDirection = glm::mat3(view.previousViewFromWorld) * primary.direction;
      result.pixel.motion = glm::vec3(imageMotion(view, x, y, previousDirection), 0.0F);
      return result;
    }
    const Surface surface = evaluateSurface(world.scene(), world.instances()[hit->instance], *hit, ray);
    const bool isMirror = mode == GBufferMode::BehindMirrors && exact::isMirror(surface.metallic, surface.roughness);
    if (isMirror && mirrors < exact::kMostMirrors) {
      const glm::vec3 direction = exact::mirrorDirection(surface.shadingNormal, surface.towardsViewer);
      result.pixel.emission += result.tint * surface.emission;
      result.tint *= mirrorWeight(surface, direction);
      imageFromWorld = imageFromWorld * exact::reflectionAt(surface.shadingNormal, surface.position);
      ray = {rayOrigin(surface, direction), direction};
      continue;
    }
    const glm::mat4 viewFromWorld = view.viewFromWorld * imageFromWorld;
    const glm::vec3 position(viewFromWorld * glm::vec4(surface.position, 1.0F));
    const glm::vec3 previous(view.previousViewFromWorld * imageFromWorld * glm::vec4(surface.previousPosition, 1.0F));
    result.pixel.position = position;
    result.pixel.normal = glm::mat3(viewFromWorld) * surface.shadingNormal;
    result.pixel.albedo = result.tint * surface.albedo;
    result.pixel.emission += result.tint * surface.emission;
    result.pixel.motion = glm::vec3(imageMotion(view, x, y, previous), position.z - previous.z);
    result.pixel.objectId = hit->instance;
    result.surface = surface;
    result.imageFromWorld = glm::mat3(imageFromWorld);
    return result;
  }
}

}  // namespace walr::render
