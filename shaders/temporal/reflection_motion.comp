// Finds the motion of reflections (reflection_motion.glsl). The place is written as kept taps (history_taps.glsl), which
// accumulation takes, and the miss as a confidence in the history (confidence.glsl).
// VIEW: does the same work and writes its intermediate values.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "conventions/frame.h"
#include "temporal/reflection_motion.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform texture2D lighting;
uniform texture2D roughness;
uniform texture2D motion;
uniform utexture2D depth;
uniform utexture2D geometricNormal;          // Of `historyTaps`, which is not called.
uniform utexture2D shadingNormal;
uniform usampler2D previousDepth;
uniform usampler2D previousGeometricNormal;  // Likewise.
uniform usampler2D previousReflector;
#ifdef VIEW
layout(rgba32f) uniform writeonly image2D outView;
#else
layout(r32ui) uniform writeonly uimage2D outTaps;
layout(r8) uniform writeonly image2D outConfidence;
layout(rg32ui) uniform writeonly uimage2D outReflector;
#endif
layout(push_constant) uniform PushConstants {
#ifdef HOST_SURFACES
  HostReflectionConstants pushed;
#define constants pushed.motion
#define guideConstants pushed.guides
#else
  ReflectionMotionConstants constants;
#endif
#ifdef VIEW
  uint view;  // Which quantity; numbered in viewOf.
#endif
};

#define KEEP_TAPS
#define HISTORY previousReflector
#include "temporal/reflection_motion.glsl"

#ifdef VIEW
vec3 viewOf(ivec2 p, Reflector own) {
  const ReflectionMotion m = reflectionMotionAt(p, own);
  switch (view) {
    case 0u: return vec3(m.motion, m.followed);
    case 1u: return vec3(m.history, min(m.miss, kLargestHalf), any(m.taps) && m.history < constants.maxHistory);
  }
  return vec3(0.0);
}
#endif

void main() {
  fillTile();
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, pictureSize()))) return;
  const Reflector own = reflectorAt(p);
  const float z = -own.position.z;
#ifdef VIEW
  imageStore(outView, p, vec4(z > 0.0 ? viewOf(p, own) : vec3(0.0), 1.0));
#else
  if (z == 0.0) {
    imageStore(outTaps, p, uvec4(kNoSurfaceTaps));
    imageStore(outConfidence, p, vec4(0.0));
    imageStore(outReflector, p, uvec4(0u));
    return;
  }
  const ReflectionMotion m = reflectionMotionAt(p, own);
  imageStore(outTaps, p, uvec4(packTaps(m.motion, m.taps)));
  imageStore(outConfidence, p, vec4(m.history / constants.maxHistory));
  imageStore(outReflector, p, uvec4(packedReflectorOf(p, own, m), 0u, 0u));
#endif
}
