#include "samples/render/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "samples/render/exact/path.h"

namespace walr::render {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

float lightCosine(const Surface& surface, const glm::vec3& direction) {
  return exact::lightCosine(surface.geometricNormal, surface.shadingNormal, direction);
}

// The value of the diffuse lobe relative to a Lambert lobe of the same albedo (Burley 2015, 5.3).
float lobe(DiffuseModel model, const Surface& surface, const glm::vec3& towardsLight) {
  if (model == DiffuseModel::Lambert) {
    return 1.0F;
  }
  const auto fresnel = [&](const glm::vec3& direction) {
    const float x = 1.0F - glm::clamp(glm::dot(surface.shadingNormal, direction), 0.0F, 1.0F);
    return x * x * x * x * x;
  };
  const float light = fresnel(towardsLight);
  const float view = fresnel(surface.towardsViewer);
  const float cosine = glm::dot(towardsLight, glm::normalize(towardsLight + surface.towardsViewer));
  const float retro = 2.0F * surface.roughness * cosine * cosine;
  return (1.0F - 0.5F * light) * (1.0F - 0.5F * view) + retro * (light + view + light * view * (retro - 1.0F));
}

// Next-event estimation along one path; counts its rays.
class LightSampling {
 public:
  LightSampling(const World& world, Sampler& sampler) : world_(world), sampler_(sampler) {}

  // Irradiance / pi at a path's first vertex. The order in which the kinds of lights take random numbers is fixed here,
  // because C++ does not fix it for the operands of a sum.
  glm::vec3 atFirst(const Surface& surface) {
    const glm::vec3 sky = fromSky(surface);
    const glm::vec3 emitters = fromEmitters(surface);
    return fromEveryPunctual(surface) + emitters + sky;
  }

  // The same at later vertices.
  glm::vec3 atLater(const Surface& surface) {
    const glm::vec3 sky = fromSky(surface);
    const glm::vec3 emitters = fromEmitters(surface);
    return fromOnePunctual(surface) + emitters + sky;
  }

  [[nodiscard]] std::uint32_t rays() const { return rays_; }

 private:
  // Irradiance / pi from all punctual lights.
  glm::vec3 fromEveryPunctual(const Surface& surface) {
    glm::vec3 sum(0.0F);
    for (const PlacedLight& light : world_.lights().punctual()) {
      sum += fromPunctual(surface, light);
    }
    return sum;
  }

  // An estimate of the same from one random light.
  glm::vec3 fromOnePunctual(const Surface& surface) {
    const std::vector<PlacedLight>& lights = world_.lights().punctual();
    if (lights.empty()) {
      return glm::vec3(0.0F);
    }
    const auto count = static_cast<float>(lights.size());
    const float choice = lights.size() == 1 ? 0.0F : sampler_.next1D();
    const auto index = std::min(static_cast<std::size_t>(choice * count), lights.size() - 1);
    return fromPunctual(surface, lights[index]) * count;
  }

  // An estimate of irradiance / pi from the emissive triangles, weighted for combination with cosine sampling.
  glm::vec3 fromEmitters(const Surface& surface) {
    if (!world_.lights().hasEmitters()) {
      return glm::vec3(0.0F);
    }
    const float choice = sampler_.next1D();
    const EmitterSample light =
        world_.lights().sampleEmitters(world_.scene(), world_.instances(), choice, sampler_.next2D());
    const glm::vec3 offset = light.position - surface.position;
    const float distance2 = glm::dot(offset, offset);
    if (!(distance2 > 0.0F) || !(light.density > 0.0F)) {
      return glm::vec3(0.0F);
    }
    const glm::vec3 direction = offset / std::sqrt(distance2);
    const float cosine = lightCosine(surface, direction);
    const float signedCosineAtLight = -glm::dot(light.normal, direction);
    const float cosineAtLight = light.doubleSided ? std::abs(signedCosineAtLight) : signedCosineAtLight;
    if (cosine <= 0.0F || cosineAtLight <= 0.0F || light.radiance == glm::vec3(0.0F)) {
      return glm::vec3(0.0F);
    }
    // The ray ends slightly before the light, so that it does not hit the light itself.
    const glm::vec3 origin = rayOrigin(surface, direction);
    constexpr float kBeforeTheEnd = 1.0F - 1e-4F;
    if (occluded({origin, light.position - origin, kBeforeTheEnd})) {
      return glm::vec3(0.0F);
    }
    const float solidAngleDensity = light.density * distance2 / cosineAtLight;
    const float cosineDensity = cosine / kPi;
    return light.radiance * (lobe(world_.scene().diffuseModel, surface, direction) * cosineDensity /
                             (solidAngleDensity + cosineDensity));
  }

  // The same from the sky map.
  glm::vec3 fromSky(const Surface& surface) {
    const Sky& sky = world_.sky();
    if (!sky.isSampled()) {
      return glm::vec3(0.0F);
    }
    const SkySample light = sky.sample(sampler_.next2D());
    const float cosine = lightCosine(surface, light.direction);
    if (cosine <= 0.0F || !(light.density > 0.0F) || occluded({rayOrigin(surface, light.direction), light.direction})) {
      return glm::vec3(0.0F);
    }
    const float cosineDensity = cosine / kPi;
    return light.radiance * (lobe(world_.scene().diffuseModel, surface, light.direction) * cosineDensity /
                             (light.density + cosineDensity));
  }

  bool occluded(const Ray& ray) {
    ++rays_;
    return world_.rays().occluded(ray);
  }

  glm::vec3 fromPunctual(const Surface& surface, const PlacedLight& light) {
    const Illumination arriving = illuminate(light, surface.position);
    const float cosine = lightCosine(surface, arriving.towardsLight);
    if (cosine <= 0.0F || arriving.irradiance == glm::vec3(0.0F)) {
      return glm::vec3(0.0F);
    }
    if (occluded({rayOrigin(surface, arriving.towardsLight), arriving.towardsLight, arriving.distance})) {
      return glm::vec3(0.0F);
    }
    return arriving.irradiance * (lobe(world_.scene().diffuseModel, surface, arriving.towardsLight) * cosine / kPi);
  }

  const World& world_;
  Sampler& sampler_;
  std::uint32_t rays_ = 0;
};

// Weight of cosine sampling for an emissive triangle that it hit (balance heuristic).
float cosineWeight(const World& world, const Surface& from, const glm::vec3& direction, const Hit& hit,
                   const Surface& light) {
  const float density = world.lights().emitterDensity(hit.instance, hit.triangle);
  const glm::vec3 offset = light.position - from.position;
  const float cosineAtLight = std::abs(glm::dot(light.geometricNormal, direction));
  const float cosineDensity = glm::dot(from.shadingNormal, direction) / kPi;
  const float lightDensity = density * glm::dot(offset, offset);
  // Both densities are multiplied by the cosine at the light, because a division by it could be by 0.
  const float sum = lightDensity + cosineDensity * cosineAtLight;
  return sum > 0.0F ? cosineDensity * cosineAtLight / sum : 0.0F;
}

// Radiance of the sky where cosine sampling met it, times the weight of cosine sampling (balance heuristic).
glm::vec3 metSky(const Sky& sky, const Surface& from, const glm::vec3& direction) {
  const glm::vec3 radiance = sky.radiance(direction);
  if (!sky.isSampled()) {
    return radiance;
  }
  const float cosineDensity = glm::dot(from.shadingNormal, direction) / kPi;
  return radiance * (cosineDensity / (cosineDensity + sky.density(direction)));
}

}  // namespace

PathSample tracePath(const World& world, const Surface& first, std::uint32_t bounces, Sampler& sampler) {
  LightSampling lights(world, sampler);
  PathSample result;
  result.direct = lights.atFirst(first);
  glm::vec3 throughput(1.0F);
  Surface surface = first;
  float firstLobe = 1.0F;
  std::uint32_t pathRays = 0;
  for (std::uint32_t bounce = 0;; ++bounce) {
    const glm::vec3 direction = exact::cosineDirection(surface.shadingNormal, sampler.next2D());
    if (lightCosine(surface, direction) <= 0.0F) {
      break;
    }
    const float value = lobe(world.scene().diffuseModel, surface, direction);
    throughput *= value;
    glm::vec3& bin = bounce == 0 ? result.direct : result.indirect;
    ++pathRays;
    const Ray ray{rayOrigin(surface, direction), direction};
    const std::optional<Hit> hit = world.rays().closest(ray);
    if (!hit) {
      bin += throughput * metSky(world.sky(), surface, direction);
      break;
    }
    const Surface next = evaluateSurface(world.scene(), world.instances()[hit->instance], *hit, ray);
    if (next.emission != glm::vec3(0.0F)) {
      bin += throughput * next.emission * cosineWeight(world, surface, direction, *hit, next);
    }
    throughput *= next.albedo;
    if (bounce == 0) {
      firstLobe = value;
      result.source = IndirectSource{next.position, next.geometricNormal, glm::vec3(0.0F)};
    }
    if (bounce == bounces || throughput == glm::vec3(0.0F)) {
      break;
    }
    surface = next;
    result.indirect += throughput * lights.atLater(surface);
  }
  if (result.source && firstLobe > 0.0F) {
    result.source->radiance = result.indirect / firstLobe;
  }
  result.rays = pathRays + lights.rays();
  return result;
}

glm::vec3 contribution(const World& world, const Surface& surface, const IndirectSource& source) {
  const glm::vec3 direction = glm::normalize(source.position - surface.position);
  const float cosine = lightCosine(surface, direction);
  return cosine > 0.0F ? source.radiance * (lobe(world.scene().diffuseModel, surface, direction) * cosine / kPi)
                       : glm::vec3(0.0F);
}

}  // namespace walr::render
