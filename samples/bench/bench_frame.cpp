#include "samples/bench/bench_frame.h"

#include <algorithm>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "samples/denoise/report.h"
#include "samples/metrics/metrics.h"

namespace walr {
namespace {

/// Change of depth of a static surface point: depth in the previous frame minus depth in this one.
float depthChangeOfStill(const Frame& frame, int x, int y) {
  const Camera& camera = frame.camera;
  const float depth = frame.depth.at(x, y, 0);
  const glm::vec2 position = glm::vec2(x + 0.5F, y + 0.5F) + camera.jitter;
  const glm::vec2 ndc = {2.0F * position.x / static_cast<float>(frame.depth.width()) - 1.0F,
                         1.0F - 2.0F * position.y / static_cast<float>(frame.depth.height())};
  const glm::mat4& projection = camera.projection;
  const glm::vec4 view = {(ndc.x + projection[2][0]) * depth / projection[0][0],
                          (ndc.y + projection[2][1]) * depth / projection[1][1], -depth, 1.0F};
  return -(camera.previousView * (glm::inverse(camera.view) * view)).z - depth;
}

/// @param albedo of the lobe that reflects the light
VisibleSurfaces visibleSurfaces(const Frame& frame, const Image& albedo, const Layout& layout) {
  VisibleSurfaces surfaces{frame.depth, frame.normal, frame.motion,
                           diffuseMask(albedo, frame.normal, frame.depth, kSkyDepth)};
  const glm::mat3 toWorld = glm::transpose(glm::mat3(frame.camera.view));
  const bool inView = layout.conventions.normal == InputConventions::Space::View;
  const bool still = layout.conventions.motionDepth == InputConventions::MotionDepth::StaticScene;
  for (int y = 0; y < frame.depth.height(); ++y) {
    for (int x = 0; x < frame.depth.width(); ++x) {
      if (inView) {
        const glm::vec3 normal =
            toWorld * glm::vec3(frame.normal.at(x, y, 0), frame.normal.at(x, y, 1), frame.normal.at(x, y, 2));
        for (int c = 0; c < 3; ++c) surfaces.normal.at(x, y, c) = normal[c];
      }
      surfaces.motion.at(x, y, 0) *= layout.motionScale.x;
      surfaces.motion.at(x, y, 1) *= layout.motionScale.y;
      if (still) surfaces.motion.at(x, y, 2) = depthChangeOfStill(frame, x, y);
    }
  }
  return surfaces;
}

}  // namespace

Light judgedLight(const Sequence& sequence) {
  return sequence.denoiserLayout().conventions.specular ? Light::Specular : Light::Indirect;
}

BenchFrame readBenchFrame(const Sequence& sequence, std::size_t index) {
  BenchFrame result;
  result.light = judgedLight(sequence);
  result.packed = packFrame(sequence.read(index), result.light);
  const Frame& frame = result.frame();
  const Image& albedo = result.specular() ? frame.specularAlbedo : frame.albedo;
  result.surfaces = visibleSurfaces(frame, albedo, *sequence.layout().layout);
  result.judged = frame.reference ? diffuseMask(albedo, frame.normal, frame.depth, kSkyDepth, result.reference())
                                  : result.surfaces.mask;
  return result;
}

std::vector<std::uint32_t> judgedPairs(std::vector<std::uint32_t> previousPixels, const PixelMask& judged,
                                       const PixelMask& previousJudged) {
  for (std::size_t i = 0; i < previousPixels.size(); ++i) {
    std::uint32_t& previous = previousPixels[i];
    if (previous != kNoPixel && (judged[i] == 0 || previousJudged[previous] == 0)) previous = kNoPixel;
  }
  return previousPixels;
}

std::vector<FrameFacts> survey(const Sequence& sequence) {
  std::vector<FrameFacts> facts;
  BenchFrame previous;
  for (std::size_t i = 0; i < sequence.entries().size(); ++i) {
    BenchFrame frame = readBenchFrame(sequence, i);
    const PixelMask& mask = frame.judged;
    FrameFacts fact;
    fact.number = frame.packed.frame.number;
    fact.resetHistory = frame.packed.frame.resetHistory;
    fact.hasReference = frame.packed.frame.reference.has_value();
    if (!fact.resetHistory) {
      fact.disoccluded =
          disoccludedShare(judgedPairs(previousPixels(frame.surfaces, previous.surfaces), mask, previous.judged), mask);
    }
    if (fact.hasReference && !frame.referenceHalf().empty()) {
      const auto noiseOf = [&](const PixelMask& pixels) {
        return referenceNoise(frame.reference(), frame.referenceHalf(), pixels);
      };
      fact.referenceNoise = noiseOf(mask);
      if (frame.specular()) fact.noiseByRoughness = figuresByRoughness(mask, frame.frame().roughness, noiseOf);
    }
    previous = std::move(frame);
    facts.push_back(fact);
  }
  return facts;
}

std::vector<int> pictureFrames(const std::vector<FrameFacts>& facts) {
  std::vector<FrameFacts> candidates;
  for (std::size_t i = 0; i < facts.size(); ++i) {
    if (facts[i].hasReference) candidates.push_back(facts[i]);
    if (i < kWarmUpFrames && !candidates.empty()) candidates.back().disoccluded.reset();
  }
  const int last = candidates.back().number;
  candidates.pop_back();
  const auto hardest =
      std::ranges::max_element(candidates, {}, [](const FrameFacts& fact) { return fact.disoccluded.value_or(0.0); });
  if (hardest == candidates.end() || hardest->disoccluded.value_or(0.0) == 0.0) return {last};
  return {hardest->number, last};
}

std::vector<int> judgedFrames(const std::vector<FrameFacts>& facts) {
  std::vector<int> frames;
  for (const FrameFacts& fact : facts) {
    if (fact.hasReference) frames.push_back(fact.number);
  }
  return frames;
}

}  // namespace walr
