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
inline constexpr double kUnorm12Step = 1.0 / 4095.0;   ///< Step between 12-bit unorms.
inline constexpr double kUnorm8Step = 1.0 / 255.0;     ///< Step between 8-bit unorms.
inline constexpr double kShortNormalStep = 1.0 / 16.0;  ///< Step of a short normal's stereographic projection.
inline constexpr double kShortNormalEnd = 31.0 / 16.0;  ///< Largest coordinate of this projection.
inline constexpr double kFloatRoundoff = 0x1p-24;  ///< Largest relative error of one operation in single precision.

/// Bits of mantissa of packed light (packed_light.glsl; passes/WALR.md, Storage).
inline constexpr int kAccumulatedBits = 7;
inline constexpr int kFilteredBits = 9;
inline constexpr int kResolvedBits = 8;
inline constexpr int kPassThroughBits = 9;

/// Step between packed colours with this brightest channel: the smallest one with which the mantissa can hold the
/// channel.
double packedStep(double brightest, int mantissaBits);
/// Largest error of a packed channel of the pass-through, which is rounded to nearest; 0 stays 0.
double passThroughError(double value, double brightest);
/// Largest value of a packed channel.
double largestPacked(int mantissaBits);
/// Step between packed history lengths after accumulation.
double packedCountStep(double count);
/// Step between packed history lengths of at least 1 in the anti-aliasing history.
double packedLengthStep(double length, double longest);

/// Nearest half, ties to even; infinite from 65520 on.
double roundToHalf(double value);
/// Nearest half that is finite.
double roundToFiniteHalf(double value);
/// Nearest unsigned float with a 5-bit exponent and the given bits of mantissa, as in R11G11B10_FLOAT. Values below 0
/// become 0; values that are too large become the largest.
double roundToUnsignedFloat(double value, int mantissaBits);
/// Nearest float.
double roundToFloat(double value);
/// Nearest multiple of `step` in [0, 1].
double roundToUnorm(double value, double step);
/// Nearest 16-bit unorm.
double roundToUnorm16(double value);
/// Nearest float with 19 significant bits, ties up: the precision of a packed depth, which shares 32 bits with five
/// bits of edge distance. `depth` is at least 0.
double roundDepth(double depth);
/// The same with 12 significant bits: that of a depth that shares 32 bits with a short normal.
double roundDepthBesideNormal(double depth);

}  // namespace walr::reference
