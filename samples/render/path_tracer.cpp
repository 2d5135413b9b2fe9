#include "samples/render/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "samples/render/exact/specular.h"

namespace walr::render {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

float lightCosine(const Surface& surface, const glm::vec3& direction) {
  return exact::lightCosine(surface.geometricNormal, surface.shadingNormal, direction);
}

// The value of the diffuse lobe relative to a Lambert lobe of the same albedo (Burley 2015, 5.3).
float diffuseLobe(DiffuseModel model, const Surface& surface, const glm::vec3& towardsLight) {
  if (model == DiffuseModel::Lambert) {
    return 1.0F;
  }
  const float light = exact::grazing(glm::dot(surface.shadingNormal, towardsLight));
  const float view = exact::grazing(glm::dot(surface.shadingNormal, surface.towardsViewer));
  const float cosine = glm::dot(towardsLight, glm::normalize(towardsLight + surface.towardsViewer));
  const float retro = 2.0F * surface.roughness * cosine * cosine;
  return (1.0F - 0.5F * light) * (1.0F - 0.5F * view) + retro * (light + view + light * view * (retro - 1.0F));
}

glm::vec3 reflectanceOf(const Surface& surface) {
  return exact::reflectanceOf(surface.reflectance, surface.metallic);
}

// How a vertex of a path reflects light.
class Reflector {
 public:
  // The first vertex of a path.
  Reflector(const Scene& scene, const Surface& surface, Lobe lobe)
      : scene_(&scene), surface_(&surface), diffuse_(lobe == Lobe::Diffuse ? 1.0F : 0.0F), share_(1.0F - diffuse_.x) {}
  // A later vertex, which is chosen to continue by a lobe with a probability proportional to the lobe's mean albedo.
  Reflector(const Scene& scene, const Surface& surface) : scene_(&scene), surface_(&surface) {
    if (!scene.specular) return;
    diffuse_ = surface.albedo;
    const glm::vec3 specular = specularAlbedo(surface);
    const float sum = specular.x + specular.y + specular.z;
    share_ = sum / (sum + (diffuse_.x + diffuse_.y + diffuse_.z));
  }

  [[nodiscard]] const Surface& surface() const { return *surface_; }

  [[nodiscard]] glm::vec3 sample(Sampler& sampler) const {
    const bool choose = share_ > 0.0F && share_ < 1.0F;
    const bool specular = choose ? sampler.next1D() < share_ : share_ > 0.0F;
    const glm::vec2 random = sampler.next2D();
    if (!specular) return exact::cosineDirection(surface_->shadingNormal, random);
    return exact::reflectionDirection(surface_->shadingNormal, surface_->towardsViewer,
                                      exact::alphaOf(surface_->roughness), random);
  }

  // Probability density of `sample` per solid angle.
  [[nodiscard]] float density(const glm::vec3& direction) const {
    const float cosine = glm::dot(surface_->shadingNormal, direction) / kPi;
    return share_ > 0.0F ? cosine * (1.0F - share_) + specular(direction).density * share_ : cosine;
  }

  // The BRDF relative to that of a Lambert lobe of albedo 1.
  [[nodiscard]] glm::vec3 value(const glm::vec3& direction) const {
    const float diffuse = diffuseLobe(scene_->diffuseModel, *surface_, direction);
    if (!scene_->specular) return glm::vec3(diffuse);
    const exact::SpecularLobe lobe = specular(direction);
    const float refracted = 1.0F - glm::mix(exact::kDielectric, 1.0F, lobe.grazing);
    const glm::vec3 reflected = glm::mix(reflectanceOf(*surface_), glm::vec3(1.0F), lobe.grazing);
    return diffuse_ * (diffuse * refracted) + (share_ > 0.0F ? reflected * (kPi * lobe.value) : glm::vec3(0.0F));
  }

 private:
  [[nodiscard]] exact::SpecularLobe specular(const glm::vec3& direction) const {
    return exact::specularLobe(surface_->shadingNormal, surface_->towardsViewer, direction,
                               exact::alphaOf(surface_->roughness));
  }

  const Scene* scene_;
  const Surface* surface_;
  glm::vec3 diffuse_{1.0F};  // Weight of the diffuse lobe; used with `Scene::specular`.
  float share_ = 0.0F;       // Probability that the path continues by the specular lobe.
};

// Next-event estimation along one path; counts its rays.
class LightSampling {
 public:
  LightSampling(const World& world, Sampler& sampler) : world_(world), sampler_(sampler) {}

  // Irradiance / pi at a path's first vertex. The order in which the kinds of lights take random numbers is fixed here,
  // because C++ does not fix it for the operands of a sum.
  glm::vec3 atFirst(const Reflector& at) {
    const glm::vec3 sky = fromSky(at);
    const glm::vec3 emitters = fromEmitters(at);
    return fromEveryPunctual(at) + emitters + sky;
  }

  // The same at later vertices.
  glm::vec3 atLater(const Reflector& at) {
    const glm::vec3 sky = fromSky(at);
    const glm::vec3 emitters = fromEmitters(at);
    return fromOnePunctual(at) + emitters + sky;
  }

  [[nodiscard]] std::uint32_t rays() const { return rays_; }

 private:
  // Irradiance / pi from all punctual lights.
  glm::vec3 fromEveryPunctual(const Reflector& at) {
    glm::vec3 sum(0.0F);
    for (const PlacedLight& light : world_.lights().punctual()) {
      sum += fromPunctual(at, light);
    }
    return sum;
  }

  // An estimate of the same from one random light.
  glm::vec3 fromOnePunctual(const Reflector& at) {
    const std::vector<PlacedLight>& lights = world_.lights().punctual();
    if (lights.empty()) {
      return glm::vec3(0.0F);
    }
    const auto count = static_cast<float>(lights.size());
    const float choice = lights.size() == 1 ? 0.0F : sampler_.next1D();
    const auto index = std::min(static_cast<std::size_t>(choice * count), lights.size() - 1);
    return fromPunctual(at, lights[index]) * count;
  }

  // An estimate of irradiance / pi from the emissive triangles, weighted for combination with cosine sampling.
  glm::vec3 fromEmitters(const Reflector& at) {
    if (!world_.lights().hasEmitters()) {
      return glm::vec3(0.0F);
    }
    const Surface& surface = at.surface();
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
    return light.radiance * (at.value(direction) * (cosine / kPi) / (solidAngleDensity + at.density(direction)));
  }

  // The same from the sky map.
  glm::vec3 fromSky(const Reflector& at) {
    const Sky& sky = world_.sky();
    if (!sky.isSampled()) {
      return glm::vec3(0.0F);
    }
    const Surface& surface = at.surface();
    const SkySample light = sky.sample(sampler_.next2D());
    const float cosine = lightCosine(surface, light.direction);
    if (cosine <= 0.0F || !(light.density > 0.0F) || occluded({rayOrigin(surface, light.direction), light.direction})) {
      return glm::vec3(0.0F);
    }
    return light.radiance *
           (at.value(light.direction) * (cosine / kPi) / (light.density + at.density(light.direction)));
  }

  bool occluded(const Ray& ray) {
    ++rays_;
    return world_.rays().occluded(ray);
  }

  glm::vec3 fromPunctual(const Reflector& at, const PlacedLight& light) {
    const Surface& surface = at.surface();
    const Illumination arriving = illuminate(light, surface.position);
    const float cosine = lightCosine(surface, arriving.towardsLight);
    if (cosine <= 0.0F || arriving.irradiance == glm::vec3(0.0F)) {
      return glm::vec3(0.0F);
    }
    if (occluded({rayOrigin(surface, arriving.towardsLight), arriving.towardsLight, arriving.distance})) {
      return glm::vec3(0.0F);
    }
    return arriving.irradiance * (at.value(arriving.towardsLight) * cosine / kPi);
  }

  const World& world_;
  Sampler& sampler_;
  std::uint32_t rays_ = 0;
};

// Weight of the path's direction for an emissive triangle that it hit (balance heuristic).
// @param density  of the direction, per solid angle
float weightOfHit(const World& world, const Surface& from, const glm::vec3& direction, float density, const Hit& hit,
                  const Surface& light) {
  const glm::vec3 offset = light.position - from.position;
  const float cosineAtLight = std::abs(glm::dot(light.geometricNormal, direction));
  const float lightDensity = world.lights().emitterDensity(hit.instance, hit.triangle) * glm::dot(offset, offset);
  // Both densities are multiplied by the cosine at the light, because a division by it could be by 0.
  const float sum = lightDensity + density * cosineAtLight;
  return sum > 0.0F ? density * cosineAtLight / sum : 0.0F;
}

// Radiance of the sky where a direction met it, times the direction's weight (balance heuristic).
glm::vec3 metSky(const Sky& sky, const glm::vec3& direction, float density) {
  const glm::vec3 radiance = sky.radiance(direction);
  return sky.isSampled() ? radiance * (density / (density + sky.density(direction))) : radiance;
}

}  // namespace

glm::vec3 specularAlbedo(const Surface& surface) {
  return exact::specularAlbedo(reflectanceOf(surface), surface.roughness,
                               glm::clamp(glm::dot(surface.shadingNormal, surface.towardsViewer), 0.0F, 1.0F));
}

PathSample tracePath(const World& world, const Surface& first, std::uint32_t bounces, Sampler& sampler, Lobe lobe) {
  const Scene& scene = world.scene();
  LightSampling lights(world, sampler);
  PathSample result;
  Surface surface = first;
  Reflector at(scene, surface, lobe);
  result.direct = lights.atFirst(at);
  glm::vec3 throughput(1.0F);
  glm::vec3 firstValue(1.0F);
  std::uint32_t pathRays = 0;
  for (std::uint32_t bounce = 0;; ++bounce) {
    const glm::vec3 direction = at.sample(sampler);
    const float cosine = lightCosine(surface, direction);
    if (cosine <= 0.0F) {
      break;
    }
    const float density = at.density(direction);
    const glm::vec3 value = at.value(direction);
    throughput *= value * (cosine / kPi / density);
    glm::vec3& bin = bounce == 0 ? result.direct : result.indirect;
    ++pathRays;
    const Ray ray{rayOrigin(surface, direction), direction};
    const std::optional<Hit> hit = world.rays().closest(ray);
    if (!hit) {
      bin += throughput * metSky(world.sky(), direction, density);
      break;
    }
    const Surface next = evaluateSurface(scene, world.instances()[hit->instance], *hit, ray);
    if (next.emission != glm::vec3(0.0F)) {
      bin += throughput * next.emission * weightOfHit(world, surface, direction, density, *hit, next);
    }
    // With a specular lobe, `Reflector` weights the lobes.
    if (!scene.specular) throughput *= next.albedo;
    if (bounce == 0) {
      firstValue = value;
      result.source = IndirectSource{next.position, next.geometricNormal, glm::vec3(0.0F)};
      result.distance = glm::distance(next.position, surface.position);
      result.motion = next.previousPosition - next.position;
    }
    if (bounce == bounces || throughput == glm::vec3(0.0F)) {
      break;
    }
    surface = next;
    at = Reflector(scene, surface);
    result.indirect += throughput * lights.atLater(at);
  }
  if (result.source && firstValue.x > 0.0F) {
    result.source->radiance = result.indirect / firstValue;
  }
  result.rays = pathRays + lights.rays();
  return result;
}

glm::vec3 contribution(const World& world, const Surface& surface, const IndirectSource& source) {
  const glm::vec3 direction = glm::normalize(source.position - surface.position);
  const float cosine = lightCosine(surface, direction);
  return cosine > 0.0F ? source.radiance * (diffuseLobe(world.scene().diffuseModel, surface, direction) * cosine / kPi)
                       : glm::vec3(0.0F);
}

}  // namespace walr::render
