// How much of the residual is added to the prediction (passes/WALR.md, 9). The residual is the accumulated light
// less the prediction p: noise, and where the fits are wrong also light that no feature explains. To tell them apart,
// this frame's light y and the history h are compared. Their noise is independent: where y - p and h - p are noise
// alone, their product is 0 in the mean.
// The residual is split into two levels: its mean over the pixels around on the same surface, and the difference of the
// pixel's own residual from that mean. Each level has its own share. So have pixels beside an edge, where the fits miss
// most.
// In resampled light (ReSTIR) the noise of y depends on that of h, and their product is not 0. The noise of different
// pixels is still independent. Trust, 0 to 1, multiplies the shares; it falls if residuals two pixels apart do not agree.
// Most workgroups of light of one sample have no share. They do nothing in most frames (partOfWorkgroup).
// Needs: `frame` (FrameConstants), `constants` (BlockRegressionConstants), kBlockSize, workgroups of 8 x 8, and
// stored_fit.glsl.
#ifndef WALR_ACCUMULATED_SHARE_GLSL
#define WALR_ACCUMULATED_SHARE_GLSL
#include "temporal/antilag.glsl"
#include "regression/best_share.glsl"
#include "conventions/camera.glsl"
#include "common/cube_roots.glsl"
#include "common/finite.glsl"
#include "regression/innovation.glsl"
#include "common/luminance.glsl"
#include "conventions/packed_light.glsl"
#include "regression/quiet_tiles.glsl"
#include "regression/reconstruction_tile.glsl"

float depthAtMiddle(ivec2 p) {
  return unpackDepthBesideNormal(texelFetch(depth, min(p, textureSize(depth, 0) - 1), 0).x);
}
#include "regression/tile_before.glsl"

layout(constant_id = 3) const bool kPackedMean = true;  // The accumulated light is packed.
layout(constant_id = 4) const bool kAntilag = false;    // It is shortened by the antilag factor of its own frame.
uniform utexture2D accumulatedPacked;
uniform texture2D accumulatedHalf;
uniform texture2D lighting;
uniform sampler2D antilag;
uniform texture2D previousStatistics;  // residual_statistics.comp; cube roots.
uniform sampler2D previousAgreement;   // Blue: trust; alpha: tileState.
layout(rgba32f) uniform writeonly image2D outResidualSums;    // Right half: of pixels beside an edge.
layout(rgba32f) uniform writeonly image2D outInnovationSums;  // xy: innovationTerms; zw: farProduct.

// Whether the tile of this workgroup lay among tiles in the last frame that are all quiet. The same for all threads.
bool isAmongQuiet() {
  const vec2 before = tileBefore(ivec2(gl_WorkGroupID.xy), kTilePixels, kTileStart);
  const vec2 tiles = vec2(textureSize(previousAgreement, 0));
  if (any(lessThan(before, vec2(0.0))) || any(greaterThanEqual(before, tiles))) return false;
  const float least = 0.75;  // Share of the tile that lay on quiet ones.
  const vec2 base = floor(before - 0.5);
  const vec4 quiet = quietness(textureGather(previousAgreement, (base + 1.0) / tiles, 3));
  return bilinear(quiet, before - 0.5 - base) >= least;
}


// What a workgroup does beside the prediction.
const int kNothing = 0;
const int kMeasures = 1;  // Adds shares to its pixels, and measures them.
const int kSteers = 2;    // Measures innovations, too.
int partOfWorkgroup() {
  if (!isAmongQuiet()) return kSteers;
  if (!isMeasuredThoughQuiet(gl_WorkGroupID.xy, frame.frameIndex)) return kNothing;
  return haveQuietInnovations(frame.frameIndex) ? kSteers : kMeasures;
}

vec4 accumulatedAt(ivec2 p) {
  return kPackedMean ? unpackAccumulated(texelFetch(accumulatedPacked, p, 0).x) : texelFetch(accumulatedHalf, p, 0);
}

// Sums over pixels. xy: of the mean around a pixel; zw: of the difference of the pixel's own residual from it. x and z:
// (y - p) (h - p), in the mean the square of what the fits miss; y and w: square of the noise of one sample.
struct Statistics {
  vec4 sums;
  float trust;
};

// `before`: the position in the previous camera's view space. Statistics of an image of another size are not read.
Statistics previousStatisticsAt(vec3 before, bool edge) {
  if (before.z >= 0.0 || frame.previousPixelFromPixel != vec2(1.0)) return Statistics(vec4(0.0), 0.0);
  const vec2 pixel = nearPixelOf(frame.previousRayFromPixel, before);
  const vec2 tile = (pixel + float(kTileStart)) / float(kTilePixels) - 0.5;
  const ivec2 last = textureSize(previousAgreement, 0) - 1;
  const ivec2 ofClass = ivec2(edge ? last.x + 1 : 0, 0);
  const vec2 base = clamp(floor(tile), vec2(-1.0), vec2(last)), f = tile - floor(tile);
  const vec4 trust = textureGather(previousAgreement, (base + 1.0) / vec2(last + 1), 2).wzxy;
  Statistics found = Statistics(vec4(0.0), 0.0);
  [[unroll]] for (int i = 0; i < 4; ++i) {
    const ivec2 corner = ivec2(i & 1, i >> 1);
    const ivec2 q = clamp(ivec2(base) + corner, ivec2(0), last) + ofClass;
    const vec2 weights = mix(1.0 - f, f, vec2(corner));
    const float weight = weights.x * weights.y;
    found.sums += weight * texelFetch(previousStatistics, q, 0);
    found.trust += weight * trust[i];
  }
  found.sums = cubes(found.sums);  // Cubed after interpolation, which takes fewer instructions.
  return found;
}

// The share of a residual that is a mean of `samples` samples. The statistics have errors of their own, so that a small
// share is none.
float accumulatedShare(vec2 statistics, float samples, float trust, float gain) {
  const float share = bestShare(statistics, samples, trust, gain);
  return clamp((share - constants.residualLeastShare) / (1.0 - constants.residualLeastShare), 0.0, 1.0);
}

// The residuals of a pixel, or their means over pixels.
struct Residual {
  vec3 mean;      // m - p, where m = h + (y - h) / N.
  float noisy;    // Luminance of y - p.
  float history;  // Luminance of h - p.
  float samples;  // N; its negative where there is no finite y or no h. The luminances are 0 then.
};

// `mean`: rgb: m; alpha: N. `light`: y if `hasLight`.
Residual residualOf(vec4 mean, vec3 light, bool hasLight, vec3 predicted) {
  const float fewest = 1.5;  // Below, rounding of N leaves nothing of h.
  const vec3 residual = mean.rgb - predicted;
  if (mean.a < fewest || !hasLight) return Residual(residual, 0.0, 0.0, -mean.a);
  const float y = luminance(light - predicted);
  const float h = (mean.a * luminance(residual) - y) / (mean.a - 1.0);
  return Residual(residual, y, h, mean.a);
}

// What a pixel shows; 0 without a surface.
struct Shown {
  bool surface;
  vec3 position;
  vec3 normal;
  vec3 predicted;  // p: the light that the fits predict.
};

const int kGroupThreads = kGroupSize * kGroupSize;
// First the residuals, three values of each thread; later what is summed, four of each.
shared vec4 groupValues[4 * kGroupThreads];
const int kGroupResiduals = 0;               // rgb: mean; a: noisy.
const int kGroupNormals = kGroupThreads;     // rgb: 0 without a surface; a: samples.
const int kGroupDepths = 2 * kGroupThreads;  // r: depth; g: history.

void shareResidual(Shown shown, Residual residual) {
  const int thread = int(gl_LocalInvocationIndex);
  groupValues[kGroupResiduals + thread] = vec4(residual.mean, residual.noisy);
  groupValues[kGroupNormals + thread] = vec4(shown.normal, residual.samples);
  groupValues[kGroupDepths + thread].xy = vec2(-shown.position.z, residual.history);
  barrier();
}

// The sums over the workgroup of four values of each thread, for the thread 0. All threads must call it. A quarter of the
// threads works on each value, and each of three rounds leaves a quarter of the sums. They lie in the memory of the
// residuals.
mat4 sumsOverGroup(mat4 values) {
  const int thread = int(gl_LocalInvocationIndex);
  barrier();  // The residuals have been read.
  [[unroll]] for (int i = 0; i < 4; ++i) groupValues[i * kGroupThreads + thread] = values[i];
  [[unroll]] for (int round = 0; round < 3; ++round) {
    const int n = kGroupThreads >> (2 * round + 2);
    barrier();
    const int i = thread / n * kGroupThreads + thread % n;
    if (thread < 4 * n) {
      groupValues[i] = (groupValues[i] + groupValues[i + 2 * n]) + (groupValues[i + n] + groupValues[i + 3 * n]);
    }
  }
  barrier();
  return mat4(groupValues[0], groupValues[kGroupThreads], groupValues[2 * kGroupThreads],
              groupValues[3 * kGroupThreads]);
}

// Tells how far other pixels show the surface of a pixel: the edge-stopping function of the plane through the pixel, and
// agreement of the shading normals, which ends at an angle of 37 degrees. 0 if there is none.
struct SameSurface {
  // Distance from the plane, scaled for the edge-stopping function: depth x product - offset. The product of the normal
  // and the view ray is linear over the image.
  float product;  // At the pixel.
  vec2 slope;     // Of the product, from a pixel to the next along each axis.
  float offset;
  vec3 facing;  // 5 times the normal.
};

SameSurface sameSurfaceAs(Shown shown) {
  const float perDepth = 1.0 / -shown.position.z;
  const vec3 scaled = shown.normal * (constants.planeScale * perDepth);
  const float offset = dot(scaled, shown.position);
  return SameSurface(offset * perDepth, scaled.xy * frame.rayFromPixel.xy, offset, 5.0 * shown.normal);
}

// `away`: offset of the pixel of `thread` from the one that `s` belongs to.
float sameSurface(SameSurface s, ivec2 away, int thread) {
  const float product = s.product + dot(s.slope, vec2(away));
  const float distance = abs(groupValues[kGroupDepths + thread].x * product - s.offset);
  return clamp(constants.planeOffset - distance, 0.0, 1.0) *
         clamp(dot(s.facing, groupValues[kGroupNormals + thread].xyz) - 4.0, 0.0, 1.0);
}

// Mean residual over the 3 x 3 pixels, as far as this workgroup has them. `halves`: leave out pixels without y or h, as
// statistics need; where a surface has just appeared, most pixels have no h. `edge`: whether one of the pixels shows
// another surface or none. `quad`: the innovations of those in the quad whose first pixel is `p`, that of this thread.
Residual meanAround(ivec2 p, SameSurface surface, bool halves, out bool edge, out Quad quad) {
  const ivec2 thread = ivec2(gl_LocalInvocationID.xy);
  const bvec2 first = lessThanEqual(min(thread, p), ivec2(0));
  const bvec2 last = greaterThanEqual(max(thread - kTilePixels, p - textureSize(depth, 0)), ivec2(-1));
  const bool columns[3] = bool[](!first.x, true, !last.x), rows[3] = bool[](!first.y, true, !last.y);
  const float ofMissing = halves ? 0.0 : -1.0;
  Residual sum = Residual(vec3(0.0), 0.0, 0.0, 0.0);
  float weights = 0.0, least = 1.0;
  quad = Quad(0.0, 0.0, 0.0);
  [[unroll]] for (int i = 0; i < 9; ++i) {
    const ivec2 away = ivec2(i % 3, i / 3) - 1;
    const bool inside = columns[i % 3] && rows[i / 3];
    const ivec2 t = clamp(thread + away, ivec2(0), ivec2(kGroupSize - 1));
    const int q = t.y * kGroupSize + t.x;
    const float same = i == 4 ? 1.0 : sameSurface(surface, away, q);
    const float stored = groupValues[kGroupNormals + q].a, samples = max(stored, ofMissing * stored);
    least = min(least, inside ? same : 1.0);
    const float weight = inside ? same * samples : 0.0;
    sum.mean += weight * groupValues[kGroupResiduals + q].rgb;
    sum.noisy += weight * groupValues[kGroupResiduals + q].a;
    sum.history += weight * groupValues[kGroupDepths + q].y;
    sum.samples += weight * samples;
    weights += weight;
    if (i % 3 > 0 && i > 3) {
      const float innovation = groupValues[kGroupResiduals + q].a - groupValues[kGroupDepths + q].y;
      add(quad, inside && stored > 0.0 ? same : 0.0, innovation);
    }
  }
  edge = least < 0.5;
  const float scale = weights > 0.0 ? 1.0 / weights : 0.0;
  return Residual(scale * sum.mean, scale * sum.noisy, scale * sum.history, scale * sum.samples);
}

// Product of this frame's residual at a pixel and the history's at the pixel two further along axis `axis`, or two
// before it at the end of the group, and 1; 0 if that shows another surface. It is free of the noise that y and h of
// one pixel share.
vec2 farProduct(SameSurface surface, Residual own, int axis) {
  const ivec2 thread = ivec2(gl_LocalInvocationID.xy);
  ivec2 away = ivec2(0);
  away[axis] = thread[axis] + 2 < kTilePixels ? 2 : -2;
  const int q = (thread.y + away.y) * kGroupSize + thread.x + away.x;
  if (sameSurface(surface, away, q) < 0.5) return vec2(0.0);
  const float noisy = groupValues[kGroupResiduals + q].a, history = groupValues[kGroupDepths + q].y;
  return vec2(0.5 * (own.noisy * history + own.history * noisy), 1.0);
}

// What a residual adds to the sums of its level (previousStatisticsAt).
vec2 statisticsOf(float noisy, float history, float mean, float samples) {
  const float missed = noisy * history;
  return vec2(missed, samples * (mean * mean - missed));
}

const float kLeastLight = 1e-12;  // Far below what halves can hold: squares of its inverse are finite,
const float kMostSquare = 1e30;   // and so are sums over tiles of these.

// What a pixel adds to the statistics of its workgroup.
struct Measured {
  vec2 light;       // Predicted luminance and 1; 0 for a pixel that adds nothing.
  vec4 statistics;  // statisticsOf the mean around the pixel, and of the difference from it.
  bool edge;        // The pixel lies beside one.
  vec2 innovation;  // innovationTerms.
  vec4 far;         // farProduct along both axes.
};

// Writes what this workgroup adds to the statistics, relative to its mean light. The variance of traced light is about
// proportional to the light, so that no workgroup outweighs its neighbours.
void storeSums(Measured pixel) {
  const vec4 none = vec4(0.0), interiorOnly = pixel.edge ? none : pixel.statistics;
  const vec4 edgeOnly = pixel.edge ? pixel.statistics : none;
  const mat4 sums = sumsOverGroup(mat4(vec4(pixel.light, pixel.innovation), interiorOnly, edgeOnly, pixel.far));
  if (gl_LocalInvocationIndex != 0u) return;
  const vec4 first = sums[0], interior = sums[1], edges = sums[2], distant = sums[3];
  const float scale = first.x > kLeastLight ? first.y / first.x : 0.0;
  const vec4 most = vec4(kMostSquare);
  const ivec2 tile = ivec2(gl_WorkGroupID.xy);
  imageStore(outResidualSums, tile, clamp(scale * interior, -most, most));
  const ivec2 rightHalf = ivec2(imageSize(outResidualSums).x / 2, 0);
  imageStore(outResidualSums, tile + rightHalf, clamp(scale * edges, -most, most));
  // Products two pixels apart stand for those that are missing beside edges, up to a limit.
  const vec2 perProduct = min(first.y / max(distant.yw, vec2(1.0)), vec2(4.0));
  const vec4 others = vec4(first.zw, perProduct * distant.xz);
  imageStore(outInnovationSums, tile, clamp(scale * others, -most, most));
}

// What a workgroup that takes no part leaves to later frames: nothing.
void storeNoSums(ivec2 p, bool hasPixel) {
  if (hasPixel && isFirstOfQuad(p)) storeInnovation(p, 0.0);
  if (gl_LocalInvocationIndex != 0u) return;
  const ivec2 tile = ivec2(gl_WorkGroupID.xy);
  imageStore(outResidualSums, tile, vec4(0.0));
  imageStore(outResidualSums, tile + ivec2(imageSize(outResidualSums).x / 2, 0), vec4(0.0));
  imageStore(outInnovationSums, tile, vec4(0.0));
}

// The light of a pixel.
struct FetchedLight {
  vec4 mean;
  vec3 noisy;
  TileLimits limits;
};

FetchedLight fetchLight(ivec2 p) {
  const TileLimits limits = kAntilag ? tileLimitsAt(antilag, vec2(p)) : kNoTileLimits;
  return FetchedLight(accumulatedAt(p), texelFetch(lighting, p, 0).rgb, limits);
}

// The accumulated light of a pixel after the antilag of this frame, and its residual.
struct Accumulated {
  vec4 mean;  // a: history length, 0 without a surface.
  Residual residual;
};

Accumulated accumulatedWithAntilag(FetchedLight fetched, Shown shown) {
  Accumulated found = Accumulated(shown.surface ? fetched.mean : vec4(0.0), Residual(vec3(0.0), 0.0, 0.0, 0.0));
  if (!(found.mean.a > 0.0)) return found;
  const bool hasLight = isFinite(fetched.noisy);
  const vec3 light =
      hasLight ? withoutFirefly(clampedRadiance(fetched.noisy), fetched.limits.brightest) : vec3(0.0);
  if (kAntilag) {
    const float longest = longestHistory(fetched.limits.factor, constants.maxHistory);
    found.mean = withLongestHistory(found.mean, light, hasLight ? 1.0 : 0.0, longestHistoryOf(hasLight, longest));
  }
  found.residual = residualOf(found.mean, light, hasLight, shown.predicted);
  return found;
}

// The prediction of a pixel mixed with its accumulated light. All threads of the workgroup must call it.
vec3 withAccumulated(ivec2 p, bool hasPixel, FetchedLight fetched, Shown shown, bool steers) {
  const Accumulated accumulated = accumulatedWithAntilag(fetched, shown);
  const Residual own = accumulated.residual;
  shareResidual(shown, own);

  vec3 result = shown.predicted;
  Measured measured = Measured(vec2(0.0), vec4(0.0), false, vec2(0.0), vec4(0.0));
  float innovation = 0.0;
  if (accumulated.mean.a > 0.0) {
    const vec3 before = previousPosition(frame.previousViewFromView, shown.position);
    const SameSurface surface = sameSurfaceAs(shown);
    Quad quad;
    const Residual around = meanAround(p, surface, own.samples > 0.0, measured.edge, quad);
    const Statistics known = previousStatisticsAt(before, measured.edge);
    const vec3 detail = own.mean - around.mean;
    const float length = accumulated.mean.a;
    const float aroundGain = measured.edge ? constants.residualEdgeGain : constants.residualGain;
    result += accumulatedShare(known.sums.xy, around.samples, known.trust, aroundGain) * around.mean;
    result += accumulatedShare(known.sums.zw, length, known.trust, constants.residualGain) * detail;
    if (own.samples > 0.0) {
      measured.light = vec2(luminance(shown.predicted), 1.0);
      measured.statistics =
          vec4(statisticsOf(around.noisy, around.history, luminance(around.mean), around.samples),
               statisticsOf(own.noisy - around.noisy, own.history - around.history, luminance(detail), length));
      measured.far = vec4(farProduct(surface, own, 0), farProduct(surface, own, 1));
    }
    if (isFirstOfQuad(p)) {
      innovation = meanInnovation(quad);
      if (steers) measured.innovation = innovationTerms(quad, before);
    }
  }
  if (hasPixel && isFirstOfQuad(p)) storeInnovation(p, innovation);
  storeSums(measured);
  return clamp(result, vec3(0.0), vec3(kLightUnit));  // As predictions are: packed light holds no more.
}

#endif
