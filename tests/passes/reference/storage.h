#pragma once

namespace walr::reference {

/// How results are kept between stages.
enum class Storage {
  Exact,      ///< In double precision.
  Quantised,  ///< Rounded to nearest in the documented formats: halves, 16-bit unorms, depth with 19 significant bits.
};

inline constexpr double kLargestHalf = 65504.0;
inline constexpr double kHalfRoundoff = 0x1p-11;       ///< Largest relative error of a normal half, rounded to nearest.
inline constexpr double kFloat11Roundoff = 0x1p-7;     ///< The same of an unsigned 11-bit float (6 bits of mantissa).
inline constexpr double kFloat10Roundoff = 0x1p-6;     ///< The same of an unsigned 10-bit float (5 bits of mantissa).
inline constexpr double kSmallestHalf = 0x1p-24;       ///< Step between subnormal halves.
inline constexpr double kDepthRoundoff = 0x1p-19;      ///< Largest relative error of a packed depth.
inline constexpr double kUnorm16Step = 1.0 / 65535.0;  ///< Step between 16-bit unorms.
inline constexpr double kUnorm12Step = 1.0 / 4095.0;   ///< The same of 12 bits.
inline constexpr double kUnorm8Step = 1.0 / 255.0;     ///< The same of 8 bits.
inline constexpr double kShortNormalSteps = 254.0;     ///< Of a short normal's octahedral map, per axis.
inline constexpr double kFloatRoundoff = 0x1p-24;      ///< Largest relative error of one operation in single precision.

/// Bits of mantissa of packed light (packed_light.glsl).
inline constexpr int kAccumulatedBits = 7;
inline constexpr int kFilteredBits = 9;
inline constexpr int kResolvedBits = 8;
inline constexpr int kPassedBits = 9;

/// Step between packed colours whose brightest channel is this one: the smallest of which the mantissa, rounded up, can
/// count enough.
double packedStep(double brightest, int mantissaBits);
/// Largest error of a packed channel of light that passes through, which is rounded to nearest; 0 stays 0.
double passedError(double value, double brightest);
/// Largest packed channel.
double largestPacked(int mantissaBits);
/// Step between packed counts of samples.
double packedCountStep(double count);
/// Step between packed lengths of at least 1.
double packedLengthStep(double length, double longest);

/// Nearest half, ties to even; infinite from 65520 on.
double roundToHalf(double value);
/// Nearest half that is finite.
double roundToFiniteHalf(double value);
/// Nearest unsigned float with a 5-bit exponent and the given bits of mantissa, as R11G11B10_FLOAT has them; what is
/// below 0 becomes 0, and what is too large the largest.
double roundToUnsignedFloat(double value, int mantissaBits);
/// Nearest float.
double roundToFloat(double value);
/// Nearest multiple of a step of [0, 1].
double roundToUnorm(double value, double step);
/// Nearest of the 65536 steps of [0, 1].
double roundToUnorm16(double value);
/// Nearest float with 19 significant bits, ties up, of a depth of at least 0: what depth keeps beside the five bits of
/// the edge distance.
double roundDepth(double depth);

}  // namespace walr::reference
