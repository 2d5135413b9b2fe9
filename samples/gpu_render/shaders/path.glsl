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

float grazing(vec3 normal, vec3 direction) {
  const float x = 1.0 - clamp(dot(normal, direction), 0.0, 1.0);
  return x * x * x * x * x;
}

float lobe(Surface surface, vec3 towardsLight) {
  if ((trace.flags & kDisneyDiffuse) == 0u) return 1.0;
  const float light = grazing(surface.shadingNormal, towardsLight);
  const float view = grazing(surface.shadingNormal, surface.towardsViewer);
  const float cosine = dot(towardsLight, normalize(towardsLight + surface.towardsViewer));
  const float retro = 2.0 * surface.roughness * cosine * cosine;
  return (1.0 - 0.5 * light) * (1.0 - 0.5 * view) + retro * (light + view + light * view * (retro - 1.0));
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
  result.light *= lobe(surface, result.direction) * lightCosine(surface, result.direction) / kPi;
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
  const float cosineDensity = cosine / kPi;
  // The ray ends slightly before the light, so that it does not hit the light itself.
  const float kBeforeTheEnd = 1.0 - 1e-4;
  return Candidate(emittedRadiance(material, mesh, cornersOf(mesh, emitter.triangle), weights) *
                       (lobe(surface, direction) * cosineDensity / (solidAngleDensity + cosineDensity)),
                   position - rayOrigin(surface), kBeforeTheEnd);
}

Candidate fromSky(Surface surface, vec2 random) {
  const vec3 direction = sampleSky(random);
  const float density = skyDensity(direction);
  const float cosine = lightCosine(surface, direction);
  if (cosine <= 0.0 || !(density > 0.0)) return kNothing;
  const float cosineDensity = cosine / kPi;
  return Candidate(skyRadiance(direction) * (lobe(surface, direction) * cosineDensity / (density + cosineDensity)), direction,
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

// Weight of cosine sampling for an emissive triangle that it hit (balance heuristic).
float cosineWeight(Surface from, vec3 direction, Hit hit, Surface light) {
  const uint first = instances[hit.instance].firstEmitter;
  const float density = first == kAbsent ? 0.0 : emitterDensity(emitters[first + hit.triangle]);
  const vec3 offset = light.position - from.position;
  const float cosineAtLight = abs(dot(light.geometricNormal, direction));
  const float cosineDensity = dot(from.shadingNormal, direction) / kPi;
  const float sum = density * dot(offset, offset) + cosineDensity * cosineAtLight;
  return sum > 0.0 ? cosineDensity * cosineAtLight / sum : 0.0;
}

// The same for the sky.
float cosineWeightOfSky(Surface from, vec3 direction) {
  if (!skyIsSampled()) return 1.0;
  const float cosineDensity = dot(from.shadingNormal, direction) / kPi;
  return cosineDensity / (cosineDensity + skyDensity(direction));
}
