// What lint_inputs.comp counts of a frame's inputs: words of a buffer, each a number of pixels or of pairs of pixels.
// C++ reads them with `walr::LintCounts` (passes/lint_inputs.h).
#ifndef WALR_SHADERS_CONSTANTS_LINT_H
#define WALR_SHADERS_CONSTANTS_LINT_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

// Values. "Surface": depth is finite, more than 0 and nearer than the sky.
const uint kLintPixels = 0;
const uint kLintSurfaces = 1;
const uint kLintDepthNotFinite = 2;  // NaN, or infinitely far behind the camera; in front of it infinity is sky.
const uint kLintDepthNegative = 3;
const uint kLintDepthZero = 4;
const uint kLintNormalNotFinite = 5;  // Of surfaces, as all that follows on normals, motion and albedo.
const uint kLintNormalZero = 6;
const uint kLintNormalNotUnit = 7;
const uint kLintMotionNotFinite = 8;
const uint kLintLightingNotFinite = 9;  // Of all pixels.
const uint kLintLightingNegative = 10;
const uint kLintAlbedoNotFinite = 11;
const uint kLintAlbedoOutside = 12;  // Of 0 to 1, in any channel.
const uint kLintDiffuse = 13;

// Motion beside that of a still surface, by axis: x from kLintMotionX, y from kLintMotionY on. Only where a still
// surface moves; each pixel is of at most one reading.
const uint kLintMotionX = 14;
const uint kLintMotionY = 24;
const uint kReadingTested = 0;
const uint kReadingAsStated = 1;
const uint kReadingOpposite = 2;
const uint kReadingUv = 3;  // 1 is the picture's width or height.
const uint kReadingUvOpposite = 4;
const uint kReadingClip = 5;  // 2 is the picture's width or height.
const uint kReadingClipOpposite = 6;
const uint kReadingPixels = 7;  // In pixels, though stated in pictures.
const uint kReadingPixelsOpposite = 8;
const uint kReadingNone = 9;  // No motion.
const uint kReadings = 10;

// The same of motion.z, where it is given; of readings there are the first three and none.
const uint kLintMotionZ = 34;

// Motion where the cameras say that a still surface does not move.
const uint kLintStillTested = 44;
const uint kLintStillMoves = 45;

// Jitter in the motion, where pixels are jittered differently from the last frame.
const uint kLintJitterTested = 46;
const uint kLintJitterAsStated = 47;
const uint kLintJitterOther = 48;     // Is in it though stated not to be, or the other way about.
const uint kLintJitterOpposite = 49;  // Is in it with the other sign.

// Shading normals beside the slope of the depth, by hypothesis: how many pixels fit better with it than without, and
// how many the other way about.
const uint kLintNormalTested = 50;
const uint kLintHypotheses = 51;
const uint kHypothesisOtherSpace =
    0;                               // Normals are in world space though stated in view space, or the other way about.
const uint kHypothesisFlippedY = 1;  // Normals' y is down.
const uint kHypothesisInverseDepth = 2;  // Depth is that of a reversed projection.
const uint kHypothesisDeviceDepth = 3;   // Depth is that of a projection with a far plane far away.
const uint kHypothesisDistance = 4;      // Depth is the distance from the camera.
const uint kHypothesisCount = 5;
const uint kLintNormalFits = 61;  // As stated; see kFittingCosine.

// Albedo in the lighting: neighbours on one surface of which one has at least kAlbedoContrast times the albedo. How
// often their light is of an order of magnitude: that of the one with more albedo, that of the other, and both after a
// division by albedo. Order 0 is none, order k from 2^(k - kLintUnitOrder) to twice that.
const uint kLintPairs = 62;
const uint kLintLightMore = 63;
const uint kLintLightLess = 95;
const uint kLintDividedMore = 127;
const uint kLintDividedLess = 159;
const uint kLintOrders = 32;
const uint kLintUnitOrder = 17;

const uint kLintWords = 191;

// Of a normal at random in the half space that faces the camera, the cosine with any direction exceeds c with
// probability 1 - c.
const float kFittingCosine = 0.8;
const float kAlbedoContrast = 2.0;
const float kAlbedoLeast = 0.01;  // Below, a pixel has no diffuse lobe.

#ifdef __cplusplus
}  // namespace walr
#endif
#endif
