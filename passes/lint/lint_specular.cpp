// Specular light, and what is said of the things it reflects.
#include "passes/lint/lint_specular.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "passes/lint/lint_judge.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

constexpr std::string_view kDistanceWayOut =
    "write the distance from the surface to the first hit of the specular path, scene units";

}  // namespace

fg::Buffer addLintSpecular(fg::Graph& graph, const LintSpecularInputs& from, fg::Buffer counters) {
  const DenoiserInputs& inputs = from.inputs;
  const bool motionHasDepth = inputs.conventions.motionDepth == InputConventions::MotionDepth::Given;
  fg::PassBuilder pass = lintPass(graph, "lint specular light", shaders::lintSpecular, inputs);
  pass.sample("specularAlbedo", inputs.specularAlbedo);
  const auto sampleIfPresent = [&](std::string_view constant, std::string_view binding, fg::Texture texture,
                                   bool wanted) {
    const bool present = texture.valid() && wanted;
    pass.specialize(constant, present).sampleIf(present, binding, texture, inputs.depth);
  };
  sampleIfPresent("kRoughness", "roughness", inputs.roughness, true);
  sampleIfPresent("kMotion", "specularMotion", inputs.specularMotion, motionHasDepth);
  sampleIfPresent("kDiffuseAlbedo", "albedo", inputs.albedo, true);
  sampleIfPresent("kDiffuseLight", "diffuse", from.diffuse, true);
  pass.specialize("kDistance", from.distances)
      .specialize("kOwnAlbedo", from.ownAlbedo)
      .specialize("kNormalsInWorldSpace", inputs.conventions.normal == InputConventions::Space::World)
      .specialize("kMotionJittered", inputs.conventions.motionJittered);
  return pass.update("counters", counters);
}

void LintJudge::judgeSpecularValues() {
  const auto count = [&](std::uint32_t word, std::string_view name, const char* what, std::string_view cause,
                         std::string_view wayOut) {
    if (counts_[word] > 0) add({name, what + std::to_string(counts_[word]) + " pixels of surfaces", cause, wayOut});
  };
  if (!has("lighting-not-finite")) {
    count(kSpecularNotFinite, "specular-not-finite",
          "specular light, its albedo, its distance, its motion or roughness is NaN or infinite on ",
          "a division by an albedo or a probability of 0",
          "divide by walrSpecularAlbedo, which is at least .02; write 1e10 where the reflected ray met nothing");
  }
  if (!has("lighting-negative")) {
    count(kSpecularNegative, "specular-negative", "specular light is below 0 on ",
          "a lossy compression, or a light that was subtracted",
          "write the light that the lobe reflects, which is not negative");
  }
  count(kSpecularDistanceNegative, "specular-distance", "the distance to the first hit is negative on ",
        "a miss is marked by a negative number",
        "write 1e10 where the reflected ray met nothing, and 0 where there was no sample");
  count(kSpecularRoughnessOutside, "roughness-range", "roughness is not from 0 to 1 on ",
        "glossiness in percent, or an exponent", "write linear roughness as in glTF, 0 to 1");
  judgeSpecularPresence();
  judgeSpecularDistances();
}

void LintJudge::judgeSpecularPresence() {
  const std::uint64_t surfaces = counts_[kLintSpecularSurfaces];
  if (surfaces < kLeastLintSample) return;
  const bool sampled = counts_[kLintSpecularSampled] > 0;
  if (!sampled && !has("lighting-empty")) {
    add({"specular-empty", "no pixel with a surface has a distance to what it reflects above 0",
         "the alpha of specular light was not written",
         "write the distance from the surface to what it reflects, 1e10 where the reflected ray met nothing"});
  }
  if (sampled && counts_[kLintSpecularLit] == 0 && !has("lighting-zero")) {
    add({"specular-zero", "specular light is 0 on all " + std::to_string(surfaces) + " pixels with a surface",
         "its image was not written, or is another one",
         "write the light before the denoiser runs, or leave specular light out where a scene has none"});
  }
  if (counts_[kLintSpecularAlbedo] == 0 && !has("albedo-empty")) {
    add({"specular-albedo-empty", "the specular albedo is 0 on all pixels with a surface",
         "its image was not written, or is another one",
         "write walrSpecularAlbedo: without it, a pixel passes through with its noise"});
  }
}

void LintJudge::judgeSpecularDistances() {
  const std::uint64_t all = counts_[kSpecularDistances];
  const auto isNearlyAll = [&](std::uint64_t part) { return all >= kLeastLintSample && 20 * part > 19 * all; };
  if (const std::uint64_t ones = counts_[kSpecularDistanceOne]; isNearlyAll(ones)) {
    add({"specular-distance-mask",
         "the distance to what is reflected is 1 on " + share(ones, all, "pixels that reflect a surface"),
         "the alpha of specular light is a mask, or was not written", kDistanceWayOut});
  } else if (const std::uint64_t shorts = counts_[kSpecularDistanceShort]; isNearlyAll(shorts)) {
    add({"specular-distance-short",
         "the distance to what is reflected is less than a fiftieth of depth on " +
             share(shorts, all, "pixels that reflect a surface"),
         "the distance is in larger units than depth", kDistanceWayOut});
  }
}

void LintJudge::judgeLobes() {
  std::uint64_t encoded = 0;
  for (std::uint32_t i = 0; i < kRoughnessReadingCount; ++i) encoded += counts_[kRoughnessReadings + i];
  constexpr std::array<const char*, kRoughnessReadingCount> kEncodings{nullptr, "squared (alpha)", "a square root"};
  for (std::uint32_t i = 1; i < kRoughnessReadingCount; ++i) {
    const std::uint64_t fit = counts_[kRoughnessReadings + i];
    if (encoded < kLeastLintSample || 4 * fit < 3 * encoded) continue;
    add({"roughness-encoding",
         "roughness is " + std::string(kEncodings.at(i)) + " by the albedo of " +
             share(fit, encoded, "pixels of dielectrics"),
         "another convention of roughness", "write linear roughness as in glTF, whose square is GGX's alpha"});
  }
  const std::uint64_t metals = counts_[kLintMetals];
  const std::uint64_t diffuse = counts_[kLintMetalsDiffuse];
  const std::uint64_t specular = counts_[kLintMetalsSpecular];
  if (isMost(diffuse, metals) && diffuse > 4 * specular) {
    add({"lobes-swapped",
         share(diffuse, metals, "pixels without a diffuse albedo have diffuse light, and ") + std::to_string(specular) +
             " have specular light",
         "diffuse and specular light were written to each other's channels", "swap them"});
  }
  const AlbedoPairs pairs = albedoPairs(counts_, kSpecularFollowsAlbedo, kSpecularIgnoresAlbedo);
  if (pairs.holdAlbedo()) {
    add({"specular-albedo-in-light",
         "the contrast of specular light is nearer to that of its albedo than to none on " +
             share(pairs.follow, pairs.all, "pairs of pixels on one surface whose specular albedo differs"),
         "specular light was not divided by its albedo", "divide it by walrSpecularAlbedo (walr/specular_albedo.h)"});
  }
}

void LintJudge::judgeReflectedDistance() {
  if (has("specular-distance-mask") || has("specular-distance-short")) return;
  const std::uint64_t given = counts_[kReflectedSeen] + counts_[kReflectedInAir];
  const std::uint64_t left = counts_[kFromEyeSeen] + counts_[kFromEyeInAir];
  // Points too far away lie behind what the picture shows, and say nothing.
  const bool fromEye = !isMost(counts_[kFromEyeInAir], left) &&
                       isMost(counts_[kFromEyeSeen], counts_[kFromEyeSeen] + counts_[kReflectedInAir]);
  if (!fromEye && !isMost(counts_[kReflectedInAir], given)) return;
  add({"specular-distance-of-another-ray",
       fromEye ? share(counts_[kFromEyeSeen], left,
                       "points that mirrors show lie on a surface if the distance begins at the eye")
               : share(counts_[kReflectedInAir], given,
                       "points that mirrors show are in the air, where the picture shows no surface"),
       fromEye ? "the distance was measured from the eye"
               : "the distance is that of another ray, such as the diffuse one, or in other units",
       kDistanceWayOut});
}

void LintJudge::judgeReflectedMotion() {
  struct Mistake {
    std::string_view name;
    const char* text;
    std::string_view cause;
  };
  constexpr std::array<Mistake, kReflectedMotionCount> kMistakes{
      {{},
       {"specular-motion-sign", " move the opposite way", "it is this frame's position minus the previous one's"},
       {"specular-motion-space", " move so in view space", "it was turned into view space"},
       {"specular-motion-missing", " move, and are told to be still",
        "the motion of what a ray hits was not written where it moves"}}};
  // Few mirrors show what moves, but a wrong convention is wrong in all of them.
  constexpr std::uint64_t kLeast = 20;
  std::uint64_t all = 0;
  for (std::uint32_t i = 0; i < kReflectedMotionCount; ++i) all += counts_[kReflectedMotions + i];
  for (std::uint32_t i = 1; i < kReflectedMotionCount; ++i) {
    const std::uint64_t part = counts_[kReflectedMotions + i];
    if (all < kLeast || 10 * part < 9 * all) continue;
    add({kMistakes.at(i).name,
         "by the motion of the same surfaces where they are seen directly, " +
             share(part, all, "points that mirrors show") + kMistakes.at(i).text,
         kMistakes.at(i).cause,
         "write where the first hit of the specular path was in the previous frame, minus where it is, in world "
         "space"});
  }
}

}  // namespace walr
