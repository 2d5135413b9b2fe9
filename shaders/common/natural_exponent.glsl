// Weights are powers of two, which devices compute, in place of powers of e.
#ifndef WALR_NATURAL_EXPONENT_GLSL
#define WALR_NATURAL_EXPONENT_GLSL

const float kLog2OfE = 1.44269504;

#endif
