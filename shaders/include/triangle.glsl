// One triangle of a symmetric matrix in an array. Needs: `kFeatures`.
//
// Loops over it run from 0 to a constant: compilers unroll those, and an array whose indices are then all constant lies
// in registers and not in memory.
#ifndef WALR_TRIANGLE_GLSL
#define WALR_TRIANGLE_GLSL

// Where entry (i, j), i >= j, of the lower triangle lies, column by column: the upper one's order row by row.
int triangleEntry(int i, int j) { return j * (2 * kFeatures - j - 1) / 2 + i; }

#endif
