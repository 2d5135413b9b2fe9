// Pinhole camera: pixels, rays and view-space positions.
#ifndef WALR_CAMERA_GLSL
#define WALR_CAMERA_GLSL

// View-space ray through a pixel position, scaled so that its product with the view depth is the position.
vec3 rayThrough(vec4 rayFromPixel, vec2 pixel) { return vec3(pixel * rayFromPixel.xy + rayFromPixel.zw, -1.0); }

vec2 pixelCentre(ivec2 p) { return vec2(p) + 0.5; }

// Position in pixels that shows a view-space position.
vec2 pixelOf(vec4 rayFromPixel, vec3 position) {
  return (position.xy / -position.z - rayFromPixel.zw) / rayFromPixel.xy;
}

// The same, at most a million pixels away from the origin: finite, and within the range of integers.
vec2 nearPixelOf(vec4 rayFromPixel, vec3 position) {
  return clamp(pixelOf(rayFromPixel, position), vec2(-1e6), vec2(1e6));
}

// Position of a still surface in the view space of the previous camera, from its position in this view space.
vec3 previousPosition(mat4 previousViewFromView, vec3 position) {
  return (previousViewFromView * vec4(position, 1.0)).xyz;
}

#endif
