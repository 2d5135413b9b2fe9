#include "samples/sequence/specular_linter.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "integration/include/walr/specular_albedo.h"
#include "passes/lint/lint_inputs.h"
#include "samples/sequence/frame_pixels.h"

namespace walr {
namespace {

/// Whether a pixel has a sample of specular light.
bool isSampled(const Frame& frame, std::size_t i) {
  return frame.specularDistance.empty() || frame.specularDistance.pixel(i)[0] > 0.0F;
}

/// From the camera to a pixel, view space, unit.
glm::vec3 rayThrough(const Frame& frame, std::size_t i) {
  const glm::vec2 size(frame.depth.width(), frame.depth.height());
  const auto width = static_cast<std::size_t>(frame.depth.width());
  const glm::vec2 place = (glm::vec2(i % width, i / width) + 0.5F + frame.camera.jitter) / size;
  const glm::mat4& projection = frame.camera.projection;
  return glm::normalize(glm::vec3((2.0F * place.x - 1.0F + projection[2][0]) / projection[0][0],
                                  (1.0F - 2.0F * place.y + projection[2][1]) / projection[1][1], -1.0F));
}

}  // namespace

void SpecularLinter::add(const Frame& frame) {
  if (frame.specular.empty()) return;
  const auto width = static_cast<std::size_t>(frame.depth.width());
  for (std::size_t i = 0; i < frame.depth.pixelCount(); ++i) {
    if (!isSurface(frame, i)) continue;
    const glm::vec3 light = vectorAt(frame.specular, i);
    const float distance = frame.specularDistance.empty() ? 0.0F : frame.specularDistance.pixel(i)[0];
    const float roughness = frame.roughness.empty() ? 0.0F : frame.roughness.pixel(i)[0];
    const glm::vec3 others(distance, roughness, 0.0F);
    const glm::vec3 motion = frame.specularMotion.empty() ? glm::vec3(0.0F) : vectorAt(frame.specularMotion, i);
    const bool allFinite =
        isFinite(light) && isFinite(vectorAt(frame.specularAlbedo, i)) && isFinite(others) && isFinite(motion);
    notFinite_ += allFinite ? 0 : 1;
    negative_ += std::min({light.x, light.y, light.z}) < 0.0F ? 1 : 0;
    badDistances_ += distance < 0.0F ? 1 : 0;
    badRoughness_ += roughness < 0.0F || roughness > 1.0F ? 1 : 0;
    if (!frame.roughness.empty() && isSampled(frame, i)) {
      if (i % width + 1 < width) addPair(frame, i, i + 1);
      if (i + width < frame.depth.pixelCount()) addPair(frame, i, i + width);
    }
    if (!frame.specularDistance.empty()) addRoughness(frame, i);
    addMetal(frame, i);
  }
}

void SpecularLinter::addPair(const Frame& frame, std::size_t here, std::size_t there) {
  const float depth = frame.depth.pixel(here)[0];
  const glm::vec3 normal = vectorAt(frame.normal, here);
  const glm::vec3 other = vectorAt(frame.normal, there);
  if (!isSampled(frame, there) || !isSurface(frame, there) ||
      std::abs(frame.depth.pixel(there)[0] - depth) > 0.02F * depth ||
      glm::dot(normal, other) < 0.99F * glm::length(normal) * glm::length(other) ||
      std::abs(frame.roughness.pixel(here)[0] - frame.roughness.pixel(there)[0]) > 0.02F) {
    return;
  }
  // Octaves in the channel in which the albedo differs most.
  float ofAlbedo = 0.0F;
  float ofLight = 0.0F;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto octaves = [&](const Image& image) { return std::log2(image.pixel(here)[c] / image.pixel(there)[c]); };
    const float contrast = octaves(frame.specularAlbedo);
    const float shown = octaves(frame.specular);
    if (!std::isfinite(contrast) || !std::isfinite(shown) || std::abs(contrast) <= std::abs(ofAlbedo)) continue;
    ofAlbedo = contrast;
    ofLight = shown;
  }
  constexpr float kLeastContrast = 0.25F;
  if (std::abs(ofAlbedo) < kLeastContrast) return;
  const bool follows = ofLight * std::copysign(1.0F, ofAlbedo) > 0.5F * std::abs(ofAlbedo);
  const double weight = std::abs(ofAlbedo);
  balance_ += follows ? weight : -weight;
  variance_ += weight * weight;
  ++pairs_;
}

void SpecularLinter::addRoughness(const Frame& frame, std::size_t pixel) {
  const glm::vec3 albedo = vectorAt(frame.specularAlbedo, pixel);
  const float roughness = frame.roughness.pixel(pixel)[0];
  const glm::vec3 diffuse = vectorAt(frame.albedo, pixel);
  const bool dielectric =
      albedo.x == albedo.y && albedo.y == albedo.z && std::max({diffuse.x, diffuse.y, diffuse.z}) > 0.01F;
  if (!dielectric || !(roughness > 0.0F && roughness < 1.0F)) return;
  const float cosine = std::abs(glm::dot(vectorAt(frame.normal, pixel), rayThrough(frame, pixel)));
  std::array<float, 3> errors{};
  const std::array readings = {roughness, std::sqrt(roughness), roughness * roughness};
  for (std::size_t i = 0; i < 3; ++i) {
    errors.at(i) = std::abs(walrSpecularAlbedo(0.04F, readings.at(i), std::min(cosine, 1.0F)) / albedo.x - 1.0F);
  }
  const auto best = std::ranges::min_element(errors);
  // Beyond the error of the formula and of halves; the others must be clearly farther away.
  constexpr float kFits = 0.08F;
  const auto others = std::ranges::count_if(errors, [&](float error) { return error < *best + kFits; });
  if (*best < kFits && others == 1) ++encodings_.at(static_cast<std::size_t>(best - errors.begin()));
}

void SpecularLinter::addMetal(const Frame& frame, std::size_t pixel) {
  const auto most = [&](const Image& image) {
    const glm::vec3 v = image.empty() ? glm::vec3(0.0F) : vectorAt(image, pixel);
    return std::max({v.x, v.y, v.z});
  };
  constexpr float kBlack = 0.01F;
  constexpr float kMetallic = 0.1F;  // Above dielectrics, which are near .04 unless seen at grazing angles.
  if (!(most(frame.albedo) < kBlack && most(frame.specularAlbedo) > kMetallic)) return;
  ++metals_.all;
  metals_.diffuse += most(frame.indirect) > 0.0F || most(frame.direct) > 0.0F ? 1 : 0;
  metals_.specular += most(frame.specular) > 0.0F ? 1 : 0;
}

std::vector<LintFinding> SpecularLinter::findings() const {
  std::vector<LintFinding> found;
  const auto count = [&](std::uint64_t pixels, std::string_view name, const char* what, std::string_view cause,
                         std::string_view wayOut) {
    if (pixels > 0) found.push_back({name, what + std::to_string(pixels) + " pixels of surfaces", cause, wayOut});
  };
  count(notFinite_, "specular-not-finite",
        "specular light, its albedo, its distance or roughness is NaN or infinite on ",
        "a division by an albedo or a probability of 0, or an infinite distance",
        "divide by walrSpecularAlbedo, which is at least .02; write 1e10 where the reflected ray met nothing");
  count(negative_, "specular-negative", "specular light is below 0 on ",
        "a lossy compression, or a light that was subtracted",
        "write the light that the lobe reflects, which is not negative");
  count(badDistances_, "specular-distance", "the distance to the first hit is negative on ",
        "a miss is marked by a negative number",
        "write 1e10 where the reflected ray met nothing, and 0 where there was no sample");
  count(badRoughness_, "roughness-range", "roughness is not from 0 to 1 on ", "glossiness in percent, or an exponent",
        "write linear roughness as in glTF, 0 to 1");
  const std::uint64_t encoded = encodings_[0] + encodings_[1] + encodings_[2];
  for (const auto& [index, text] : {std::pair{1, "squared (alpha)"}, std::pair{2, "a square root"}}) {
    const std::uint64_t fit = encodings_.at(static_cast<std::size_t>(index));
    if (encoded < kLeastLintSample || 4 * fit < 3 * encoded) continue;
    found.push_back(
        {"roughness-encoding",
         "roughness is " + std::string(text) + " by the albedo of " + share(fit, encoded, "pixels of dielectrics"),
         "another convention of roughness", "write linear roughness as in glTF, whose square is GGX's alpha"});
  }
  if (metals_.all >= kLeastLintSample && 2 * metals_.diffuse > metals_.all && metals_.diffuse > 4 * metals_.specular) {
    found.push_back({"lobes-swapped",
                     share(metals_.diffuse, metals_.all, "pixels without a diffuse albedo have diffuse light, and ") +
                         std::to_string(metals_.specular) + " have specular light",
                     "diffuse and specular light were written to each other's channels", "swap them"});
  }
  constexpr double kStandardErrors = 4.0;  // See `LintJudge::judgeAlbedo`.
  if (pairs_ >= kLeastLintSample && balance_ >= kStandardErrors * std::sqrt(variance_)) {
    found.push_back({"specular-albedo-in-light",
                     "the contrast of specular light is nearer to that of its albedo than to none, over " +
                         std::to_string(pairs_) + " pairs of pixels on one surface whose specular albedo differs",
                     "specular light was not divided by its albedo",
                     "divide it by walrSpecularAlbedo (walr/specular_albedo.h)"});
  }
  return found;
}

}  // namespace walr
