// The linter names the mistakes of hosts in every kind of sequence in which they show, and nothing where none is.
#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/passes/lint_run.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::lint_mistakes_test {
namespace {

using reference::forEachPixel;
using reference::HostFrame;
using Names = std::vector<std::string>;
using Frames = std::vector<HostInput>;

constexpr glm::ivec2 kSize(48, 33);
constexpr std::uint32_t kFrames = 4;

/// A kind of sequence.
struct Kind {
  const char* name;
  std::function<Scene(std::uint32_t frame)> scene;
  double step = 0.0;  ///< Of the camera.
  double turn = 0.0;  ///< The same in its direction.
  bool jittered = false;
  /// Cycles' conventions: normals in world space, motion's y up and without a third channel.
  bool cycles = false;
  [[nodiscard]] bool moves() const { return step > 0.0 || turn > 0.0; }
};

void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}

InputConventions conventionsOf(const Kind& kind) {
  if (!kind.cycles) return {};
  return {.normal = InputConventions::Space::World, .motionDepth = InputConventions::MotionDepth::StaticScene};
}

/// A camera that is rotated against the world's axes and whose steps vary, as a hand moves it.
glm::mat4 viewAt(const Kind& kind, int frame) {
  const double time = frame + 0.4 * std::sin(1.9 * frame);
  const double angle = kind.turn * time;
  glm::dmat4 view = glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(0, 1, 0));
  view = glm::rotate(view, 0.6 * angle + 0.3 * kind.turn * std::sin(2.3 * frame), glm::dvec3(1, 0, 0));
  view = glm::rotate(view, 0.45, glm::normalize(glm::dvec3(1.0, 0.8, 1.5)));
  return glm::mat4(glm::translate(view, -kind.step * time * glm::dvec3(1.0, 0.7, -1.3)));
}

HostInput render(const Kind& kind, int frame, int previous) {
  FrameDescription camera = cameraAt({}, {}, kSize, std::uint32_t(frame));
  camera.view = viewAt(kind, frame);
  camera.previousView = viewAt(kind, previous);
  if (kind.jittered) {
    camera.jitter = jitterAt(std::uint32_t(frame + 16));
    camera.previousJitter = jitterAt(std::uint32_t(previous + 16));
  }
  HostInput host{.frame = renderFrame(kind.scene(std::uint32_t(frame)), camera, kSize), .camera = camera};
  forEachPixel(kSize, [&](glm::ivec2 p) {
    glm::dvec3& normal = host.frame.normal[p];
    if (normal == glm::dvec3(0.0)) return;
    normal = glm::normalize(kind.cycles ? normal * glm::dmat3(camera.view) : normal);
  });
  return host;
}

void scaleMotion(Frames& frames, glm::dvec3 scale) {
  for (HostInput& host : frames) {
    forEachPixel(kSize, [&](glm::ivec2 p) { host.frame.motion[p] *= scale; });
  }
}

Frames framesOf(const Kind& kind) {
  Frames frames;
  for (int i = 0; i < int(kFrames); ++i) {
    frames.push_back(render(kind, i, std::max(i - 1, 0)));
    frames.back().continues = i > 0;
    if (kind.cycles) frames.back().camera.motionScale = {1.0F, -1.0F};
  }
  if (kind.cycles) scaleMotion(frames, {1, -1, 0});
  return frames;
}

// ---- Mistakes ----

/// Change each camera that is handed over, from the last frame to the first.
template <typename Change>
void changeCameras(Frames& frames, Change change) {
  for (std::size_t i = frames.size(); i-- > 0;) change(frames[i].camera, i);
}

template <typename Change>
void changeDepth(Frames& frames, Change change) {
  for (HostInput& host : frames) {
    forEachPixel(kSize, [&](glm::ivec2 p) {
      if (host.frame.depth[p] < 1e9) host.frame.depth[p] = change(host.frame, p);
    });
  }
}

void previousIsThis(Frames& frames) {
  changeCameras(frames, [](FrameDescription& camera, std::size_t) { camera.previousView = camera.view; });
}

void resetAll(Frames& frames) {
  for (HostInput& host : frames) host.continues = false;
}

void multiplyViews(Frames& frames, const glm::mat4& left, const glm::mat4& right) {
  changeCameras(frames, [&](FrameDescription& camera, std::size_t) {
    camera.view = left * camera.view * right;
    camera.previousView = left * camera.previousView * right;
  });
}

glm::mat4 mirror(glm::vec3 signs) {
  return glm::scale(glm::mat4(1.0F), signs);
}

/// Store all images with their last row first.
void turnUpsideDown(Frames& frames) {
  for (HostInput& host : frames) {
    const HostFrame upright = host.frame;
    forEachPixel(kSize, [&](glm::ivec2 p) {
      const glm::ivec2 q(p.x, kSize.y - 1 - p.y);
      host.frame.depth[p] = upright.depth[q];
      host.frame.normal[p] = upright.normal[q];
      host.frame.motion[p] = upright.motion[q];
      host.frame.albedo[p] = upright.albedo[q];
      host.frame.lighting[p] = upright.lighting[q];
    });
  }
}

bool showsInMotion(const Kind& kind) {
  return kind.moves() || kind.jittered;  // Jittered images move while the camera is still.
}

struct Mistake {
  const char* name;
  std::function<void(const Kind&, Frames&, InputConventions&)> make;
  Names findings;
  std::function<bool(const Kind&)> shows = showsInMotion;
  Names whileStill = findings;  ///< What explains as much while only jitter moves the image, and is likelier.
};

std::vector<Mistake> mistakes() {
  const auto always = [](const Kind&) { return true; };
  const auto jittered = [](const Kind& kind) { return kind.jittered; };
  const auto moves = [](const Kind& kind) { return kind.moves(); };
  const auto walks = [](const Kind& kind) { return kind.step > 0.0; };
  const auto cameras = [](auto change) {
    return [change](const Kind&, Frames& frames, InputConventions&) { changeCameras(frames, change); };
  };
  const auto motion = [](glm::dvec3 scale) {
    return [scale](const Kind&, Frames& frames, InputConventions&) { scaleMotion(frames, scale); };
  };
  const glm::dvec2 size(kSize);
  const Names direction{"motion-x-direction", "motion-y-direction"};
  const Names unit{"motion-x-unit", "motion-y-unit"};
  return {
      {"nothing", [](const Kind&, Frames&, InputConventions&) {}, {}},
      {"nothing: real cuts",
       [](const Kind&, Frames& frames, InputConventions&) {
         scaleMotion(frames, {0, 0, 0});
         resetAll(frames);
       },
       {}},
      {"the previous camera is this one",
       [](const Kind&, Frames& f, InputConventions&) { previousIsThis(f); },
       {"camera-still"},
       moves},
      {"the previous camera is this one, and every frame is a cut",
       [](const Kind&, Frames& frames, InputConventions&) {
         previousIsThis(frames);
         resetAll(frames);
       },
       {"camera-still"},
       showsInMotion,
       {"cut-every-frame"}},
      {"every frame is a cut", [](const Kind&, Frames& f, InputConventions&) { resetAll(f); }, {"cut-every-frame"}},
      {"the previous camera is two frames old",
       [](const Kind& kind, Frames& frames, InputConventions&) {
         changeCameras(
             frames, [&](FrameDescription& camera, std::size_t i) { camera.previousView = viewAt(kind, int(i) - 2); });
       },
       {"camera-previous"},
       moves},
      {"the camera is the last frame's",
       [](const Kind& kind, Frames& frames, InputConventions&) {
         changeCameras(frames, [&](FrameDescription& camera, std::size_t i) {
           camera.view = viewAt(kind, int(i) - 1);
           camera.previousView = viewAt(kind, int(i) - 2);
         });
       },
       {"camera-late"},
       moves},
      {"both views inverted",
       cameras([](FrameDescription& camera, std::size_t) {
         camera.view = glm::inverse(camera.view);
         camera.previousView = glm::inverse(camera.previousView);
       }),
       {"view-inverted"},
       moves},
      {"the view inverted",
       cameras([](FrameDescription& camera, std::size_t) { camera.view = glm::inverse(camera.view); }),
       {"view-inverted"},
       always},
      {"the previous view inverted",
       cameras([](FrameDescription& camera, std::size_t) { camera.previousView = glm::inverse(camera.previousView); }),
       {"view-inverted"},
       always},
      {"view space with y down and z forward",
       [](const Kind&, Frames& frames, InputConventions&) {
         multiplyViews(frames, mirror({1, -1, -1}), mirror({1, 1, 1}));
       },
       {"view-axes"},
       moves},
      {"a left-handed world and view space",
       [](const Kind&, Frames& frames, InputConventions&) {
         multiplyViews(frames, mirror({1, 1, -1}), mirror({1, 1, -1}));
       },
       {"view-axes"},
       moves},
      {"motion current minus previous", motion({-1, -1, 1}), direction},
      {"motion with x to the left", motion({-1, 1, 1}), {"motion-x-direction"}},
      {"motion with the other y", motion({1, -1, 1}), {"motion-y-direction"}},
      {"motion in pictures", motion({1.0 / size, 1}), unit},
      {"motion in pictures, y up", motion({1.0 / size.x, -1.0 / size.y, 1}), unit},
      {"motion in clip space", motion({2.0 / size.x, -2.0 / size.y, 1}), unit},
      {"motion in pixels, stated in pictures",
       cameras([](FrameDescription& camera, std::size_t) { camera.motionScale *= glm::vec2(kSize); }), unit},
      {"motion in pixels of twice the size", motion({2, 2, 1}), unit},
      {"motion in pixels of half the size",
       [](const Kind& kind, Frames& frames, InputConventions&) {
         if (kind.moves()) scaleMotion(frames, {0.5, 0.5, 1});
       },
       unit, moves},
      {"images upside down",
       [](const Kind&, Frames& frames, InputConventions&) { turnUpsideDown(frames); },
       {"picture-upside-down"},
       always,
       {"normal-y"}},
      {"images upside down, and motion with them",
       [](const Kind& kind, Frames& frames, InputConventions&) {
         turnUpsideDown(frames);
         if (kind.moves()) scaleMotion(frames, {1, -1, 1});
       },
       {"picture-upside-down"},
       always,
       {"normal-y"}},
      {"another field of view",
       cameras([](FrameDescription& camera, std::size_t) {
         for (glm::mat4* projection : {&camera.projection, &camera.previousProjection}) {
           (*projection)[0][0] *= 1.3F;
           (*projection)[1][1] *= 1.3F;
         }
       }),
       {"projection"},
       moves},
      {"the aspect ratio of a square",
       cameras([](FrameDescription& camera, std::size_t) {
         for (glm::mat4* projection : {&camera.projection, &camera.previousProjection})
           (*projection)[0][0] = (*projection)[1][1];
       }),
       {"projection"},
       moves},
      {"views without position",
       cameras([](FrameDescription& camera, std::size_t) {
         for (glm::mat4* view : {&camera.view, &camera.previousView}) (*view)[3] = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
       }),
       {"view-position"},
       walks},
      {"the same frame again",
       [](const Kind&, Frames& frames, InputConventions&) { std::ranges::fill(frames, HostInput(frames[1])); },
       {"frames-repeated"},
       moves},
      {"the same frame again, each a cut",
       [](const Kind&, Frames& frames, InputConventions&) {
         std::ranges::fill(frames, HostInput(frames[1]));
         resetAll(frames);
       },
       {"frames-repeated"},
       showsInMotion,
       {"cut-every-frame"}},
      {"frames from the last to the first, each a cut",
       [](const Kind&, Frames& frames, InputConventions&) {
         std::ranges::reverse(frames);
         resetAll(frames);
       },
       {"frames-reversed"},
       showsInMotion,
       {"cut-every-frame"}},
      {"motion missing", motion({0, 0, 1}), {"motion-x-missing", "motion-y-missing"}, showsInMotion, {"motion-jitter"}},
      {"motion to the next frame",
       [](const Kind& kind, Frames& frames, InputConventions&) {
         for (int i = 0; i < int(kFrames); ++i)
           frames[std::size_t(i)].frame.motion = render(kind, i, i + 1).frame.motion;
         if (kind.cycles) scaleMotion(frames, {1, -1, 0});
       },
       {"motion-next"}},
      {"motion of the last frame",
       [](const Kind&, Frames& frames, InputConventions&) {
         for (std::size_t i = frames.size() - 1; i > 0; --i) frames[i].frame.motion = frames[i - 1].frame.motion;
       },
       {"motion-late"},
       showsInMotion},
      {"motion.z reversed",
       motion({1, 1, -1}),
       {"motion-z-direction"},
       [](const Kind& kind) { return kind.moves() && !kind.cycles; }},
      {"jitter in motion, unlike stated",
       [](const Kind&, Frames&, InputConventions& conventions) { conventions.motionJittered = false; },
       {"motion-jitter"},
       jittered},
      {"jitter missing",
       cameras([](FrameDescription& camera, std::size_t) { camera.jitter = camera.previousJitter = {}; }),
       {"jitter-missing"},
       jittered},
      {"jitter with the other sign",
       cameras([](FrameDescription& camera, std::size_t) {
         camera.jitter = -camera.jitter;
         camera.previousJitter = -camera.previousJitter;
       }),
       {"jitter-sign"},
       jittered,
       direction},
      {"jitter of a picture of twice the size",
       cameras([](FrameDescription& camera, std::size_t) {
         camera.jitter *= 2.0F;
         camera.previousJitter *= 2.0F;
       }),
       {"jitter-unit"},
       jittered,
       unit},
      {"jitter in clip space",
       cameras([](FrameDescription& camera, std::size_t) {
         for (glm::vec2* jitter : {&camera.jitter, &camera.previousJitter})
           *jitter *= glm::vec2(2, -2) / glm::vec2(kSize);
       }),
       {"jitter-unit"},
       jittered},
      {"jitter of the last frame",
       [](const Kind& kind, Frames& frames, InputConventions&) {
         if (!kind.jittered) return;
         changeCameras(frames, [](FrameDescription& camera, std::size_t i) {
           camera.jitter = jitterAt(std::uint32_t(i + 15));
           camera.previousJitter = jitterAt(std::uint32_t(i + 14));
         });
       },
       {"jitter-late"},
       jittered},
      {"depth in centimetres",
       [](const Kind&, Frames& frames, InputConventions&) {
         changeDepth(frames, [](const HostFrame& frame, glm::ivec2 p) { return 100.0 * frame.depth[p]; });
       },
       {"depth-unit"},
       walks},
      {"depth along the ray",
       [](const Kind&, Frames& frames, InputConventions&) {
         changeDepth(frames, [](const HostFrame& frame, glm::ivec2 p) {
           return frame.depth[p] *
                  glm::length(reference::rayThrough(frame.constants.rayFromPixel, reference::pixelCentre(p)));
         });
       },
       {"depth-distance"},
       always},
      {"normals in the other space",
       [](const Kind&, Frames&, InputConventions& conventions) {
         using Space = InputConventions::Space;
         conventions.normal = conventions.normal == Space::World ? Space::View : Space::World;
       },
       {"normal-space"},
       always},
      {"y and z of normals exchanged",
       [](const Kind&, Frames& frames, InputConventions&) {
         for (HostInput& host : frames) {
           forEachPixel(kSize, [&](glm::ivec2 p) { std::swap(host.frame.normal[p].y, host.frame.normal[p].z); });
         }
       },
       {"normal-axes"},
       always},
      {"no light",
       [](const Kind&, Frames& frames, InputConventions&) {
         for (HostInput& host : frames) host.frame.lighting = reference::Image<glm::dvec3>(kSize, glm::dvec3(0.0));
       },
       {"lighting-zero"},
       always},
      {"light on a checkerboard",
       [](const Kind&, Frames& frames, InputConventions&) {
         for (std::size_t i = 0; i < frames.size(); ++i) {
           forEachPixel(kSize, [&](glm::ivec2 p) {
             if ((std::size_t(p.x + p.y) + i) % 2 == 0) frames[i].frame.lighting[p] = glm::dvec3(0.0);
           });
         }
       },
       {"lighting-half-empty"},
       always},
  };
}

class LintMistakes : public fg::test::GpuTest, public testing::WithParamInterface<Kind> {};

TEST_P(LintMistakes, AreNamed) {
  const Kind& kind = GetParam();
  const Frames right = framesOf(kind);
  LintRun run(device(), kSize);
  for (const Mistake& mistake : mistakes()) {
    Frames frames = right;
    InputConventions conventions = conventionsOf(kind);
    mistake.make(kind, frames, conventions);
    Names names;
    std::string texts;
    for (const LintFinding& finding : run.lint(frames, conventions)) {
      names.emplace_back(finding.name);
      texts += finding.text() + "\n";
    }
    EXPECT_EQ(names, mistake.shows(kind) ? kind.moves() ? mistake.findings : mistake.whileStill : Names{})
        << mistake.name << ":\n"
        << texts;
  }
}

std::vector<Kind> kinds() {
  const auto still = [](const Scene& scene) { return [scene](std::uint32_t) { return scene; }; };
  const auto approaching = [](std::uint32_t frame) { return approachingPanel(frame, 0.05); };
  return {
      {"sphere", still(sphere()), 0.05, 0.02},
      {"sphere, jittered", still(sphere()), 0.05, 0.02, true},
      {"sphere, fast", still(sphere()), 0.2, 0.08, true},
      {"sphere, Cycles", still(sphere()), 0.05, 0.02, false, true},
      {"stairs, walking, jittered", still(stairs()), 0.08, 0.0, true},
      {"sphere, turning", still(sphere()), 0.0, 0.04},
      {"wall beside sky, jittered, Cycles", still(skyBesideSurface()), 0.06, 0.03, true, true},
      {"moving panel", slidingPanel, 0.05, 0.02},
      {"approaching panel, jittered", approaching, 0.05, 0.02, true},
      {"still camera", still(sphere())},
      {"still camera, jittered", still(sphere()), 0.0, 0.0, true},
      {"still camera, moving panel, jittered", slidingPanel, 0.0, 0.0, true},
  };
}

INSTANTIATE_TEST_SUITE_P(Kinds, LintMistakes, testing::ValuesIn(kinds()));

using LintFactors = fg::test::GpuTest;

TEST_F(LintFactors, AreTold) {
  struct Case {
    std::function<void(Frames&)> make;
    Names told;  ///< Of each finding.
  };
  const Case cases[] = {
      {[](Frames& frames) {
         scaleMotion(frames, {2, 0.5, 1});
       },
       {"with motion times 0.5,", "with motion times 2,"}},
      {[](Frames& frames) {
         changeDepth(frames, [](const HostFrame& frame, glm::ivec2 p) { return 100.0 * frame.depth[p]; });
       },
       {"with depth times 0.01,"}},
      {[](Frames& frames) {
         changeCameras(frames, [](FrameDescription& camera, std::size_t) {
           for (glm::mat4* projection : {&camera.projection, &camera.previousProjection}) (*projection)[0][0] *= 1.3F;
         });
       },
       {"with the width of the view times 1.3,"}},
  };
  const Kind kind = kinds().front();
  LintRun run(device(), kSize);
  for (const Case& mistake : cases) {
    Frames frames = framesOf(kind);
    mistake.make(frames);
    const std::vector<LintFinding> findings = run.lint(frames, conventionsOf(kind));
    ASSERT_EQ(findings.size(), mistake.told.size());
    for (std::size_t i = 0; i < findings.size(); ++i) {
      EXPECT_NE(findings[i].what.find(mistake.told[i]), std::string::npos) << findings[i].what;
    }
  }
}

}  // namespace
}  // namespace walr::test::lint_mistakes_test
