// What an a-trous iteration of SVGF reads of the pixels around.
// Needs: `depth`, `shadingNormal` (utexture2D), `colour` (texture2D), kRadius, kSpacing;
// GL_EXT_control_flow_attributes.
// SPECULAR: reads `lobes` (packed_lobe.glsl) instead of `shadingNormal`.
// WINDOW: reads every tap from the textures. Else a work group reads each pixel once and keeps it in shared memory.
#ifndef WALR_SVGF_TAPS_GLSL
#define WALR_SVGF_TAPS_GLSL
#include "conventions/surface.glsl"
#include "filters/interleaved_quads.glsl"

struct Tap {
  float z;  // 0 where the tap does not count: outside the image, without a surface or without a sample.
#ifdef SPECULAR
  Lobe lobe;
#else
  vec3 normal;
#endif
  vec4 colour;  // 0 where the tap does not count.
};

// All fetches come before the first test, so that they overlap.
Tap readTap(ivec2 q) {
  const ivec2 inside = clamp(q, ivec2(0), textureSize(depth, 0) - 1);
  const float z = unpackDepth(texelFetch(depth, inside, 0).x);
#ifdef SPECULAR
  const Lobe guide = unpackLobe(texelFetch(lobes, inside, 0).xy);
#else
  const vec3 guide = unpackLongNormal(texelFetch(shadingNormal, inside, 0).x);
#endif
  const vec4 light = texelFetch(colour, inside, 0);
  const bool counts = q == inside && z > 0.0 && light.a >= 0.0;
  return Tap(counts ? z : 0.0, guide, counts ? light : vec4(0.0));
}

#ifdef WINDOW
ivec2 pixelOfThread() { return ivec2(gl_GlobalInvocationID.xy); }
void prepareTaps() {}
Tap tapAt(ivec2 p, ivec2 tap) { return readTap(p + kSpacing * tap); }
#else
// A work group filters 8 x 8 quads (interleaved_quads.glsl), which lie side by side where taps are one pixel apart.
const int kGroupSide = 16;
const int kQuadSpacing = kSpacing < 2 ? 2 : kSpacing;
const int kTapSpacing = kSpacing < 2 ? 1 : 2;  // In the tile.
const int kBorder = kRadius * kTapSpacing;
const int kTileSide = kGroupSide + 2 * kBorder;
const int kTilePixels = kTileSide * kTileSide;
const uint kThreads = uint(kGroupSide * kGroupSide);
const uint kReads = (uint(kTilePixels) + kThreads - 1u) / kThreads;  // Of a thread.

shared vec4 tileSurface[kTilePixels];  // Shading normal or direction of the lobe, depth.
#ifdef SPECULAR
shared uint tileLobe[kTilePixels];  // Its other values, as two halves.
#endif
shared uvec2 tileColour[kTilePixels];  // As four halves.

ivec2 pixelAt(ivec2 place) { return pixelOfQuads(place, kGroupSide, kQuadSpacing); }

ivec2 pixelOfThread() { return pixelAt(ivec2(gl_LocalInvocationID.xy)); }

void prepareTaps() {
  Tap taps[kReads];
  [[unroll]] for (uint i = 0u; i < kReads; ++i) {
    const uint index = min(gl_LocalInvocationIndex + i * kThreads, uint(kTilePixels) - 1u);
    taps[i] = readTap(pixelAt(ivec2(index % uint(kTileSide), index / uint(kTileSide)) - kBorder));
  }
  [[unroll]] for (uint i = 0u; i < kReads; ++i) {
    const uint index = gl_LocalInvocationIndex + i * kThreads;
    if (index >= uint(kTilePixels)) break;
#ifdef SPECULAR
    tileSurface[index] = vec4(taps[i].lobe.direction, taps[i].z);
    tileLobe[index] = packHalf2x16(vec2(taps[i].lobe.angle, taps[i].lobe.nearness));
#else
    tileSurface[index] = vec4(taps[i].normal, taps[i].z);
#endif
    tileColour[index] = uvec2(packHalf2x16(taps[i].colour.rg), packHalf2x16(taps[i].colour.ba));
  }
  barrier();
}

Tap tapAt(ivec2 p, ivec2 tap) {
  const uint first = gl_LocalInvocationID.y * uint(kTileSide) + gl_LocalInvocationID.x;
  const uvec2 place = uint(kTapSpacing) * uvec2(tap + kRadius);
  const uint index = first + (place.y * uint(kTileSide) + place.x);
  const vec4 surface = tileSurface[index];
  const uvec2 light = tileColour[index];
#ifdef SPECULAR
  const vec2 values = unpackHalf2x16(tileLobe[index]);
  const Lobe guide = Lobe(surface.xyz, values.x, values.y);
#else
  const vec3 guide = surface.xyz;
#endif
  return Tap(surface.w, guide, vec4(unpackHalf2x16(light.x), unpackHalf2x16(light.y)));
}
#endif

#endif
