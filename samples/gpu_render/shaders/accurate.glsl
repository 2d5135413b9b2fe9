// Arc tangent and arc cosine to within a few roundings of float, because Vulkan lets the arc tangent of the language err by 4096
// roundings. The path tracer on the processor has accurate ones. The polynomial is that of Cephes' atanf (S. Moshier).
#include "samples/render/exact/arithmetic.h"

// Arc tangent of a number from 0 on.
float arcTangent(float x) {
  float offset = 0.0;
  if (x > 2.414213562373095) {
    offset = 0.5 * kPi;
    x = -1.0 / x;
  } else if (x > 0.4142135623730950) {
    offset = 0.25 * kPi;
    x = (x - 1.0) / (x + 1.0);
  }
  const float z = x * x;
  return offset + ((((8.05374449538e-2 * z - 1.38776856032e-1) * z + 1.99777106478e-1) * z - 3.33329491539e-1) * z * x + x);
}

// Angle of a vector from the x axis, -pi to pi; 0 for a vector without length.
float angleOf(float y, float x) {
  if (x == 0.0 && y == 0.0) return 0.0;
  float angle = x == 0.0 ? 0.5 * kPi : arcTangent(abs(y) / abs(x));
  if (x < 0.0) angle = kPi - angle;
  return y < 0.0 ? -angle : angle;
}

// Arc cosine of a number from -1 to 1.
float arcCosine(float x) { return angleOf(sqrt((1.0 - x) * (1.0 + x)), x); }
