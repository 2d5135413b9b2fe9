// What is at rest in the picture: its history is not resampled, so that a longer one blurs nothing (passes/WALR.md, 2).
#ifndef WALR_AT_REST_GLSL
#define WALR_AT_REST_GLSL

// `motion`: to where the history lies, pixels. Rounding of the host's motion is less than the limit.
bool isAtRest(vec2 motion) { return all(lessThan(abs(motion), vec2(1.0 / 64.0))); }

#endif
