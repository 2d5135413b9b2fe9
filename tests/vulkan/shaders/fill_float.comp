// Writes 1 to a float image, for all texels that the work groups cover.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba16f) uniform writeonly image2D target;

void main() { imageStore(target, ivec2(gl_GlobalInvocationID.xy), vec4(1.0)); }
