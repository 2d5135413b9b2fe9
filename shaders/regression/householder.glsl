// Least squares by Householder QR over one work group (Koskela et al. 2019, 3.4 and 6.1). The matrix has kColumns
// columns: first kFeatures features, then the right-hand sides. Each thread keeps kRowsPerThread rows in registers;
// shared memory holds only the sums and R.
// Needs: kThreads, kRowsPerThread, kFeatures, kColumns, `threadIndex` (uint); GL_EXT_control_flow_attributes.
//
// Loops run between constants and are marked [[unroll]]: with constant indices the rows stay in registers.
#ifndef WALR_HOUSEHOLDER_GLSL
#define WALR_HOUSEHOLDER_GLSL

const uint kLanes = 16u;  // Threads that add up one column.
const uint kParts = kThreads / kLanes;
const int kColours = kColumns - kFeatures;

// The gap after each column moves the next one to other banks of shared memory.
shared float partialSums[kColumns][kThreads + kLanes];
shared float laneSums[kColumns][kLanes];
shared float totals[kColumns];
shared float pivotRow[2][kColumns];  // Of this and of the previous column.
shared float triangle[kFeatures][kColumns];  // R, then the transformed right-hand sides.
shared float coefficients[kFeatures][kColours];

float combine(float a, float b, bool largest) { return largest ? max(a, b) : a + b; }

// Sum, or maximum, of every column over the work group, from `partialSums` into `totals`.
void reduceColumns(int firstColumn, bool largest) {
  barrier();
  const int column = firstColumn + int(threadIndex / kLanes);
  const uint lane = threadIndex % kLanes;
  if (column < kColumns) {
    float value = partialSums[column][lane];
    [[unroll]] for (uint i = 1u; i < kParts; ++i)
      value = combine(value, partialSums[column][lane + i * kLanes], largest);
    laneSums[column][lane] = value;
  }
  barrier();
  if (threadIndex < uint(kColumns - firstColumn)) {
    const int c = firstColumn + int(threadIndex);
    float value = laneSums[c][0];
    [[unroll]] for (uint i = 1u; i < kLanes; ++i) value = combine(value, laneSums[c][i], largest);
    totals[c] = value;
  }
  barrier();
}

// Back substitution for right-hand side `c`. Features that depend on earlier ones get 0.
void solveTriangle(int c) {
  float solution[kFeatures];
  [[unroll]] for (int k = kFeatures - 1; k >= 0; --k) {
    float value = triangle[k][kFeatures + c];
    [[unroll]] for (int j = 0; j < kFeatures; ++j)
      if (j > k) value -= triangle[k][j] * solution[j];
    solution[k] = triangle[k][k] == 0.0 ? 0.0 : value / triangle[k][k];
    coefficients[k][c] = solution[k];
  }
}

// Triangularises `rows` in place and solves for the coefficients of every right-hand side. Row `s` of a thread is row
// threadIndex + s kThreads of the matrix, so that the first kFeatures rows, the pivots, are first rows of threads.
//
// A column depends on earlier columns if at most `tolerance` (root mean square over the rows in use) of it is left
// without them. It gets coefficient 0 and no reflection, and its pivot row goes to the next column.
void solveLeastSquares(inout float rows[kRowsPerThread][kColumns], float rowsInUse, float tolerance) {
  uint rank = 0u;
  [[unroll]] for (int k = 0; k < kFeatures; ++k) {
    // Column k from the pivot row down.
    float x[kRowsPerThread];
    [[unroll]] for (int s = 0; s < kRowsPerThread; ++s) x[s] = s > 0 || threadIndex >= rank ? rows[s][k] : 0.0;
    // One reduction gives its length and its products with all later columns.
    [[unroll]] for (int j = 0; j < kColumns; ++j) {
      if (j < k) continue;
      float sum = 0.0;
      [[unroll]] for (int s = 0; s < kRowsPerThread; ++s) sum += x[s] * rows[s][j];
      partialSums[j][threadIndex] = sum;
    }
    if (threadIndex == rank) {
      [[unroll]] for (int j = 0; j < kColumns; ++j)
        if (j >= k) pivotRow[k % 2][j] = rows[0][j];
    }
    reduceColumns(k, false);

    const float squaredLength = totals[k];
    const bool independent = squaredLength > tolerance * tolerance * rowsInUse;
    if (threadIndex == 0u) triangle[k][k] = 0.0;
    if (independent) {
      // Reflect x onto the pivot axis: u = x - r e with r of the sign that cancels nothing, u.u / 2 = 1 / scale.
      const float pivot = pivotRow[k % 2][k];
      const float r = pivot < 0.0 ? sqrt(squaredLength) : -sqrt(squaredLength);
      const float scale = 1.0 / (squaredLength + abs(pivot * r));
      if (threadIndex == 0u) triangle[k][k] = r;
      if (threadIndex == rank) x[0] -= r;
      [[unroll]] for (int j = 0; j < kColumns; ++j) {
        if (j <= k) continue;
        const float factor = (totals[j] - r * pivotRow[k % 2][j]) * scale;
        [[unroll]] for (int s = 0; s < kRowsPerThread; ++s) rows[s][j] -= factor * x[s];
      }
      if (threadIndex == rank) {
        [[unroll]] for (int j = 0; j < kColumns; ++j)
          if (j > k) triangle[k][j] = rows[0][j];
      }
      ++rank;
    }
  }
  barrier();

  if (threadIndex < uint(kColours)) solveTriangle(int(threadIndex));
  barrier();
}

#endif
