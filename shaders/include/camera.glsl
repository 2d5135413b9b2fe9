// Pinhole camera: pixels, rays and view-space positions.
#ifndef WALR_CAMERA_GLSL
#define WALR_CAMERA_GLSL

// View-space ray through a pixel position, scaled so that its product with the view depth is the position.
vec3 rayThrough(vec4 rayFromPixel, vec2 pixel) { return vec3(pixel * rayFromPixel.xy + rayFromPixel.zw, -1.0); }

vec2 pixelCentre(ivec2 p) { return vec2(p) + 0.5; }

#endif
