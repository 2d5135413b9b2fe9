// Paths as in samples/render/path_tracer.cpp: the same estimators, fed by the same random numbers in the same order.

// Light that arrives at a surface unless something lies in between.
struct Candidate {
  vec3 light;  // Irradiance / pi with the weight of next-event estimation; 0 if there is nothing to test.
  vec3 direction;
  float reach;  // In units of the length of `direction`.
};

const Candidate kNothing = Candidate(vec3(0.0), vec3(0.0), 0.0);

float lightCosine(Surface surface, vec3 direction) {
  return lightCosine(surface.geometricNormal, surface.shadingNormal, direction);
}

float diffuseLobe(Surface surface, vec3 towardsLight) {
  if ((trace.flags & kDisneyDiffuse) == 0u) return 1.0;
  const float light = grazing(dot(surface.shadingNormal, towardsLight));
  const float view = grazing(dot(surface.shadingNormal, surface.towardsViewer));
  const float cosine = dot(towardsLight, normalize(towardsLight + surface.towardsViewer));
  const float retro = 2.0 * surface.roughness * cosine * cosine;
  return (1.0 - 0.5 * light) * (1.0 - 0.5 * view) + retro * (light + view + light * view * (retro - 1.0));
}

// How a path's vertex reflects light, see `Reflector` in samples/render/path_tracer.cpp: the BRDF relative to that of a Lambert lobe
// of albedo 1, and the density of the direction in which the path continues.
#ifdef SPECULAR
SpecularLobe specularLobe(Surface surface, vec3 direction) {
  return specularLobe(surface.shadingNormal, surface.towardsViewer, direction, alphaOf(surface.roughness));
}

vec3 specularAlbedo(Surface surface) {
  return specularAlbedo(surface.reflectance, surface.roughness,
                        clamp(dot(surface.shadingNormal, surface.towardsViewer), 0.0, 1.0));
}

Surface firstVertex(Surface surface, bool specular) {
  surface.diffuse = vec3(specular ? 0.0 : 1.0);
  surface.share = specular ? 1.0 : 0.0;
  return surface;
}

Surface laterVertex(Surface surface) {
  surface.diffuse = surface.albedo;
  const vec3 specular = specularAlbedo(surface);
  const float sum = specular.x + specular.y + specular.z;
  surface.share = sum / (sum + (surface.diffuse.x + surface.diffuse.y + surface.diffuse.z));
  return surface;
}

vec3 value(Surface surface, vec3 direction) {
  const SpecularLobe lobe = specularLobe(surface, direction);
  const float refracted = 1.0 - mix(kDielectric, 1.0, lobe.grazing);
  const vec3 reflected = mix(surface.reflectance, vec3(1.0), lobe.grazing);
  return surface.diffuse * (diffuseLobe(surface, direction) * refracted) +
         (surface.share > 0.0 ? reflected * (kPi * lobe.value) : vec3(0.0));
}

float pathDensity(Surface surface, vec3 direction) {
  const float cosine = dot(surface.shadingNormal, direction) / kPi;
  return surface.share > 0.0 ? cosine * (1.0 - surface.share) + specularLobe(surface, direction).density * surface.share : cosine;
}
#else
float value(Surface surface, vec3 direction) { return diffuseLobe(surface, direction); }

float pathDensity(Surface surface, vec3 direction) { return dot(surface.shadingNormal, direction) / kPi; }
#endif

vec3 sampleDirection(Surface surface, inout Random random) {
#ifdef SPECULAR
  const bool choose = surface.share > 0.0 && surface.share < 1.0;
  const bool specular = choose ? next1D(random) < surface.share : surface.share > 0.0;
  if (specular) {
    return reflectionDirection(surface.shadingNormal, surface.towardsViewer, alphaOf(surface.roughness), next2D(random));
  }
#endif
  return cosineDirection(surface.shadingNormal, next2D(random));
}

Candidate fromPunctual(Surface surface, uint index) {
  const PunctualLightData light = punctualLights[index];
  Candidate result = Candidate(light.intensity.rgb, -light.axis.xyz, kEndless);
  if (light.position.w != kDirectionalLight) {
    const vec3 offset = light.position.xyz - surface.position;
    result.reach = length(offset);
    if (!(result.reach > 0.0)) return kNothing;
    result.direction = offset / result.reach;
    result.light /= result.reach * result.reach;
    if (light.position.w == kSpotLight) {
      const float cosine = dot(-result.direction, light.axis.xyz);
      const float fade = clamp((cosine - light.intensity.w) / max(0.001, light.axis.w - light.intensity.w), 0.0, 1.0);
      result.light *= fade * fade;
    }
  }
  const float cosine = lightCosine(surface, result.direction);
  if (cosine <= 0.0) return kNothing;
  result.light *= value(surface, result.direction) * cosine / kPi;
  return result;
}

// The emitter that a number in [0, 1) falls into.
uint chooseEmitter(float choice) {
  const uint scaled = uint(choice * 16777216.0);  // Exact: random numbers are multiples of 2^-24.
  uint low = 0u;
  uint high = trace.emitters - 1u;
  while (low < high) {
    const uint middle = (low + high) / 2u;
    if (scaled < emitters[middle].cumulative) {
      high = middle;
    } else {
      low = middle + 1u;
    }
  }
  return low;
}

float emitterDensity(EmitterData emitter) {
  return emitter.corner0.w > 0.0 ? emitter.corner1.w / emitter.corner0.w : 0.0;
}

Candidate fromEmitter(Surface surface, float choice, vec2 point) {
  const EmitterData emitter = emitters[chooseEmitter(choice)];
  const InstanceData instance = instances[emitter.instance];
  const MeshData mesh = meshes[instance.mesh];
  const MaterialData material = materials[mesh.material];
  const float root = sqrt(point.x);
  const vec2 weights = vec2(root * (1.0 - point.y), root * point.y);
  const vec3 position = emitter.corner0.xyz * (1.0 - weights.x - weights.y) + emitter.corner1.xyz * weights.x +
                        emitter.corner2.xyz * weights.y;
  const vec3 twiceArea = cross(emitter.corner1.xyz - emitter.corner0.xyz, emitter.corner2.xyz - emitter.corner0.xyz) *
                         ((instance.flags & kMirrored) != 0u ? -1.0 : 1.0);
  const float size = length(twiceArea);
  const vec3 normal = size > 0.0 ? twiceArea / size : vec3(0.0);
  const float density = emitterDensity(emitter);

  const vec3 offset = position - surface.position;
  const float distance2 = dot(offset, offset);
  if (!(distance2 > 0.0) || !(density > 0.0)) return kNothing;
  const vec3 direction = offset / sqrt(distance2);
  const float cosine = lightCosine(surface, direction);
  const float signedCosineAtLight = -dot(normal, direction);
  const float cosineAtLight = (material.flags & kDoubleSided) != 0u ? abs(signedCosineAtLight) : signedCosineAtLight;
  if (cosine <= 0.0 || cosineAtLight <= 0.0 || isHole(instance.mesh, emitter.triangle, weights)) return kNothing;
  const float solidAngleDensity = density * distance2 / cosineAtLight;
  // The ray ends slightly before the light, so that it does not hit the light itself.
  const float kBeforeTheEnd = 1.0 - 1e-4;
  return Candidate(emittedRadiance(material, mesh, cornersOf(mesh, emitter.triangle), weights) *
                       (value(surface, direction) * (cosine / kPi) / (solidAngleDensity + pathDensity(surface, direction))),
                   position - rayOrigin(surface), kBeforeTheEnd);
}

Candidate fromSky(Surface surface, vec2 random) {
  const vec3 direction = sampleSky(random);
  const float ofSky = skyDensity(direction);
  const float cosine = lightCosine(surface, direction);
  if (cosine <= 0.0 || !(ofSky > 0.0)) return kNothing;
  return Candidate(
      skyRadiance(direction) * (value(surface, direction) * (cosine / kPi) / (ofSky + pathDensity(surface, direction))), direction,
      kEndless);
}

// Number of candidates at a vertex: the sky, an emitter, and every punctual light at the first vertex, one of them later.
uint candidates(bool first) { return 2u + (first ? trace.punctualLights : min(trace.punctualLights, 1u)); }

Candidate candidate(Surface surface, bool first, uint number, inout Random random) {
  if (number == 0u) return skyIsSampled() ? fromSky(surface, next2D(random)) : kNothing;
  if (number == 1u) {
    if (trace.emitters == 0u) return kNothing;
    const float choice = next1D(random);
    return fromEmitter(surface, choice, next2D(random));
  }
  const bool choose = !first && trace.punctualLights > 1u;
  const float count = choose ? float(trace.punctualLights) : 1.0;
  const uint index = choose ? min(uint(next1D(random) * count), trace.punctualLights - 1u) : number - 2u;
  Candidate light = fromPunctual(surface, index);
  light.light *= count;
  return light;
}

// Weight of the path's direction for an emissive triangle that it hit (balance heuristic).
float weightOfHit(Surface from, vec3 direction, Hit hit, Surface light) {
  const uint first = instances[hit.instance].firstEmitter;
  const float ofEmitter = first == kAbsent ? 0.0 : emitterDensity(emitters[first + hit.triangle]);
  const vec3 offset = light.position - from.position;
  const float cosineAtLight = abs(dot(light.geometricNormal, direction));
  const float ofPath = pathDensity(from, direction) * cosineAtLight;
  const float sum = ofEmitter * dot(offset, offset) + ofPath;
  return sum > 0.0 ? ofPath / sum : 0.0;
}

// The same for the sky.
float weightOfSky(Surface from, vec3 direction) {
  if (!skyIsSampled()) return 1.0;
  const float ofPath = pathDensity(from, direction);
  return ofPath / (ofPath + skyDensity(direction));
}
