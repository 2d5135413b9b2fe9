// Least squares by Householder QR over one work group (Koskela et al. 2019, 3.4 and 6.1). The matrix has kColumns
// columns: first kFeatures features, then the right-hand sides. Each thread keeps kRowsPerThread rows in registers;
// shared memory holds only the sums and R.
// Needs: kThreads, kRowsPerThread, kFeatures, kColumns, `threadIndex` (uint).
#ifndef WALR_HOUSEHOLDER_GLSL
#define WALR_HOUSEHOLDER_GLSL

const uint kLanes = 16u;  // Threads that add up one column.
const int kColours = kColumns - kFeatures;

shared float partialSums[kColumns][kThreads];
shared float laneSums[kColumns][kLanes];
shared float totals[kColumns];
shared float pivotRow[kColumns];
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
    for (uint i = lane + kLanes; i < kThreads; i += kLanes) value = combine(value, partialSums[column][i], largest);
    laneSums[column][lane] = value;
  }
  barrier();
  if (threadIndex < uint(kColumns - firstColumn)) {
    const int c = firstColumn + int(threadIndex);
    float value = laneSums[c][0];
    for (uint i = 1u; i < kLanes; ++i) value = combine(value, laneSums[c][i], largest);
    totals[c] = value;
  }
  barrier();
}

// Triangularises `rows` in place and solves for the coefficients of every right-hand side.
//
// A column depends on earlier columns if at most `tolerance` (root mean square over the rows in use) of it is left
// without them. It gets coefficient 0 and no reflection, and its pivot row goes to the next column.
void solveLeastSquares(inout float rows[kRowsPerThread][kColumns], float rowsInUse, float tolerance) {
  uint rank = 0u;
  [[unroll]] for (int k = 0; k < kFeatures; ++k) {
    // One reduction gives the length of column k and its products with all later columns.
    [[unroll]] for (int j = k; j < kColumns; ++j) {
      float sum = 0.0;
      [[unroll]] for (int s = 0; s < kRowsPerThread; ++s)
        if (threadIndex + uint(s) * kThreads >= rank) sum += rows[s][k] * rows[s][j];
      partialSums[j][threadIndex] = sum;
      if (threadIndex == rank) pivotRow[j] = rows[0][j];
    }
    reduceColumns(k, false);

    const float squaredLength = totals[k];
    const bool independent = squaredLength > tolerance * tolerance * rowsInUse;
    if (threadIndex == 0u) triangle[k][k] = 0.0;
    if (independent) {
      // Reflect column k, x, onto the pivot axis: u = x - r e with r of the sign that cancels nothing, u.u / 2 = scale.
      const float pivot = pivotRow[k];
      const float r = pivot < 0.0 ? sqrt(squaredLength) : -sqrt(squaredLength);
      const float scale = 1.0 / (squaredLength + abs(pivot * r));
      if (threadIndex == 0u) triangle[k][k] = r;
      [[unroll]] for (int j = k + 1; j < kColumns; ++j) {
        const float factor = (totals[j] - r * pivotRow[j]) * scale;
        [[unroll]] for (int s = 0; s < kRowsPerThread; ++s) {
          const uint row = threadIndex + uint(s) * kThreads;
          if (row >= rank) rows[s][j] -= factor * (rows[s][k] - (row == rank ? r : 0.0));
        }
        if (threadIndex == rank) triangle[k][j] = rows[0][j];
      }
      ++rank;
    }
    barrier();
  }

  if (threadIndex < uint(kColours)) {
    for (int k = kFeatures - 1; k >= 0; --k) {
      coefficients[k][threadIndex] = 0.0;
      if (triangle[k][k] == 0.0) continue;
      float value = triangle[k][kFeatures + int(threadIndex)];
      for (int j = k + 1; j < kFeatures; ++j) value -= triangle[k][j] * coefficients[j][threadIndex];
      coefficients[k][threadIndex] = value / triangle[k][k];
    }
  }
  barrier();
}

#endif
