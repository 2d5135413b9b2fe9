// target = uploaded value * specialization constant.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 4) const uint factor = 1;
layout(set = 0, binding = 0) uniform Frame { uint pad; uint value; } frame;
layout(set = 0, binding = 1, r32ui) uniform writeonly uimage2D target;

void main() { imageStore(target, ivec2(gl_GlobalInvocationID.xy), uvec4(frame.value * factor)); }
