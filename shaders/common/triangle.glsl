// One triangle of a symmetric matrix in an array. Needs: `kFeatures`.
//
// Loops over the triangle run from 0 to a constant, so that compilers unroll them: with constant indices the array
// stays in registers.
#ifndef WALR_TRIANGLE_GLSL
#define WALR_TRIANGLE_GLSL

// Index of entry (i, j), i >= j: the lower triangle column by column, which is the upper triangle row by row.
int triangleEntry(int i, int j) { return j * (2 * kFeatures - j - 1) / 2 + i; }

#endif
