// Sine, cosine and arc tangent to within a few roundings of float, because Vulkan lets those of the language err by 2^-11
// (sine and cosine) and 4096 roundings (arc tangent). The path tracer on the processor has accurate ones. The polynomials are
// those of Cephes' sinf, cosf and atanf (S. Moshier).
const float kPi = 3.14159265358979;

// Cosine (x) and sine (y) of an angle in turns.
vec2 cosineAndSine(float turns) {
  const float quarters = round(4.0 * turns);
  const float angle = (4.0 * turns - quarters) * (0.5 * kPi);
  const float z = angle * angle;
  const float sine = ((-1.9515295891e-4 * z + 8.3321608736e-3) * z - 1.6666654611e-1) * z * angle + angle;
  const float cosine = ((2.443315711809948e-5 * z - 1.388731625493765e-3) * z + 4.166664568298827e-2) * z * z - 0.5 * z + 1.0;
  const int quadrant = int(quarters) & 3;
  const vec2 turned = (quadrant & 1) == 0 ? vec2(cosine, sine) : vec2(-sine, cosine);
  return (quadrant & 2) == 0 ? turned : -turned;
}

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
