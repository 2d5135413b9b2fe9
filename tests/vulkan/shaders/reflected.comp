// Every kind of binding once, so that reflection can be checked one by one.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#ifndef WIDTH
#define WIDTH 8
#endif
layout(local_size_x = WIDTH, local_size_y = 4, local_size_z = 2) in;

layout(constant_id = 3) const uint iterations = 1;
layout(constant_id = 1) const float sigma = 2.0;

layout(set = 0, binding = 0) uniform texture2D separate;
layout(set = 0, binding = 1) uniform sampler2D combined;
layout(set = 0, binding = 2, r32f) uniform readonly image2D source;
layout(set = 0, binding = 3, rgba16f) uniform writeonly image2D target;
layout(set = 0, binding = 4, r32ui) uniform uimage2D inPlace;
layout(set = 0, binding = 5) uniform Frame { mat4 view; vec2 scale; } frame;
layout(set = 0, binding = 6, std430) readonly buffer Arguments { uint arguments[]; };
layout(set = 0, binding = 7, std430) writeonly buffer Result { uint value; } result;
layout(set = 0, binding = 8, std430) buffer Totals { uint total[4]; } totals;
uniform texture2D assigned;
uniform texture2D unused;

layout(push_constant) uniform Push { vec4 a; uint b; } push;

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  vec4 sum = texelFetch(separate, p, 0) + textureLod(combined, vec2(p) * frame.scale, 0.0) + imageLoad(source, p) + texelFetch(assigned, p, 0);
  for (uint i = 0; i < iterations; ++i) sum += push.a * sigma;
  imageStore(target, p, frame.view * sum);
  imageStore(inPlace, p, imageLoad(inPlace, p) + arguments[0] + push.b);
  result.value = totals.total[0];
  totals.total[1] = 7;
}
