// Values that no convention explains: not finite, out of range, or not written.
#include <array>
#include <cstdio>

#include "passes/lint/lint_judge.h"

namespace walr {

std::string share(std::uint64_t part, std::uint64_t whole, const std::string& of) {
  std::array<char, 32> percent{};
  std::snprintf(percent.data(), percent.size(), "%.1f %%", 100.0 * double(part) / double(whole));
  return std::string(percent.data()) + " of " + std::to_string(whole) + " " + of;
}

void LintJudge::judgeOrigin() {
  const std::uint64_t surfaces = motion_.surfaces();
  const std::uint64_t rounded = motion_.rounded();
  if (!isMost(rounded, surfaces)) return;
  add({"origin-far",
       "the camera is so far from the origin that the rounding of its view matrix may move a surface by more than a "
       "tenth of a pixel, on " +
           share(rounded, surfaces, "surfaces"),
       "the view matrix holds a position in a large world, in single precision",
       "make the matrices relative to an origin near the camera, and hand over the origin (WalrFrame::origin, "
       "FrameDescription::origin)"});
}

void LintJudge::judgeDepth() {
  const std::uint64_t pixels = counts_[kLintPixels];
  const std::size_t before = found_.size();
  if (isMany(counts_[kLintDepthNegative], pixels)) {
    add({"depth-sign", "depth is negative on " + share(counts_[kLintDepthNegative], pixels, "pixels"),
         "z of view space, which is negative in front of the camera, is handed over as distance",
         "state negative depth (WALR_DEPTH_NEGATIVE_LINEAR), or negate it"});
  }
  if (isMany(counts_[kLintDepthZero], pixels) && counts_[kLintSurfaces] == 0) {
    add({"depth-empty", "depth is 0 on " + share(counts_[kLintDepthZero], pixels, "pixels") + " and nowhere a surface",
         "the depth image was not written, or is another one", "write depth before the denoiser runs"});
  }
  // Of right depth, up to 5 % lie between: far leaves that are smaller than pixels. Of filtered depth 40 % and more do.
  if (edges_.edges() >= kLeastLintSample && 5 * edges_.between() > edges_.edges()) {
    add({"depth-filtered",
         "depth lies between that of both sides on " + share(edges_.between(), edges_.edges(), "edges of surfaces"),
         "a pixel filter, anti-aliasing or a resampling mixed the depths of several surfaces, or of a surface and the "
         "sky",
         "write the depth of one sample of the pixel, and let no filter change it"});
  }
  if (pixels > 0 && counts_[kLintSurfaces] == 0 && found_.size() == before) {
    add({"sky-only", "no pixel shows a surface: all depths are from the sky depth on, or not finite",
         "depth is in other units than the sky depth", "state a sky depth beyond the scene's farthest surface"});
  }
}

void LintJudge::judgeValues() {
  struct Rule {
    std::uint32_t word;
    std::uint32_t of;
    bool any;  ///< One pixel is too many.
    std::string_view name;
    const char* what;
    std::string_view cause;
    std::string_view wayOut;
  };
  static constexpr std::string_view kDivision = "a division by zero, or a variable that is not set on some path";
  static constexpr std::array kRules{
      Rule{kLintLightingNotFinite, kLintPixels, true, "lighting-not-finite", "lighting is NaN or infinite on ",
           "a division by an albedo or a probability of 0, or radiance beyond what halves hold",
           "write 0 there; the denoiser replaces such values, at the cost of what they would have told"},
      Rule{kLintDepthNotFinite, kLintPixels, true, "depth-not-finite", "depth is NaN on ", kDivision,
           "write a depth beyond the sky depth where there is no surface"},
      Rule{kLintNormalNotFinite, kLintSurfaces, true, "normal-not-finite", "normals are NaN or infinite on ",
           "a vector of length 0 was normalised", "write the geometric normal there, or zero on sky"},
      Rule{kLintMotionNotFinite, kLintSurfaces, true, "motion-not-finite", "motion is NaN or infinite on ",
           "a division by the w of what was behind the camera in the last frame",
           "write any motion that leads out of the picture"},
      Rule{kLintAlbedoNotFinite, kLintSurfaces, true, "albedo-not-finite", "albedo is NaN or infinite on ", kDivision,
           "write 0 on surfaces without the light's lobe"},
      Rule{kLintLightingNegative, kLintPixels, false, "lighting-negative", "lighting is negative on ",
           "a reconstruction filter with negative lobes, or a subtraction of direct from full light",
           "hand over the light as it was sampled"},
      Rule{kLintCountInvalid, kLintPixels, true, "lighting-count-range",
           "the number of samples in the lighting's alpha is NaN, negative or above 65504 on ",
           "a division by 0, or alpha that was not written on some path",
           "write the number of samples whose mean the texel is, 0 where there is none: NaN and negative numbers count "
           "as 0"},
      Rule{kLintNormalNotUnit, kLintSurfaces, false, "normal-not-unit", "normals are not of length 1 on ",
           "normals in 0..1 stated as -1..1, or interpolated and not normalised",
           "state how normals are written (WalrConventions::normals), or normalise them"},
      Rule{kLintAlbedoOutside, kLintSurfaces, false, "albedo-range", "albedo is below 0 or above 1 on ",
           "radiance or a lit colour is handed over as albedo",
           "hand over the share of light that the surface reflects"},
  };
  for (const Rule& rule : kRules) {
    const std::uint64_t count = counts_[rule.word];
    const std::uint64_t whole = counts_[rule.of];
    if (rule.any ? count == 0 : !isMany(count, whole)) continue;
    const std::string of = rule.of == kLintPixels ? "pixels" : "pixels with a surface";
    add({rule.name, rule.what + share(count, whole, of), rule.cause, rule.wayOut});
  }
  // A highlight of specular light may be a single pixel.
  if (counts_[kLintFireflies] > 0 && !conventions_.specular) {
    add({"fireflies",
         "in " + std::to_string(counts_[kLintFireflies]) +
             " tiles of 8 x 8 pixels one sample is more than a hundred times as bright as all others together",
         "paths that find a small bright light by chance, or a division by the small probability of a path",
         "sample such lights directly, or bound what a path may bring; methods with antilag hold such samples back "
         "(accumulation.fireflies)"});
  }
  const LightPattern samples = conventions_.samples();
  const bool noSamples = samples.hasAlpha() && counts_[kLintPixels] > 0 && counts_[kLintSamples] == 0;
  if (noSamples) {
    add({"lighting-empty", "no texel of the lighting has an alpha above 0", "the lighting's alpha was not written",
         conventions_.specular
             ? "write the distance from the surface to what it reflects, 1e10 where the reflected ray met nothing"
             : "write 1, or the number of samples, where there is one, or do not state that the lighting has alpha "
               "(WalrConventions::light_masked and light_counted)"});
  }
  if (samples.everyPixel() && counts_.litFrames() > 0 && 2 * counts_.halfLitFrames() > counts_.litFrames()) {
    add({"lighting-half-empty",
         "every second pixel, column or row has no light in " + std::to_string(counts_.halfLitFrames()) + " of " +
             std::to_string(counts_.litFrames()) + " frames with light",
         "the light is sampled on a checkerboard or in every second column or row, and the other pixels hold 0",
         "state which pixels have a sample (lightGroup of a sequence, WalrConventions::light_group), or mark them in "
         "alpha (light_masked)"});
  }
  const std::uint64_t surfaces = counts_[kLintSurfaces];
  if (!noSamples && surfaces >= kLeastLintSample && counts_.litPixels() == 0) {
    add({"lighting-zero", "the lighting is 0 on all " + std::to_string(surfaces) + " pixels with a surface",
         "the lighting image was not written, or is another one, or the scene has none: a lone object "
         "receives no indirect light",
         "write the light before the denoiser runs, or hand over direct light"});
  }
  if (isMost(counts_[kLintNormalZero], surfaces)) {
    add({"normal-empty", "normals are zero on " + share(counts_[kLintNormalZero], surfaces, "pixels with a surface"),
         "the normal image was not written, or is another one",
         "write normals before the denoiser runs: without one a pixel passes through with its noise"});
  }
  if (surfaces >= kLeastLintSample && counts_[kLintDiffuse] == 0) {
    add({"albedo-empty", "no pixel has an albedo of 0.01 or more",
         "the image of the albedo by which the light was divided was not written, or is another one",
         "write that albedo: with guides.albedo-threshold above 0, a pixel without it passes through with its "
         "noise"});
  }
}

}  // namespace walr
