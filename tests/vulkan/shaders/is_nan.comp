// Writes 1 if all channels of the source are NaN, 2 if none is, 3 otherwise.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D source;
layout(set = 0, binding = 1, r32ui) uniform writeonly uimage2D target;

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  const bvec4 nan = isnan(texelFetch(source, p, 0));
  imageStore(target, p, uvec4(all(nan) ? 1u : any(nan) ? 3u : 2u));
}
