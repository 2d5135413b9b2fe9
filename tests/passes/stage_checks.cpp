#include "tests/passes/stage_checks.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "tests/passes/comparison.h"
#include "tests/passes/reference/antilag.h"
#include "tests/passes/reference/octahedral.h"
#include "tests/passes/reference/walr.h"

namespace walr::test {
namespace {

using reference::AtrousState;
using reference::Guide;
using reference::HostFrame;
using reference::Image;

/// Whether two octahedral features are those of one direction to within `error` radians and a step of their format in
/// [0, 1]. A rotation by `error` moves a feature by at most 1.4 `error`, because the map's derivative is at most (1 +
/// sqrt(3)) / 2. On the seams of the far side, where the map jumps, directions are compared instead.
bool sameDirection(glm::dvec3 actual, glm::dvec3 expected, double error, double step) {
  const glm::dvec2 difference = glm::abs(reference::octahedralEncode(actual) - reference::octahedralEncode(expected));
  const double tolerance = 1.4 * error + step;
  const bool near = std::max(difference.x, difference.y) <= tolerance;
  return near || glm::length(actual - expected) <= error + std::sqrt(18.0) * step;
}

/// Whether a short normal is one that a direction rounds to, known to `error` radians. A rotation by `error` moves a
/// point e of the stereographic projection by (1 + e . e) / 2 times that, and by less than twice this where `error` is
/// small. Points beyond the format's end become points of its border.
bool isShortNormalOf(glm::dvec3 actual, glm::dvec3 expected, double error) {
  constexpr double kEnd = reference::kShortNormalEnd;
  const glm::dvec2 point = reference::stereographicEncode(expected);
  const glm::dvec2 difference = glm::abs(reference::stereographicEncode(actual) - glm::clamp(point, -kEnd, kEnd));
  const double tolerance = 0.5 * reference::kShortNormalStep + (1.0 + glm::dot(point, point)) * error + 1e-6;
  return std::max(difference.x, difference.y) <= tolerance;
}

void expectGuides(const DeviceFrame& f, const AnyWalr& walr) {
  const PrepareGuidesSettings& settings = walr.guides();
  const bool occludes = walr.blocks() != nullptr;
  const double shadingStep = occludes ? reference::kUnorm12Step : reference::kUnorm16Step;
  constexpr double kShadingError = 16.0 * reference::kFloatRoundoff;
  Comparison comparison("guides");
  reference::forEachPixel(f.frame.size(), [&](glm::ivec2 p) {
    const Guide& actual = f.current.guides[p];
    reference::Surface surface = reference::surfaceAt(f.frame, p, settings);
    comparison.compared();
    const double depth =
        occludes ? reference::roundDepthBesideNormal(surface.depth) : reference::roundDepth(surface.depth);
    comparison.value(p, "depth", actual.depth, depth, 1e-30);
    if (surface.depth == 0.0) return;
    const glm::dvec3 shading = reference::octahedralDecode(actual.features);
    // Rounding decides which way a normal perpendicular to the ray is turned.
    const glm::dvec3 ray = reference::rayThrough(f.frame.constants.rayFromPixel, reference::pixelCentre(p));
    const bool edgeOn = std::abs(glm::dot(surface.shadingNormal, ray)) <= kShadingError * glm::length(ray);
    if (edgeOn && glm::dot(surface.shadingNormal, shading) < 0.0) surface.shadingNormal = -surface.shadingNormal;
    comparison.value(p, "shading normal",
                     sameDirection(shading, surface.shadingNormal, kShadingError, shadingStep) ? 0.0 : 1.0, 0.0, 0.5);
    if (occludes) {
      // The result is rounded to nearest. It comes from a difference of two positions, each rounded a few times, over
      // their distance, which is at least a pixel.
      const double pixel = std::abs(double(f.frame.constants.rayFromPixel.x));
      comparison.value(p, "occlusion", actual.occlusion,
                       reference::ambientOcclusion(f.frame, p, surface, walr.blocks()->occlusion),
                       0.5 * reference::kUnorm8Step + 16.0 * reference::kFloatRoundoff / pixel);
    }
    if (actual.normal == glm::dvec3(0.0)) return;  // These settings do not use it.
    bool found = false;
    for (const auto& candidate : reference::geometricNormals(f.frame, p, surface, settings))
      found |= occludes ? isShortNormalOf(actual.normal, candidate.normal, candidate.error)
                        : sameDirection(actual.normal, candidate.normal, candidate.error, reference::kUnorm16Step);
    comparison.value(p, "geometric normal", found ? 0.0 : 1.0, 0.0, 0.5);
  });
  comparison.expect(0.0);
}

void expectAntilag(const DeviceFrame& f, const Image<reference::Accumulated>& accumulated,
                   const AntilagSettings& settings) {
  const Image<reference::TileChange> tiles = reference::changeByTiles(accumulated);
  const Image<reference::Bounded> antilag = reference::antilagOf(f.current.antilagTiles, settings);
  ASSERT_EQ(f.current.antilagTiles.size(), tiles.size());
  Comparison comparison("antilag");
  reference::forEachPixel(tiles.size(), [&](glm::ivec2 t) {
    comparison.value(t, "antilag", f.current.antilag[t], antilag[t].value, antilag[t].error);
    if (comparison.skips(tiles[t].undecided)) return;
    const reference::TileChange& e = tiles[t];
    comparison.value(t, "sum", f.current.antilagTiles[t].x, e.sum.value, e.sum.error);
    comparison.value(t, "sum of squares", f.current.antilagTiles[t].y, e.squares.value, e.squares.error);
  });
  // A tile is undecided if any of its 64 pixels is.
  comparison.expect(0.5);
}

/// Stochastic rounding errs by less than a step. Light that is too bright to be packed becomes the brightest packed
/// light.
glm::dvec3 packedTolerance(const reference::Accumulated& e, int mantissaBits) {
  const glm::dvec3 most = e.mean + e.error;
  const double step = reference::packedStep(std::max({most.r, most.g, most.b}), mantissaBits);
  const double largest = reference::largestPacked(mantissaBits);
  return e.error + glm::max(glm::dvec3(step), e.mean - largest);
}

void expectAccumulation(const DeviceFrame& f, const TemporalAccumulationSettings& settings, bool keepTaps) {
  const Image<reference::Accumulated> expected =
      reference::accumulate(f.frame, f.current.guides, {f.previous.guides, f.previous.accumulated, f.previous.antilag},
                            reference::Storage::Exact, settings, keepTaps, f.current.onLightGrid);
  const bool packed = settings.storage == LightStorage::Packed;
  Comparison comparison("temporal accumulation");
  reference::forEachPixel(f.frame.size(), [&](glm::ivec2 p) {
    const reference::Accumulated& e = expected[p];
    if (comparison.skips(e.undecided)) return;
    const glm::dvec3 tolerance =
        packed ? packedTolerance(e, reference::kAccumulatedBits) : halfTolerance(e.mean, e.error);
    comparison.colour(p, f.current.accumulated[p], e.mean, tolerance);
    const double samplesTolerance = packed ? reference::packedCountStep(e.samples + e.samplesError) + e.samplesError
                                           : halfTolerance(e.samples, e.samplesError);
    comparison.value(p, "samples", f.current.accumulated[p].w, e.samples, samplesTolerance);
  });
  comparison.expect(kUndecidedShare);
  if (settings.antilag.enabled) expectAntilag(f, expected, settings.antilag);
}

/// The device's state before iteration `t`. Pixels without a surface have no moments; whatever their texels hold is
/// dropped.
AtrousState stateBefore(const test::WalrStages& stages, std::uint32_t t) {
  if (t == 0) return reference::sampleMoments(stages.guides, stages.accumulated);
  AtrousState state = stages.iterations[t - 1];
  for (std::size_t i = 0; i < state.moments.pixels().size(); ++i)
    if (stages.guides.pixels()[i].depth == 0.0) state.moments.pixels()[i] = {};
  return state;
}

void expectIterations(const DeviceFrame& f, const WeightedRegressionSettings& settings) {
  for (std::uint32_t t = 0; t + 1 < settings.iterations; ++t) {
    const AtrousState before = stateBefore(f.current, t);
    const AtrousState& after = f.current.iterations[t];
    Comparison comparison("a-trous iteration " + std::to_string(t));
    reference::forEachPixel(f.frame.size(), [&](glm::ivec2 p) {
      if (f.current.guides[p].depth == 0.0) return;
      reference::AtrousPixel expected = reference::atrousPixel(f.frame, f.current.guides, before, p, t, settings);
      if (comparison.skips(expected.undecided)) return;
      if (!settings.keepSampleCount) {
        double& samples = expected.merged.moments.samples;
        samples = samples > 0.0 ? 1.0 : 0.0;
        expected.merged.error[15] = 0.0;
      }
      if (expected.merged.moments.samples == 0.0) expected.merged = {};
      const StoredMoments stored = storedMoments(expected.merged, settings.storage);
      const reference::MomentValues actual = storedValues(after.moments[p], settings.storage);
      const int count = settings.storage == MomentStorage::Centred16 ? reference::kMomentCount : 14;
      for (int k = 0; k < count; ++k)
        comparison.value(p, reference::momentName(k), actual[k], stored.expected[k], stored.tolerance[k]);
      comparison.value(p, "edge distance", after.distances[p], std::min(expected.nearestEdge, 31), 0.5);
    });
    comparison.expect(kUndecidedShare);
  }
}

void expectRegression(const DeviceFrame& f, const WeightedRegressionSettings& settings) {
  const std::uint32_t last = settings.iterations - 1;
  const AtrousState before = stateBefore(f.current, last);
  const RegularisationSettings regularisation = reference::regularisationOf(settings, last);
  Comparison comparison("last iteration and regression");
  reference::forEachPixel(f.frame.size(), [&](glm::ivec2 p) {
    if (f.current.guides[p].depth == 0.0) {
      EXPECT_EQ(glm::dvec3(f.current.filtered[p]), glm::dvec3(f.current.accumulated[p]));
      return;
    }
    const auto [merged, edge, replaced, lost, undecided] =
        reference::atrousPixel(f.frame, f.current.guides, before, p, last, settings);
    if (comparison.skips(undecided)) return;
    const double known = merged.moments.samples > 0.0 ? 1.0 : -1.0;
    comparison.value(p, "whether light is known", f.current.filtered[p].w, known, 0.0);
    const reference::Reconstruction expected =
        reference::reconstruct(merged.moments, f.current.guides[p].features, regularisation, merged.error);
    comparison.colour(p, f.current.filtered[p], expected.colour, halfTolerance(expected.colour, expected.error));
  });
  comparison.expect(kUndecidedShare);
}

/// The output of a pixel without a surface: the input unchanged, or packed where it travels in the texels of the
/// history taps.
void expectPassThrough(glm::dvec3 output, glm::dvec3 lighting, bool keptTaps) {
  const glm::dvec3 light = std::isfinite(lighting.r + lighting.g + lighting.b) ? lighting : glm::dvec3(0.0);
  if (!keptTaps) {
    EXPECT_EQ(output, light);
    return;
  }
  const glm::dvec3 within = glm::clamp(light, 0.0, reference::largestPacked(reference::kPassThroughBits));
  const double brightest = std::max({within.r, within.g, within.b});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(output[c], within[c], reference::passThroughError(within[c], brightest));
}

void expectAntialiasing(const DeviceFrame& f, const TemporalAntialiasingSettings& settings, bool keptTaps) {
  const Image<reference::Accumulated> expected =
      reference::antialias(f.frame, f.current.guides, f.current.filtered, {f.previous.guides, f.previous.resolved},
                           reference::Storage::Exact, settings, keptTaps);
  const bool packed = settings.storage == LightStorage::Packed;
  Comparison comparison("temporal anti-aliasing");
  reference::forEachPixel(f.frame.size(), [&](glm::ivec2 p) {
    const reference::Accumulated& e = expected[p];
    const glm::dvec4 resolved = f.current.resolved[p];
    const glm::dvec3 output(f.current.output[p]);
    if (!packed) {
      EXPECT_EQ(output, glm::dvec3(resolved));
    }
    if (packed && f.current.guides[p].depth == 0.0) {
      expectPassThrough(output, f.frame.lighting[p], keptTaps);
      EXPECT_EQ(resolved, glm::dvec4(0.0));
      return;
    }
    if (comparison.skips(e.undecided)) return;
    const glm::dvec3 tolerance = halfTolerance(e.mean, e.error);
    const glm::dvec3 kept = packed ? packedTolerance(e, reference::kResolvedBits) : tolerance;
    comparison.colour(p, output, e.mean, tolerance);
    comparison.colour(p, resolved, e.mean, kept);
    const double longest = settings.maxHistory;
    const double framesTolerance =
        packed ? reference::packedLengthStep(std::max(e.samples - e.samplesError, 1.0), longest) + e.samplesError
               : halfTolerance(e.samples, e.samplesError);
    comparison.value(p, "frames", resolved.w, e.samples, framesTolerance);
  });
  comparison.expect(kUndecidedShare);
}

bool isFinite(const Image<glm::dvec4>& image) {
  return std::all_of(image.pixels().begin(), image.pixels().end(), [](const glm::dvec4& v) {
    return std::isfinite(v.r) && std::isfinite(v.g) && std::isfinite(v.b);
  });
}

}  // namespace

void expectStages(const DeviceFrame& f, const AnyWalr& settings) {
  expectGuides(f, settings);
  const bool keepTaps = !f.frame.scene.still() && sharesReprojection(settings.antialiasing(), settings.accumulation());
  expectAccumulation(f, settings.accumulation(), keepTaps);
  if (const WalrPaperSettings* pixels = settings.pixels()) {
    expectIterations(f, pixels->regression);
    expectRegression(f, pixels->regression);
  }
  expectAntialiasing(f, settings.antialiasing(), keepTaps);
}

void expectSequence(const fg::test::TestDevice& device, const std::vector<HostFrame>& frames, const AnyWalr& settings) {
  WalrRun run(device, frames.front().size(), settings, frames.front().conventions, true, frames.front().scene);
  expectSequence(run, frames, settings);
}

void expectSequence(WalrRun& run, const std::vector<HostFrame>& frames, const AnyWalr& settings) {
  run.resetHistory();
  DeviceFrame f;
  for (const HostFrame& frame : frames) {
    f.previous = std::move(f.current);
    f.frame = frame;
    f.current = run.frame(frame);
    EXPECT_TRUE(isFinite(f.current.output));
  }
  expectStages(f, settings);
}

}  // namespace walr::test
