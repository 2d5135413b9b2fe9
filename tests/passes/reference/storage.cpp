#include "tests/passes/reference/storage.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace walr::reference {
namespace {

/// Round to a binary floating-point format with `digits` significant bits whose smallest step is 2^`smallestExponent`.
double roundToFormat(double value, int digits, int smallestExponent) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  int exponent = 0;
  (void)std::frexp(value, &exponent);  // abs(value) in [2^(exponent - 1), 2^exponent)
  const int step = std::max(exponent - digits, smallestExponent);
  return std::ldexp(std::nearbyint(std::ldexp(value, -step)), step);
}

/// Nearest number with this many significant bits, ties up.
double roundUp(double value, int bits) {
  int exponent = 0;
  (void)std::frexp(value, &exponent);
  return std::ldexp(std::floor(std::ldexp(value, bits - exponent) + 0.5), exponent - bits);
}

}  // namespace

double packedStep(double brightest, int mantissaBits) {
  constexpr int kBias = 15;
  const double most = std::ldexp(1.0, mantissaBits) - 1.0;
  double step = std::ldexp(1.0, -kBias - mantissaBits);
  while (brightest > most * step) step *= 2.0;
  return step;
}

double passThroughError(double value, double brightest) {
  return value == 0.0 ? 0.0 : 0.5 * packedStep(brightest, kPassThroughBits);
}

double largestPacked(int mantissaBits) {
  return std::ldexp(std::ldexp(1.0, mantissaBits) - 1.0, 16 - mantissaBits);
}

double packedCountStep(double count) {
  return count < 8.0 ? 0.5 : std::exp2(std::floor(std::log2(count)) - 3.0);
}

double packedLengthStep(double length, double longest) {
  constexpr double kLastPower = 32.0;
  const double low = std::min(std::exp2(std::floor(std::log2(length))), kLastPower);
  return (low == kLastPower ? longest : std::min(2.0 * low, longest)) - low;
}

double roundToHalf(double value) {
  const double rounded = roundToFormat(value, 11, -24);
  return std::abs(rounded) > kLargestHalf ? std::copysign(std::numeric_limits<double>::infinity(), value) : rounded;
}

double roundToFiniteHalf(double value) {
  return roundToHalf(std::clamp(value, -kLargestHalf, kLargestHalf));
}

double roundToUnsignedFloat(double value, int mantissaBits) {
  const double largest = std::ldexp(2.0 - std::ldexp(1.0, -mantissaBits), 15);
  return value > 0.0 ? std::min(roundToFormat(value, mantissaBits + 1, -14 - mantissaBits), largest) : 0.0;
}

double roundToFloat(double value) {
  return double(static_cast<float>(value));
}

double roundToUnorm(double value, double step) {
  return std::nearbyint(std::clamp(value, 0.0, 1.0) / step) * step;
}

double roundToUnorm16(double value) {
  return roundToUnorm(value, kUnorm16Step);
}

double roundDepth(double depth) {
  return roundUp(depth, 19);
}

double roundDepthBesideNormal(double depth) {
  return roundUp(depth, 12);
}

}  // namespace walr::reference
