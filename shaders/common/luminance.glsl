// Luminance of linear Rec. 709 colour.
#ifndef WALR_LUMINANCE_GLSL
#define WALR_LUMINANCE_GLSL

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

#endif
