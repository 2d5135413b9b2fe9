// Counts of lint_inputs.comp: words of a buffer, each a number of pixels or of pairs of pixels.
// C++ reads them with `walr::LintCounts` (passes/lint/lint_inputs.h).
#ifndef WALR_SHADERS_LINT_LINT_INPUTS_H
#define WALR_SHADERS_LINT_LINT_INPUTS_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

// Values. "Surface": depth is finite, more than 0 and nearer than the sky.
const uint kLintPixels = 0;
const uint kLintSurfaces = 1;
const uint kLintDepthNotFinite = 2;  // NaN, or infinitely far behind the camera; in front of it infinity is sky.
const uint kLintDepthNegative = 3;
const uint kLintDepthZero = 4;
const uint kLintNormalNotFinite = 5;  // Of surfaces, like all below on normals, motion and albedo.
const uint kLintNormalZero = 6;
const uint kLintNormalNotUnit = 7;
const uint kLintMotionNotFinite = 8;
const uint kLintLightingNotFinite = 9;  // Of all pixels.
const uint kLintLightingNegative = 10;
const uint kLintAlbedoNotFinite = 11;
const uint kLintAlbedoOutside = 12;  // Of 0 to 1, in any channel.
const uint kLintDiffuse = 13;

// Motion compared with that of a still surface, by axis: x from kLintMotionX, y from kLintMotionY on. Counted only
// where a still surface would move; each pixel counts for one reading at most.
const uint kLintMotionX = 14;
const uint kLintMotionY = 24;
const uint kReadingTested = 0;
const uint kReadingAsStated = 1;
const uint kReadingOpposite = 2;
const uint kReadingUv = 3;  // In UV: 1 is the image's width or height.
const uint kReadingUvOpposite = 4;
const uint kReadingClip = 5;  // In clip space: 2 is the image's width or height.
const uint kReadingClipOpposite = 6;
const uint kReadingPixels = 7;  // In pixels, though stated to be in UV.
const uint kReadingPixelsOpposite = 8;
const uint kReadingNone = 9;  // No motion.
const uint kReadings = 10;

// The same for motion.z, if it is given, with the first three readings and kReadingNone only.
const uint kLintMotionZ = 34;

// Motion where, by the cameras, a still surface does not move. A sum over frames holds only those frames in which more
// than a tenth of these pixels moves (LintCounts): frames in which nothing moves say nothing about the cameras.
const uint kLintStillTested = 44;
const uint kLintStillMoves = 45;
const uint kLintStillMovesAlike = 46;  // As the pixel in the middle does, and no farther than jitter can differ.

// Jitter in the motion, where the jitter differs from the previous frame's.
const uint kLintJitterTested = 47;
const uint kLintJitterAsStated = 48;
const uint kLintJitterOther = 49;     // Motion holds it though stated not to, or the reverse.
const uint kLintJitterOpposite = 50;  // Motion holds it with the other sign.

// Shading normals compared with the slope of depth, two words per hypothesis: pixels that fit better with it than
// without, and pixels that fit worse.
const uint kLintNormalTested = 51;
const uint kLintHypotheses = 52;
const uint kHypothesisOtherSpace = 0;  // Normals are in world space though stated to be in view space, or the reverse.
const uint kHypothesisFlippedY = 1;    // Normals' y is down.
const uint kHypothesisInverseDepth = 2;  // Depth is that of a reversed projection.
const uint kHypothesisDeviceDepth = 3;   // Depth is that of a projection with a far plane far away.
const uint kHypothesisDistance = 4;      // Depth is the distance from the camera.
const uint kHypothesisInverseView = 5;   // The view matrix leads from view to world space.
const uint kHypothesisCount = 6;
const uint kLintNormalFits = 64;  // Normals fit as stated; see kFittingCosine.

// Albedo left in the lighting: pairs of pixels on one surface, in a row or column, 1, 2, 4, ... kAlbedoFarthest apart,
// by the contrast of their albedo in the channel in which it differs most. Class c holds contrasts from c + 1 to c + 2
// steps, the last class all larger ones.
const uint kLintFollowsAlbedo = 65;  // The light's contrast is nearer to that of albedo than to none.
const uint kLintIgnoresAlbedo = 73;  // The reverse.
const int kAlbedoFarthest = 8;       // Pixels.
const uint kAlbedoContrasts = 8;
const float kAlbedoContrastStep = 0.25;  // Octaves.

// Surfaces that the rounding of the view matrix moves by more than kMostRounding, because the camera is far from the
// origin of its matrices.
const uint kLintRounded = 81;

// Light with alpha (light_sample.glsl).
const uint kLintSamples = 82;       // Pixels with a sample, whatever its colour.
const uint kLintCountInvalid = 83;  // Texels whose number of samples is NaN, negative or more than halves can hold.

// Tiles of 8 x 8 pixels in which one sample is more than kFireflyContrast times as bright as all others together, if
// so many of these have light that the tile is no place where few paths find any.
const uint kLintFireflies = 84;
const float kFireflyContrast = 100.0;
const uint kFireflyNeighbours = 16;

const uint kLintWords = 85;

// A random normal that faces the camera has a cosine above c with any direction with probability 1 - c.
const float kFittingCosine = 0.8;
const float kMostRounding = 0.1;  // Pixels, as much as the errors of a matrix that is accepted (camera_check.cpp).
const float kAlbedoLeast = 0.01;  // The usual guides.albedo-threshold; the linter does not know the method's.

#ifdef __cplusplus
}  // namespace walr
#endif
#endif
