// The linter of inputs: it reports exactly the fault that the input has, and nothing for correct input.
#include "passes/lint/input_linter.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/passes/lint_run.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::lint_test {
namespace {

using reference::forEachPixel;
using reference::HostFrame;

constexpr glm::ivec2 kSize(96, 72);
constexpr fg::Extent kExtent{96, 72};
constexpr std::uint32_t kFrames = 3;

/// A camera that is rotated against the world's axes, moves and turns, so that motion has every component.
FrameDescription camera(std::uint32_t frame, bool jitters, bool still) {
  const auto viewAt = [&](double time) {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.35 + 0.015 * time, glm::normalize(glm::dvec3(1, 1, 0.3)));
    return glm::mat4(glm::translate(turn, -time * glm::dvec3(0.06, 0.05, -0.12)));
  };
  FrameDescription description = cameraAt({}, {}, kSize, frame);
  const double time = still ? 0.0 : frame;
  description.view = viewAt(time);
  description.previousView = viewAt(std::max(time - 1.0, 0.0));
  return jitters ? jittered(description, frame) : description;
}

/// A sequence of frames, correct or with one kind of fault.
struct Case {
  const char* name;
  std::vector<std::string> findings;  ///< Expected findings, in order.
  std::function<void(HostInput&)> spoil = [](HostInput&) {};
  bool jittered = false;
  bool still = false;
  InputConventions conventions = {};
  std::uint32_t stillFrames = 0;  ///< The camera stands still in so many frames before the others.
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

HostInput render(std::uint32_t index, const Case& c) {
  const bool still = c.still || index < c.stillFrames;
  HostInput host{.camera = camera(still ? index : index - c.stillFrames, c.jittered, still)};
  host.frame = renderFrame(sphere(), host.camera, kSize);
  forEachPixel(kSize, [&](glm::ivec2 p) {
    glm::dvec3& normal = host.frame.normal[p];
    if (normal != glm::dvec3(0.0)) normal = glm::normalize(normal);
    // Tiles of alternating albedo.
    if (host.frame.albedo[p].x > 0.0) host.frame.albedo[p] = glm::dvec3((p.x / 3 + p.y / 3) % 2 == 0 ? 0.75 : 0.15);
  });
  return host;
}

template <typename Apply>
std::function<void(HostInput&)> eachPixel(Apply apply) {
  return [apply](HostInput& host) mutable { forEachPixel(kSize, [&](glm::ivec2 p) { apply(host.frame, p); }); };
}

/// Light whose alpha is `everywhere`, and `once` in one pixel.
Case withAlpha(const char* name, std::vector<std::string> findings, double everywhere, double once,
               const LightPattern& light) {
  const auto write = [=](HostInput& host) {
    host.frame.lightAlpha = reference::Image<double>(kSize, everywhere);
    host.frame.lightAlpha[{40, 30}] = once;
  };
  return {name, std::move(findings), write, false, false, {.light = light}};
}

glm::dmat3 worldFromView(const HostFrame& frame) {
  return glm::transpose(glm::dmat3(glm::mat3(frame.constants.viewFromWorld)));
}

class Lint : public fg::test::GpuTest, public testing::WithParamInterface<Case> {
 protected:
  std::vector<LintFinding> lint(const Case& c) const {
    std::vector<HostInput> frames;
    for (std::uint32_t i = 0; i < c.stillFrames + kFrames; ++i) {
      HostInput& host = frames.emplace_back(render(i, c));
      host.continues = i > 0;
      host.frame.conventions.light = c.conventions.light;
      c.spoil(host);
    }
    return LintRun(device(), kSize, c.conventions.light).lint(frames, c.conventions);
  }
};

/// Move camera and scene so far away that floats hold a position of the camera to a sixty-fourth of a unit only.
void moveAway(HostInput& host, bool statesOrigin) {
  const glm::dvec3 far(0x1p18 + 1.0 / 3.0, 0.0, 0x1p17 + 1.0 / 3.0);
  for (glm::mat4* view : {&host.camera.view, &host.camera.previousView})
    if (!statesOrigin) *view = glm::mat4(glm::translate(glm::dmat4(*view), -far));
  if (statesOrigin) host.camera.origin = host.camera.previousOrigin = far;
  host.frame.constants = frameConstants(host.camera, kExtent);
}

/// Every second group of four columns is five times as far away, in the same directions.
/// @param filtered  a pixel has the mean of its depth and that of the pixel on the left
void showBars(HostFrame& frame, bool filtered) {
  forEachPixel(kSize, [&](glm::ivec2 p) { frame.depth[p] *= p.x / 4 % 2 == 0 ? 1.0 : 5.0; });
  if (!filtered) return;
  const reference::Image<double> sharp = frame.depth;
  forEachPixel(kSize, [&](glm::ivec2 p) {
    if (p.x > 0) frame.depth[p] = 0.5 * (sharp[p] + sharp[p - glm::ivec2(1, 0)]);
  });
}

std::vector<Case> cases() {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr auto kWorld = InputConventions::Space::World;
  const auto toWorld = eachPixel([](HostFrame& f, glm::ivec2 p) { f.normal[p] = worldFromView(f) * f.normal[p]; });
  const auto scaledMotion = [](glm::dvec3 scale) {
    return eachPixel([scale](HostFrame& f, glm::ivec2 p) { f.motion[p] *= scale; });
  };
  const auto jitterMatrices = [](HostInput& h) {
    const glm::vec2 clip = glm::vec2(2.0F, -2.0F) / glm::vec2(kSize);
    for (int axis = 0; axis < 2; ++axis) {
      h.camera.projection[2][axis] += h.camera.jitter[axis] * clip[axis];
      h.camera.previousProjection[2][axis] += h.camera.previousJitter[axis] * clip[axis];
    }
  };
  const auto skyAlone = eachPixel([](HostFrame& f, glm::ivec2 p) { f.depth[p] = 2e9; });
  std::vector<Case> all{
      {"good", {}},
      {"lighting not finite",
       {"lighting-not-finite"},
       [=](HostInput& h) {
         h.frame.lighting[{40, 30}].g = kNaN;
       }},
      {"a firefly",
       {"fireflies"},
       [=](HostInput& h) {
         h.frame.lighting[{40, 30}] = glm::dvec3(0.0, 0.0, 30000.0);
       }},
      {"depth not finite",
       {"depth-not-finite"},
       [=](HostInput& h) {
         h.frame.depth[{40, 30}] = kNaN;
       }},
      {"normals not finite",
       {"normal-not-finite"},
       [=](HostInput& h) {
         h.frame.normal[{40, 30}].x = kNaN;
       }},
      {"motion not finite",
       {"motion-not-finite"},
       [=](HostInput& h) {
         h.frame.motion[{40, 30}].y = kNaN;
       }},
      {"albedo not finite",
       {"albedo-not-finite"},
       [=](HostInput& h) {
         h.frame.albedo[{40, 30}].z = kNaN;
       }},
      {"lighting negative", {"lighting-negative"}, eachPixel([](HostFrame& f, glm::ivec2 p) {
         f.lighting[p] -= glm::dvec3(0.5);
       })},
      withAlpha("good, numbers of samples", {}, 0.5, 0.0, {.counted = true}),
      withAlpha("a number of samples that is none", {"lighting-count-range"}, 4.0, kNaN, {.counted = true}),
      withAlpha("numbers of samples below 0 and above all halves", {"lighting-count-range"}, -1.0, 1e6,
                {.counted = true}),
      withAlpha("a mask that was not written", {"lighting-empty"}, 0.0, 0.0, {.masked = true}),
      {"normals in 0..1", {"normal-not-unit"}, eachPixel([](HostFrame& f, glm::ivec2 p) {
         f.normal[p] = f.normal[p] * 0.5 + 0.5;
       })},
      {"normals not normalised", {"normal-not-unit"}, eachPixel([](HostFrame& f, glm::ivec2 p) {
         f.normal[p] *= 0.9;
       })},
      {"normals missing", {"normal-empty"}, eachPixel([](HostFrame& f, glm::ivec2 p) { f.normal[p] = {}; })},
      {"normals with y down", {"normal-y"}, eachPixel([](HostFrame& f, glm::ivec2 p) { f.normal[p].y *= -1.0; })},
      {"normals at random", {"normal-depth"}, eachPixel([random = std::mt19937(5)](HostFrame& f, glm::ivec2 p) mutable {
         std::normal_distribution<double> component;
         f.normal[p] = glm::normalize(glm::dvec3(component(random), component(random), component(random)));
       })},
      {"depth negative", {"depth-sign"}, eachPixel([](HostFrame& f, glm::ivec2 p) { f.depth[p] *= -1.0; })},
      {"depth missing", {"depth-empty"}, eachPixel([](HostFrame& f, glm::ivec2 p) { f.depth[p] = 0.0; })},
      {"sky alone", {"sky-only"}, skyAlone},
      {"sky alone, and another fault",
       {"jitter-in-matrices", "sky-only"},
       [=](HostInput& h) {
         skyAlone(h);
         jitterMatrices(h);
       },
       true},
      {"depth reversed",
       {"depth-reversed"},
       eachPixel([](HostFrame& f, glm::ivec2 p) { f.depth[p] = 0.1 / f.depth[p]; }),
       false,
       true},
      {"depth of a projection",
       {"depth-device"},
       eachPixel([](HostFrame& f, glm::ivec2 p) { f.depth[p] = 1.0 - 0.1 / f.depth[p]; }),
       false,
       true},
      {"a mist factor for depth", {"depth-other"}, eachPixel([](HostFrame& f, glm::ivec2 p) {
         f.depth[p] *= 0.01 * f.depth[p];
       })},
      {"depth of a projection, while the camera moves", {"depth-device"}, eachPixel([](HostFrame& f, glm::ivec2 p) {
         f.depth[p] = 1.0 - 0.1 / f.depth[p];
       })},
      {"good, bars in front of a wall", {}, [](HostInput& h) { showBars(h.frame, false); }, false, true},
      {"depth filtered across the edges of bars",
       {"depth-filtered"},
       [](HostInput& h) { showBars(h.frame, true); },
       false,
       true},
      {"albedo missing", {"albedo-empty"}, eachPixel([](HostFrame& f, glm::ivec2 p) { f.albedo[p] = {}; })},
      {"albedo above 1", {"albedo-range"}, eachPixel([](HostFrame& f, glm::ivec2 p) { f.albedo[p] *= 3.0; })},
      {"albedo in the lighting", {"albedo-in-lighting"}, eachPixel([](HostFrame& f, glm::ivec2 p) {
         f.lighting[p] *= f.albedo[p];
       })},
      {"good, motion of two channels, stated as such",
       {},
       scaledMotion({1.0, 1.0, 0.0}),
       false,
       false,
       {.motionDepth = InputConventions::MotionDepth::Found}},
      {"motion.z missing", {"motion-z-missing"}, scaledMotion({1.0, 1.0, 0.0})},
      {"previous camera is this one, after frames in which the camera stood still",
       {"camera-still"},
       [](HostInput& h) {
         h.camera.previousView = h.camera.view;
         h.frame.constants = frameConstants(h.camera, kExtent);
       },
       false,
       false,
       {},
       8},
      {"view matrix inverted",
       {"view-inverted"},
       [toWorld](HostInput& h) {
         toWorld(h);
         h.camera.view = glm::inverse(h.camera.view);
         h.camera.previousView = glm::inverse(h.camera.previousView);
         h.frame.constants = frameConstants(h.camera, kExtent);
       },
       false,
       true,
       {.normal = kWorld}},
      {"a camera far from the origin", {"origin-far"}, [](HostInput& h) { moveAway(h, false); }},
      {"good, far from the world's origin with an origin of its own", {}, [](HostInput& h) { moveAway(h, true); }},
      {"jitter not in the motion",
       {"motion-jitter"},
       [](HostInput& h) {
         forEachPixel(kSize,
                      [&](glm::ivec2 p) { h.frame.motion[p] -= glm::dvec3(h.frame.constants.jitterDelta, 0.0F); });
       },
       true},
      {"jitter in the matrices", {"jitter-in-matrices"}, jitterMatrices, true},
  };
  return all;
}

TEST_P(Lint, ReportsTheFaultAndNothingElse) {
  std::vector<std::string> names;
  std::string texts;
  for (const LintFinding& finding : lint(GetParam())) {
    names.emplace_back(finding.name);
    texts += finding.text() + "\n";
  }
  EXPECT_EQ(names, GetParam().findings) << texts;
}
INSTANTIATE_TEST_SUITE_P(Inputs, Lint, testing::ValuesIn(cases()));

}  // namespace
}  // namespace walr::test::lint_test
