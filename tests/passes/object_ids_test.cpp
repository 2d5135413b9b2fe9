// Object numbers tell histories of two objects apart: in agreement with the double-precision reference, and where depth
// and normal are the same.

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "passes/methods/denoiser.h"
#include "tests/passes/antialiasing_run.h"
#include "tests/passes/comparison.h"
#include "tests/passes/host_textures.h"
#include "tests/passes/reference/temporal_antialiasing.h"
#include "tests/passes/stage_checks.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::object_ids_test {
namespace {

using reference::Guide;
using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize(68, 40);  // The wall has 8 pixels per unit, so the panel moves by 4 pixels a frame.
constexpr std::uint32_t kNobody = 0xffffffffU;

/// A frame of the panel; the camera moves by less than a pixel.
HostFrame panelFrame(std::uint32_t index, const Light& light, Noise noise, double cameraStep) {
  const glm::dvec3 step(cameraStep, 0.3 * cameraStep, 0.0);
  HostFrame frame = renderFrame(slidingPanel(index), cameraAt(double(index) * step, (index - 1.0) * step, kSize, index),
                                kSize, light, noise);
  // Pixels of no object have no history, not even from one another.
  for (int x = 40; x < 50; ++x) frame.objectId[{x, 35}] = kNobody;
  return frame;
}

class ObjectIdsTest : public fg::test::GpuTest {};

TEST_F(ObjectIdsTest, HistoryAgreesWithTheReference) {
  for (const HistoryRejection rejection : {HistoryRejection::Plane, HistoryRejection::Depth, HistoryRejection::None}) {
    for (const bool objectMotion : {true, false}) {
      SCOPED_TRACE("rejection " + std::to_string(int(rejection)) + ", object motion " + std::to_string(objectMotion));
      TemporalAntialiasingSettings settings;
      settings.rejection = rejection;
      settings.objectIds = true;
      settings.clipGamma = 4.0F;
      HostFrame first = panelFrame(0, smoothLight, Noise::Exponential, 0.06);
      HostFrame second = panelFrame(1, smoothLight, Noise::Exponential, 0.06);
      second.scene.objectMotion = objectMotion;
      const Image<Guide> guides = reference::prepareGuides(first, reference::Storage::Quantised);
      const Image<Guide> guidesNow = reference::prepareGuides(second, reference::Storage::Quantised);
      AntialiasingRun run(device(), kSize, settings, second.scene, {.objectIds = true});
      (void)run.frame(first, guides, Image<Guide>(kSize));
      const Image<glm::dvec4> result = run.frame(second, guidesNow, guides);

      // The first frame is its own result, with a history length of 1.
      Image<glm::dvec4> resolved = withAlpha(first.lighting);
      for (glm::dvec4& pixel : resolved.pixels()) pixel.w = 1.0;
      const Image<reference::Accumulated> expected = reference::antialias(
          second, guidesNow, withAlpha(second.lighting), {guides, resolved}, reference::Storage::Exact, settings);
      Comparison comparison("anti-aliasing by object");
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        const reference::Accumulated& e = expected[p];
        if (comparison.skips(e.undecided)) return;
        comparison.colour(p, result[p], e.mean, halfTolerance(e.mean, e.error));
      });
      comparison.expect(kUndecidedShare);
    }
  }
}

/// Number of pixels whose light is not that of their surface.
int pixelsOff(const Image<glm::dvec4>& result, const HostFrame& truth) {
  int count = 0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const double expected = truth.lighting[p].x;
    count += std::abs(result[p].x - expected) > halfTolerance(expected, 0.0) ? 1 : 0;
  });
  return count;
}

// The panel uncovers a wall of the same depth and normal. With object numbers the wall has no history. Without them it
// takes the panel's, for as long as clipping allows.
TEST_F(ObjectIdsTest, ASurfaceUncoveredInTheSamePlaneHasNoHistory) {
  TemporalAntialiasingSettings settings;
  settings.clipGamma = 1e6F;
  settings.clipRadius = 8;  // Wide enough that the panel's border lies in the window of both strips that it uncovers.
  for (const bool objectIds : {true, false}) {
    for (const HistoryRejection rejection : {HistoryRejection::Plane, HistoryRejection::None}) {
      settings.objectIds = objectIds;
      settings.rejection = rejection;
      AntialiasingRun run(device(), kSize, settings, {}, {.objectIds = true});
      Image<Guide> before(kSize);
      for (std::uint32_t i = 0; i < 3; ++i) {
        const Scene scene = slidingPanel(i);
        const auto light = [&](glm::dvec3 point, glm::dvec3 /*normal*/) {
          return glm::dvec3(scene({0.0, 0.0, 0.0}, point)->object == 1 ? 4.0 : 1.0);
        };
        const HostFrame frame = panelFrame(i, light, Noise::None, 0.0);
        const Image<Guide> guides = reference::prepareGuides(frame, reference::Storage::Quantised);
        const Image<glm::dvec4> result = run.frame(frame, guides, before);
        before = guides;
        // The panel is 18 pixels high and moves by four. Each strip that it uncovers keeps some of its light.
        const int uncovered = 4 * 18 * int(i);
        EXPECT_EQ(pixelsOff(result, frame), objectIds ? 0 : uncovered) << "frame " << i;
      }
    }
  }
}

bool hasPass(const fg::Graph& graph, const std::string& name) {
  return std::ranges::any_of(graph.desc().passes, [&](const fg::PassDecl& pass) { return pass.name == name; });
}

// Object numbers take memory only if a host has them and a method reads them.
TEST_F(ObjectIdsTest, AreKeptOnlyIfTheHostHasThemAndTheMethodReadsThem) {
  for (const std::string& name : denoiserNames()) {
    for (const bool given : {false, true}) {
      const auto method = makeDenoiser(name);
      fg::Graph graph;
      DenoiserInputs inputs = importInputs(graph, kSize);
      if (given) inputs.objectId = importObjectIds(graph, kSize);
      (void)method->add(graph, inputs, importOutput(graph, kSize));
      EXPECT_EQ(hasPass(graph, "keep object ids"), given && name == "joint_bilateral") << name;
    }
  }
  const auto walr = makeDenoiser("walr");
  walr->set("antialiasing.object-ids", "on");
  fg::Graph graph;
  DenoiserInputs inputs = importInputs(graph, kSize);
  inputs.objectId = importObjectIds(graph, kSize);
  (void)walr->add(graph, inputs, importOutput(graph, kSize));
  EXPECT_TRUE(hasPass(graph, "keep object ids"));
}

}  // namespace
}  // namespace walr::test::object_ids_test
