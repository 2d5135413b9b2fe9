#include "samples/render/gbuffer.h"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

namespace walr::render {
namespace {

// Motion of what was at `previous` in the previous view space. What was behind the camera, or far outside the image,
// gets a motion that leads outside of the image and still fits a half float.
glm::vec2 imageMotion(const View& view, std::uint32_t x, std::uint32_t y, const glm::vec3& previous) {
  const glm::vec2 size(static_cast<float>(view.width), static_cast<float>(view.height));
  const glm::vec2 outside = 2.0F * size;
  if (!(previous.z < 0.0F)) {
    return outside;
  }
  const glm::vec2 center = glm::vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5F;
  return glm::clamp(project(view, previous) - view.previousJitter - center, -outside, outside);
}

}  // namespace

PrimaryHit tracePrimary(const World& world, const View& view, std::uint32_t x, std::uint32_t y) {
  const Ray ray = primaryRay(view, x, y);
  const std::optional<Hit> hit = world.rays().closest(ray);
  PrimaryHit result;
  if (!hit) {
    result.pixel.emission = world.sky().radiance(ray.direction);
    const glm::vec3 previousDirection = glm::mat3(view.previousViewFromWorld) * ray.direction;
    result.pixel.motion = glm::vec3(imageMotion(view, x, y, previousDirection), 0.0F);
    return result;
  }
  const Surface surface = evaluateSurface(world.scene(), world.instances()[hit->instance], *hit, ray.direction);
  const glm::vec3 position(view.viewFromWorld * glm::vec4(surface.position, 1.0F));
  const glm::vec3 previous(view.previousViewFromWorld * glm::vec4(surface.previousPosition, 1.0F));
  result.pixel.position = position;
  result.pixel.normal = glm::mat3(view.viewFromWorld) * surface.shadingNormal;
  result.pixel.albedo = surface.albedo;
  result.pixel.emission = surface.emission;
  result.pixel.motion = glm::vec3(imageMotion(view, x, y, previous), position.z - previous.z);
  result.pixel.objectId = hit->instance;
  result.surface = surface;
  return result;
}

}  // namespace walr::render
