// One frame of the path tracer: the G-buffer by primary rays, and the light of `TraceConstants::samples` paths per pixel. It
// computes what `render::renderFilm` and `render::renderReference` (samples/render/) compute on the processor.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_ray_query : require
#include "samples/gpu_render/shaders/scene_data.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform accelerationStructureEXT scene;
layout(set = 0, binding = 1, std140) uniform Trace { TraceConstants trace; };
layout(set = 0, binding = 2, std430) readonly buffer Floats { float floats[]; };
layout(set = 0, binding = 3, std430) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 4, std430) readonly buffer Meshes { MeshData meshes[]; };
layout(set = 0, binding = 5, std430) readonly buffer Materials { MaterialData materials[]; };
layout(set = 0, binding = 6, std430) readonly buffer Textures { TextureData textures[]; };
layout(set = 0, binding = 7, std430) readonly buffer Texels { uint texels[]; };
// The values of bytes: sRGB-encoded ones, then linear ones.
layout(set = 0, binding = 8, std430) readonly buffer ByteValues { float byteValues[]; };
layout(set = 0, binding = 9, std430) readonly buffer StillInstances { uint stillInstances[]; };
layout(set = 0, binding = 10, std430) readonly buffer Sky { float sky[]; };
layout(set = 0, binding = 11, std430) readonly buffer Instances { InstanceData instances[]; };
layout(set = 0, binding = 12, std430) readonly buffer PunctualLights { PunctualLightData punctualLights[]; };
layout(set = 0, binding = 13, std430) readonly buffer Emitters { EmitterData emitters[]; };
// Means over the paths. Alpha of the direct light: number of paths; of the indirect light: number of rays.
layout(set = 0, binding = 14, COLOR) uniform writeonly image2D outDirect;
layout(set = 0, binding = 15, COLOR) uniform writeonly image2D outIndirect;
layout(set = 0, binding = 16, COLOR) uniform writeonly image2D outNormal;
layout(set = 0, binding = 17, COLOR) uniform writeonly image2D outAlbedo;
layout(set = 0, binding = 18, COLOR) uniform writeonly image2D outEmission;
layout(set = 0, binding = 19, COLOR) uniform writeonly image2D outMotion;
layout(set = 0, binding = 20, r32f) uniform writeonly image2D outDepth;
layout(set = 0, binding = 21, r32ui) uniform writeonly uimage2D outObjectId;
#ifdef SPECULAR
// Light of the specular lobe, divided by its albedo; alpha: mean inverse distance of the first hits.
layout(set = 0, binding = 22, COLOR) uniform writeonly image2D outSpecular;
// Albedo of the specular lobe; alpha: number of its paths. The alpha of the normal then holds roughness.
layout(set = 0, binding = 23, COLOR) uniform writeonly image2D outSpecularAlbedo;
// See `render::SpecularPixel::motion`.
layout(set = 0, binding = 24, COLOR) uniform writeonly image2D outSpecularMotion;
#endif

const uint kSrgbTable = 0u;
const uint kLinearTable = 256u;

#include "accurate.glsl"
#include "random.glsl"
#include "textures.glsl"
#include "surface.glsl"
#include "rays.glsl"
#include "sky.glsl"
#include "path.glsl"

const float kBackgroundDepth = 1e10;  // Of samples/sequence/frame.h.

vec3 primaryDirection(ivec2 p, vec2 jitter) {
  return primaryDirection(vec2(p), jitter, vec2(trace.size), trace.projection, trace.worldFromView);
}

// Image motion of a point whose position in the previous view space is `previous`; see samples/render/gbuffer.cpp.
vec2 imageMotion(ivec2 p, vec3 previous) {
  const vec2 outside = 2.0 * vec2(trace.size);
  if (!(previous.z < 0.0)) return outside;
  const vec4 clip = trace.projection * vec4(previous, 1.0);
  const vec2 projected = vec2(0.5 + 0.5 * clip.x / clip.w, 0.5 - 0.5 * clip.y / clip.w) * vec2(trace.size);
  return clamp(projected - trace.previousJitter - (vec2(p) + 0.5), -outside, outside);
}

// Beyond the range of half floats values saturate.
vec4 representable(vec4 value) {
#ifdef HALF
  return clamp(value, vec4(-65504.0), vec4(65504.0));
#else
  return value;
#endif
}

// The virtual image of what mirrors in between show, see samples/render/gbuffer.cpp.
#ifdef SPECULAR
mat4 imageFromWorld = mat4(1.0);
vec3 tint = vec3(1.0);
vec3 mirrorEmission = vec3(0.0);  // Radiance that the mirrors emit themselves.
#define VIRTUAL(matrix) ((matrix) * imageFromWorld)
#define TINTED(light) ((light) * tint)
#define EMITTED(light) (mirrorEmission + (light) * tint)
#else
#define VIRTUAL(matrix) (matrix)
#define TINTED(light) (light)
#define EMITTED(light) (light)
#endif

void writeSurface(ivec2 p, Surface surface, uint objectId) {
  const vec3 position = vec3(VIRTUAL(trace.viewFromWorld) * vec4(surface.position, 1.0));
  const vec3 previous = vec3(VIRTUAL(trace.previousViewFromWorld) * vec4(surface.previousPosition, 1.0));
#ifdef SPECULAR
  const float roughness = surface.roughness;
#else
  const float roughness = 0.0;
#endif
  imageStore(outNormal, p, representable(vec4(mat3(VIRTUAL(trace.viewFromWorld)) * surface.shadingNormal, roughness)));
  imageStore(outAlbedo, p, representable(vec4(TINTED(surface.albedo), 0.0)));
  imageStore(outEmission, p, representable(vec4(EMITTED(surface.emission), 0.0)));
  imageStore(outMotion, p, representable(vec4(imageMotion(p, previous), position.z - previous.z, 0.0)));
  imageStore(outDepth, p, vec4(-position.z));
  imageStore(outObjectId, p, uvec4(objectId));
}

void writeSky(ivec2 p, vec3 direction, vec3 radiance) {
  const vec3 previousDirection = mat3(VIRTUAL(trace.previousViewFromWorld)) * direction;
  imageStore(outNormal, p, vec4(0.0));
  imageStore(outAlbedo, p, vec4(0.0));
  imageStore(outEmission, p, representable(vec4(EMITTED(radiance), 0.0)));
  imageStore(outMotion, p, representable(vec4(imageMotion(p, previousDirection), 0.0, 0.0)));
  imageStore(outDepth, p, vec4(kBackgroundDepth));
  imageStore(outObjectId, p, uvec4(kAbsent));
}

// Whether the pixel has a sample of indirect light, by the light's pattern. If it has, its random numbers are those of the
// texel of the pattern.
bool takesIndirect(ivec2 p, out uint seedPixel) {
  const ivec2 group = ivec2(trace.lightGroup);
  const ivec2 texel = p / group;
  ivec2 offset = trace.lightOffset;
  if (group.y == 1) offset.x = (offset.x + texel.y) % group.x;
  const bool sampled = texel * group + offset == p;
  const uvec2 seed = uvec2(sampled ? texel : p);
  seedPixel = (seed.y << 16) | seed.x;
  return sampled;
}

// See `covered` in samples/render/reference.cpp.
bool covered(uvec2 p) {
  const uint kSide = 64u;
  return (p.x / kSide + trace.squareShift * (p.y / kSide)) % trace.oneSquareIn == 0u;
}

// What a ray is traced for.
const uint kGBuffer = 0u;       // The primary ray of the G-buffer.
const uint kFirstSurface = 1u;  // The primary ray of a sample, if samples are spread over the pixel.
const uint kShadow = 2u;        // Whether light arrives.
const uint kContinue = 3u;      // Where the path continues.

// All rays of a pixel, one after the other: the primary ray, and for each path the rays to lights and the ray to the next
// vertex in turn.
void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, ivec2(trace.size)))) return;
  uint seedPixel;
  const bool sampled = takesIndirect(p, seedPixel);
  const uint bounces = sampled ? trace.bounces : 0u;
  const bool wholePixel = (trace.flags & kWholePixel) != 0u;
  const uint samples = covered(uvec2(p)) ? trace.samples : 0u;

  vec3 direct = vec3(0.0);
  vec3 indirect = vec3(0.0);
  uint paths = 0u;
  uint rays = 0u;
#ifdef SPECULAR
  vec3 specular = vec3(0.0);
  float inverseDistance = 0.0;
  vec3 specularMotion = vec3(0.0);
  uint specularPaths = 0u;
  vec3 firstAlbedo = vec3(0.0);  // Of the specular lobe of `first`.
  vec3 shownAlbedo = vec3(0.0);  // The same of the G-buffer.
  bool ofSpecular = false;       // The path is one of the specular lobe.
  bool due = false;              // The sample's path of the specular lobe is not yet traced.
  int mirrors = 0;               // Between the camera and the path's first vertex.
#endif

  Ray ray = Ray(trace.worldFromView[3].xyz, primaryDirection(p, trace.jitter), kEndless, false);
  uint purpose = kGBuffer;
  Surface first;    // That the pixel shows.
  Surface surface;  // The path's last vertex.
  uint started = 0u;  // Paths.
  uint bounce = 0u;
  uint light = 0u;  // Candidates taken at this vertex.
  vec3 throughput = vec3(0.0);
  vec3 pending = vec3(0.0);  // Arrives unless the ray is blocked.
  Random random;
  for (;;) {
    Hit hit;
    const bool met = castRay(ray, hit);
    // Of references, only the rays of samples count.
    rays += purpose == kGBuffer && (wholePixel || samples == 0u) ? 0u : 1u;
    bool ended = false;
    if (purpose == kShadow) {
      if (!met) {
#ifdef SPECULAR
        if (ofSpecular) {
          specular += pending;
        } else
#endif
        if (bounce == 0u) {
          direct += pending;
        } else {
          indirect += pending;
        }
      }
    } else {
      Surface next;
      vec3 found;
      if (met) {
        next = evaluateSurface(hit, ray);
        found = next.emission;
      } else {
        found = skyRadiance(ray.direction);
      }
      if (purpose == kContinue) {
        if (found != vec3(0.0)) {
          const vec3 direction = ray.direction;
          found *= throughput * (met ? weightOfHit(surface, direction, hit, next) : weightOfSky(surface, direction));
        }
#ifdef SPECULAR
        if (ofSpecular) {
          if (met && bounce == 0u) {
            inverseDistance += 1.0 / distance(next.position, surface.position);
            specularMotion += next.previousPosition - next.position;
          }
          specular += found;
        } else
#endif
        if (bounce == 0u) {
          direct += found;
        } else {
          indirect += found;
        }
        ended = !met;
        if (met) {
#ifdef SPECULAR
          next = laterVertex(next);
#else
          throughput *= next.albedo;
#endif
          ended = bounce == bounces || throughput == vec3(0.0);
          surface = next;
          ++bounce;
        }
      } else {
#ifdef SPECULAR
        if (met && (trace.flags & kBehindMirrors) != 0u && isMirror(next.metallic, next.roughness) && mirrors < kMostMirrors) {
          const vec3 direction = mirrorDirection(next.shadingNormal, next.towardsViewer);
          const float away = grazing(dot(next.shadingNormal, next.towardsViewer));
          mirrorEmission += found * tint;
          tint *= dot(next.geometricNormal, direction) > 0.0 ? mix(next.reflectance, vec3(1.0), away) : vec3(0.0);
          imageFromWorld = imageFromWorld * reflectionAt(next.shadingNormal, next.position);
          ray = Ray(rayOrigin(next), direction, kEndless, false);
          ++mirrors;
          continue;
        }
        mirrors = 0;
#endif
        if (purpose == kGBuffer) {
          if (met) {
            writeSurface(p, next, hit.instance);
          } else {
            writeSky(p, ray.direction, found);
          }
        }
        const bool lit = met && next.albedo != vec3(0.0);
#ifdef SPECULAR
        if (purpose == kGBuffer && !wholePixel && !met) break;
        due = met && purpose == kFirstSurface && sampled;
        ofSpecular = false;
        if (met) firstAlbedo = specularAlbedo(next);
        if (purpose == kGBuffer) shownAlbedo = TINTED(firstAlbedo);
        next = firstVertex(next, false);
#else
        if (purpose == kGBuffer && !wholePixel && !lit) break;
#endif
        first = next;
        surface = next;
        ended = !lit || purpose == kGBuffer;  // The samples start below.
        if (purpose == kFirstSurface && lit) ++paths;
      }
      light = 0u;
    }

    // The next ray: to a light, or to the next vertex, or the first of the next path.
    bool more = false;
    while (!more) {
      if (ended) {
#ifdef SPECULAR
        if (due) {
          due = false;
          ofSpecular = true;
          random = makeRandom(trace.seed ^ kSpecularSeed, seedPixel, trace.firstSample + started - 1u);
          surface = firstVertex(first, true);
          bounce = 0u;
          light = 0u;
          throughput = vec3(1.0) / firstAlbedo;
          ended = false;
          ++specularPaths;
          continue;
        }
        ofSpecular = false;
#endif
        if (started == samples) break;
        random = makeRandom(trace.seed, seedPixel, trace.firstSample + started);
        ++started;
        bounce = 0u;
        light = 0u;
        throughput = vec3(1.0);
        ended = false;
        if (wholePixel) {
          ray = Ray(trace.worldFromView[3].xyz, primaryDirection(p, next2D(random) - 0.5), kEndless, false);
          purpose = kFirstSurface;
          more = true;
        } else {
          surface = first;
#ifdef SPECULAR
          due = sampled;
          ended = first.albedo == vec3(0.0);
          paths += ended ? 0u : 1u;
#else
          ++paths;
#endif
        }
      } else if (light < candidates(bounce == 0u)) {
        const Candidate arriving = candidate(surface, bounce == 0u, light, random);
        ++light;
        pending = throughput * arriving.light;
        if (arriving.light != vec3(0.0)) {
          ray = Ray(rayOrigin(surface), arriving.direction, arriving.reach, true);
          purpose = kShadow;
          more = true;
        }
      } else {
        const vec3 direction = sampleDirection(surface, random);
        const float cosine = lightCosine(surface, direction);
        if (cosine <= 0.0) {
          ended = true;
        } else {
          throughput *= value(surface, direction);
#ifdef SPECULAR
          throughput *= cosine / kPi / pathDensity(surface, direction);
#endif
          ray = Ray(rayOrigin(surface), direction, kEndless, false);
          purpose = kContinue;
          more = true;
        }
      }
    }
    if (!more) break;
  }

  const float share = 1.0 / float(max(paths, 1u));
  direct *= share;
  indirect *= sampled ? share : 0.0;
  if ((trace.flags & kDirectInIndirect) != 0u) {
    indirect += direct;
    direct = vec3(0.0);
  }
#ifdef SPECULAR
  const float shareOfSpecular = 1.0 / float(max(specularPaths, 1u));
  imageStore(outSpecular, p, representable(vec4(specular, inverseDistance) * shareOfSpecular));
  imageStore(outSpecularAlbedo, p, vec4(shownAlbedo, float(specularPaths)));
  imageStore(outSpecularMotion, p, vec4(mat3(imageFromWorld) * specularMotion * shareOfSpecular, 0.0));
#endif
  imageStore(outDirect, p, representable(vec4(direct, float(paths))));
  imageStore(outIndirect, p, representable(vec4(indirect, float(rays))));
}
