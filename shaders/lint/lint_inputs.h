// What lint_inputs.comp and lint_specular.comp write: words of a buffer. The first are counts, each a number of pixels or
// of pairs of pixels; samples follow. C++ reads them with `walr::LintCounts` and `walr::lintSamples` (passes/lint).
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

// Albedo left in the lighting: pairs of pixels on one surface, in a row or column, 1, 2, 4, ... kAlbedoFarthest apart,
// by the contrast of their albedo in the channel in which it differs most. Class c holds contrasts from c + 1 to c + 2
// steps, the last class all larger ones.
const uint kLintFollowsAlbedo = 14;  // The light's contrast is nearer to that of albedo than to none.
const uint kLintIgnoresAlbedo = 22;  // The reverse.
const int kAlbedoFarthest = 8;       // Pixels.
const uint kAlbedoContrasts = 8;
const float kAlbedoContrastStep = 0.25;  // Octaves.

// Light with alpha (light_sample.glsl).
const uint kLintSamples = 30;       // Pixels with a sample, whatever its colour.
const uint kLintCountInvalid = 31;  // Texels whose number of samples is NaN, negative or more than halves can hold.

// Surfaces whose light is not 0, and those where it is, by the place of the pixel in squares of 2 x 2: left or right,
// plus 2 if below.
const uint kLintLit = 32;
const uint kLintDark = 36;

// Tiles of 8 x 8 pixels in which one sample is more than kFireflyContrast times as bright as all others together, if
// so many of these have light that the tile is no place where few paths find any.
const uint kLintFireflies = 40;
const float kFireflyContrast = 100.0;
const uint kFireflyNeighbours = 16;

const uint kLintInputWords = 41;  // So many are of lint_inputs.comp, the others of lint_specular.comp.

// Specular light, of surfaces.
const uint kSpecularNotFinite = 41;  // The light, its albedo, roughness or motion; NaN as a distance.
const uint kSpecularNegative = 42;
const uint kSpecularDistanceNegative = 43;
const uint kSpecularRoughnessOutside = 44;  // Of 0 to 1.
// As kLintFollowsAlbedo, of pairs of neighbours of equal roughness, and the albedo of the lobe.
const uint kSpecularFollowsAlbedo = 45;
const uint kSpecularIgnoresAlbedo = 53;

// Dielectrics whose albedo is that of the roughness as it is given, of its square root, and of its square.
const uint kRoughnessReadings = 61;
const uint kRoughnessReadingCount = 3;

const uint kLintMetals = 64;  // Surfaces with specular, but no diffuse albedo; and those of them with light of each lobe.
const uint kLintMetalsDiffuse = 65;
const uint kLintMetalsSpecular = 66;

// Points that mirrors show: on a surface that the picture shows, and in the air before one; by the distance as it is
// given, and by what is left of it if it was measured from the eye.
const uint kReflectedSeen = 67;
const uint kReflectedInAir = 68;
const uint kFromEyeSeen = 69;
const uint kFromEyeInAir = 70;

// Points that mirrors show, where the picture shows them, too, and where they move: as is told, the opposite way, as is
// told if that is in view space, and told to be still.
const uint kReflectedMotions = 71;
const uint kReflectedMotionCount = 4;

const uint kLintSpecularSurfaces = 75;  // Surfaces where specular light is looked at, and those of them that have each of these.
const uint kLintSpecularSampled = 76;   // A distance.
const uint kLintSpecularLit = 77;
const uint kLintSpecularAlbedo = 78;

// Surfaces that reflect another one, by distance; those of them whose distance is 1, as in a mask, or short for their depth.
const uint kSpecularDistances = 79;
const uint kSpecularDistanceOne = 80;
const uint kSpecularDistanceShort = 81;
const float kShortDistance = 0.02;  // Over depth.

const uint kLintCountWords = 82;

// Samples: a pixel of each cell of a grid over the image, another one in each frame.
const uint kLintFirstSample = 256;
const uint kLintColumns = 64;  // Of the grid; no more than the image has.
const uint kLintRows = 36;
const uint kSamplePixel = 0;   // x, and y times 65536.
const uint kSampleDepth = 1;   // Floats, like all that follow.
const uint kSampleAround = 2;  // Depth left, right, above and below; 0 outside the image.
const uint kSampleNormal = 6;
const uint kSampleMotion = 9;  // As the host wrote it.
const uint kLintSampleWords = 12;

const uint kLintWords = kLintFirstSample + kLintColumns * kLintRows * kLintSampleWords;

const float kAlbedoLeast = 0.01;  // The usual guides.albedo-threshold; the linter does not know the method's.

#ifdef __cplusplus
}  // namespace walr
#endif
#endif
