// Where reflected light was in the previous frame: the pass against its double-precision reference, and against optics.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "passes/methods/denoiser.h"
#include "passes/temporal/reflection_motion.h"
#include "tests/error_text.h"
#include "tests/passes/comparison.h"
#include "tests/passes/denoiser_run.h"
#include "tests/passes/mirror_optics.h"
#include "tests/passes/reference/reflection.h"
#include "tests/passes/reflection_run.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test {
namespace {

using reference::Guide;
using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize = kMirrorSize;

class ReflectionMotionTest : public fg::test::GpuTest {};

struct OpticsCase {
  const char* name;
  Mirror mirror;
  double distance;  ///< Of what is reflected.
  // Largest errors in pixels.
  double mean;
  double worst;  ///< Of 99 in 100.
  // The same where the search begins at the surface; 0: no other ones.
  double meanFromSurface = 0.0;
  double worstFromSurface = 0.0;
};

// Where the errors come from: kept motion errs by up to 1/256 of a pixel at 2 to 4. Normals are halves, whose
// components err by up to 2^-12. On a flat mirror that error is the same everywhere and cancels. On a curved one it
// turns the mirrored ray by up to 2 sqrt(2) 2^-12 = 7e-4 radians, differently from pixel to pixel; over the turn from
// one pixel to the next, which is 1/kPixels (1 + 2 distance / (radius cos)) = 1.5e-3 (radius 5) to 1.2e-2 (radius 0.3),
// this is half a pixel to a sixteenth at most. A fifth of the most is allowed for the mean, and half of it, or a bit
// more, for 99 in 100. One step of Newton's method leaves an error of second order. It is the larger one at grazing
// angles if the search begins at the surface (.019 and .025 pixels were measured), and beyond a focus (.24 and .61). A
// quarter more is allowed there.
TEST_F(ReflectionMotionTest, AgreesWithOptics) {
  const OpticsCase cases[]{
      {"flat", {kInfinity, 0.4}, 1.5, 0.01, 0.02},
      {"flat, far", {kInfinity, 1.0}, 50.0, 0.01, 0.02},
      {"flat, grazing", {kInfinity, 1.45}, 0.3, 0.01, 0.02, 0.024, 0.031},
      {"convex, radius 0.3", {0.3, 0.4}, 1.0, 0.03, 0.08},
      {"convex, radius 1", {1.0, 0.8}, 3.0, 0.12, 0.3},
      {"convex, radius 5", {5.0, 0.5}, 0.8, 0.12, 0.3},
      {"concave, before the focus", {-3.0, 0.3}, 0.5, 0.12, 0.3},
      {"concave, beyond the focus", {-1.0, 0.3}, 2.5, 0.3, 0.76},
      {"moving", {0.5, 0.4, 2.0, {0.015, 0.005, 0.0}}, 1.0, 0.12, 0.3},
  };
  const auto method = makeDenoiser("accumulate");
  ReflectionRun run(device(), *method);
  const glm::dvec3 step(0.006, -0.004, 0.003);
  for (int i = 0; i < 4; ++i) {
    const bool jitter = i % 2 == 1;
    // Below .1, Newton's method begins at the image in a flat mirror.
    const bool asFlat = i < 2;
    const double roughness = asFlat ? 0.08 : 0.2;
    for (const OpticsCase& c : cases) {
      const std::string name = std::string(c.name) + (jitter ? ", jitter" : "") + (asFlat ? "" : ", rough");
      SCOPED_TRACE(name);
      const Walk cameras = walk(step, jitter);
      run.reset();
      run.frame(specularFrame(c.mirror.before().scene(), cameras.first, c.distance, roughness));
      const HostFrame frame = specularFrame(c.mirror.scene(), cameras.second, c.distance, roughness);
      run.frame(frame);
      const Image<glm::dvec3> motion = run.view(0);
      std::vector<double> errors;
      double surface = 0.0;
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        const auto exact = exactMotion(c.mirror, frame, step, c.distance, p);
        if (!exact) return;
        // Newton's method begins elsewhere, and that place must lie in the picture, too.
        const double margin = asFlat && c.mirror.moved == glm::dvec3(0.0) ? 2.0 : 8.0;
        const glm::dvec2 inside = reference::pixelCentre(p) + *exact;
        if (glm::any(glm::lessThan(inside, glm::dvec2(margin)))) return;
        if (glm::any(glm::greaterThan(inside, glm::dvec2(kSize) - margin))) return;
        errors.push_back(glm::distance(glm::dvec2(motion[p]), *exact));
        surface += glm::distance(glm::dvec2(frame.motion[p]) - glm::dvec2(frame.constants.jitterDelta), *exact);
      });
      ASSERT_GT(errors.size(), 500U);
      const ErrorFigures figures = figuresOf(errors);
      RecordProperty(name, figures.text());
      const bool otherBounds = !asFlat && c.meanFromSurface > 0.0;
      const double mean = otherBounds ? c.meanFromSurface : c.mean;
      EXPECT_LT(figures.mean, mean);
      EXPECT_LT(figures.worst, otherBounds ? c.worstFromSurface : c.worst);
      EXPECT_GT(surface / static_cast<double>(errors.size()), 5.0 * mean);
    }
  }
}

// Kept motion has 9 bits, so that it errs by up to 2^-9 of itself, and the surface's, from which the image's is
// counted, by as much. The surface moves by up to 8 pixels. The rest is single precision, which Newton's method
// multiplies.
double motionTolerance(glm::dvec2 motion) {
  return 0x1p-8 * std::max(glm::length(motion), 8.0) + 0.009;
}
// The miss and the slopes that Newton's method takes of it err by 3.7e-7 radians a pixel in single precision (the most
// that was seen, with code by LLVM 22; 3e-7 by LLVM 15), and so the miss after a step of up to 16 pixels errs
// by 6.3e-6: 1/62 of half a pixel, with which a mirror's miss is compared, and less of a wider lobe.
constexpr double kMissTolerance = 1.0 / 62.0;
// So many pixels are tested next to a threshold.
constexpr double kUndecided = 0.03;

TEST_F(ReflectionMotionTest, AgreesWithTheReference) {
  struct World {
    Scene before;
    Scene now;
  };
  const auto still = [](const Scene& scene) { return World{scene, scene}; };
  const auto moving = [](const Mirror& mirror) { return World{mirror.before().scene(), mirror.scene()}; };
  const World worlds[]{still(sphere()),
                       still(bumpyWall(0.1)),
                       still(Mirror{0.5, 0.7}.scene()),
                       still(Mirror{-1.0, 0.3}.scene()),
                       still(Mirror{kInfinity, 0.4}.scene()),
                       moving({kInfinity, 0.4, 2.0, {0.0, 0.0, 0.08}}),
                       moving({0.5, 0.4, 2.0, {0.0, 0.0, -0.06}})};
  using enum InputConventions::MotionDepth;
  for (const auto& [objectMotion, motionDepth] :
       {std::pair(false, Given), std::pair(true, Given), std::pair(true, Found)}) {
    const SceneDescription description{.objectMotion = objectMotion};
    ReflectionRun run(device(), description, objectMotion, motionDepth);
    for (const World& world : worlds) {
      for (const double roughness : {0.0, 0.2, 0.4, 1.0}) {
        const std::size_t number = static_cast<std::size_t>(&world - worlds);
        const bool moves = number > 4;
        if (objectMotion ? number % 2 == 1 && !moves : moves) continue;
        SCOPED_TRACE("world " + std::to_string(number) + ", roughness " + std::to_string(roughness) +
                     (motionDepth == Found ? ", depth found" : ""));
        const bool zoom = number >= 2;
        const glm::dvec3 step = zoom ? glm::dvec3(0.005, -0.004, 0.003) : glm::dvec3(0.09, 0.04, -0.03);
        const auto camera = [&](std::uint32_t i) {
          const FrameDescription at = jittered(cameraAt(double(i) * step, (i - 1.0) * step, kSize, i), i);
          return zoom ? zoomed(at) : at;
        };
        HostFrame first = specularFrame(world.before, camera(0), 1.5, roughness);
        HostFrame second = specularFrame(world.now, camera(1), 1.5, roughness);
        second.scene = description;
        second.conventions.motionDepth = motionDepth;
        if (motionDepth == Found) forgetMotionDepth(second);
        reference::forEachPixel(kSize, [&](glm::ivec2 p) {
          // Distances, or no sample. On the right, something else came into view.
          const double distance = (p.x < 52 ? 1.0 : 2.0) + 0.5 * (p.x % 2);
          second.lightAlpha[p] = (p.x + p.y) % 3 == 0 ? 0.0 : distance;
        });
        if (objectMotion) {
          first.specularMotion = second.specularMotion = Image<glm::dvec3>(kSize);
          reference::forEachPixel(kSize, [&](glm::ivec2 p) {
            const glm::dvec3 moved = p.y < 40 ? glm::dvec3(0.125, -0.0625, 0.03125) * double(p.y % 4) : glm::dvec3(NAN);
            second.specularMotion[p] = moved;
          });
        }
        const Image<Guide> before = reference::prepareGuides(first, reference::Storage::Quantised);
        const Image<Guide> guides = reference::prepareGuides(second, reference::Storage::Quantised);
        run.reset();
        run.frame(first, before, Image<Guide>(kSize));
        run.frame(second, guides, before);
        const Image<reference::Reflected> expected =
            reference::reflectionMotion(second, guides, {before, first.roughness, first.lightAlpha}, {}, {});
        const Image<glm::dvec3> motion = run.view(0);
        const Image<glm::dvec3> history = run.view(1);
        const Image<glm::dvec4> confidence = run.output();
        Comparison comparison("motion of reflections");
        reference::forEachPixel(kSize, [&](glm::ivec2 p) {
          const reference::Reflected& e = expected[p];
          if (guides[p].depth == 0.0 || comparison.skips(e.undecided)) return;
          comparison.value(p, "x", motion[p].x, e.motion.x, motionTolerance(e.motion));
          comparison.value(p, "y", motion[p].y, e.motion.y, motionTolerance(e.motion));
          comparison.value(p, "followed", motion[p].z, e.followed ? 1.0 : 0.0, 0.0);
          if (e.history == 0.0) {  // There are no history taps; the pass takes the largest miss, 4.
            const double most = double(ReflectionMotionSettings{}.historyPerLobe) * 2.0 * std::atan(0.4 * 0.4) / 4.0;
            comparison.value(p, "no history", history[p].x, 0.0, most);
            return;
          }
          // From the history of the largest miss to that of the smallest one within the tolerance.
          const auto historyOf = [](double miss) {
            return std::min(double(ReflectionMotionSettings{}.historyPerLobe) / std::max(miss, 1e-6), 16.0);
          };
          const double least = std::min(historyOf(e.miss + kMissTolerance), e.history);
          const double most = std::max(historyOf(e.miss - kMissTolerance), e.history);
          const double middle = 0.5 * (least + most);
          const double tolerance = 0.5 * (most - least) + 0.02 * e.history;
          comparison.value(p, "history", history[p].x, middle, tolerance);
          comparison.value(p, "confidence", confidence[p].x, middle / 16.0, tolerance / 16.0 + 1.0 / 255.0);
        });
        comparison.expect(kUndecided);
      }
    }
  }
}

// A mirror that comes nearer by more than the plane tolerance keeps its history if the depth of its motion is found,
// unless it comes nearer by more than a tenth a frame, and has none if it is taken for a still one.
TEST_F(ReflectionMotionTest, FoundDepthKeepsTheHistoryOfWhatComesNearer) {
  using enum InputConventions::MotionDepth;
  const auto historyOf = [&](double step, InputConventions::MotionDepth motionDepth, double roughness) {
    const auto method = makeDenoiser("accumulate");
    ReflectionRun run(device(), *method, {.history = true, .motionDepth = motionDepth});
    for (int i = 0; i < 3; ++i) {
      Mirror mirror{kInfinity, 0.4, 2.0, {0.0, 0.0, step}, {0.0, 0.0, i * step}};
      const auto number = static_cast<std::uint32_t>(i);
      HostFrame frame = specularFrame(mirror.scene(), zoomed(cameraAt({}, {}, kSize, number)), 1.5, roughness);
      if (motionDepth != Given) forgetMotionDepth(frame);
      run.frame(frame);
    }
    const Image<glm::dvec3> history = run.view(2);
    double sum = 0.0;
    for (const glm::dvec3& length : history.pixels()) sum += length.x;
    return sum / static_cast<double>(history.pixels().size());
  };
  // The image in a mirror that moves is elsewhere; that of a rough surface moves with it.
  for (const double roughness : {0.2, 1.0}) {
    SCOPED_TRACE(roughness);
    const double given = historyOf(0.05, Given, roughness);
    EXPECT_GT(given, 2.0);  // Of 3. Beyond the border, there is none.
    EXPECT_NEAR(historyOf(0.05, Found, roughness), given, 0.05);
    EXPECT_LT(historyOf(0.05, StaticScene, roughness), 1.1);
    EXPECT_LT(historyOf(0.3, Found, roughness), 1.1);
  }
}

// Light that depends only on the direction in which it is reflected: it stays at its place in the image.
TEST_F(ReflectionMotionTest, AccumulatesAlongTheImage) {
  const Mirror mirror{1.0, 0.6};
  constexpr double kDistance = 2.0;
  const glm::dvec3 step(0.008, -0.005, 0.002);
  const auto error = [&](const char* name, const char* surfaceFrom, double roughness = 0.1) {
    const auto method = makeDenoiser(name);
    if (surfaceFrom != nullptr) method->set("reflection.surface-from", surfaceFrom);
    ReflectionRun run(device(), *method);
    HostFrame frame;
    for (std::uint32_t i = 0; i < 12; ++i) {
      const glm::dvec3 eye = double(i) * step;
      frame = specularFrame(mirror.scene(), zoomed(cameraAt(eye, eye - step, kSize, i)), kDistance, roughness);
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        const glm::dvec3 ray = reference::rayThrough(frame.constants.rayFromPixel, reference::pixelCentre(p));
        const auto t = mirror.hit(eye, ray);
        if (!t) return;
        const glm::dvec3 point = eye + *t * ray;
        const glm::dvec3 object = point + kDistance * glm::reflect(glm::normalize(ray), mirror.normalAt(point));
        frame.lighting[p] = 1.0 + glm::sin(40.0 * object);
      });
      run.frame(frame);
    }
    return surfaceError(run.output(), frame);
  };
  const auto expectFollowed = [&](const std::string& name, double followed, double surface, double most) {
    RecordProperty(name + " followed", std::to_string(followed));
    RecordProperty(name + " surface", std::to_string(surface));
    EXPECT_LT(followed, most * surface) << name;
  };
  // Reflected light that moves with the surface makes the ratio of errors 1 or more. Bilinear history blurs, which
  // makes it .09. A filter blurs a pattern as fine as this, too, which makes it .49 in `svgf` and .34 in `walr`.
  expectFollowed("accumulate", error("accumulate", "0.42"), error("accumulate", "0"), 0.3);
  expectFollowed("svgf", error("svgf", "0.42"), error("svgf", "0"), 0.7);
  // Without a setting of reflections, but with anti-aliasing. Along the surface, the ratio is 1.06.
  expectFollowed("walr", error("walr", nullptr, 0.02), error("accumulate", "0"), 0.7);
}

// Two things that a still mirror shows side by side change places. Rough surfaces blur both, and keep history.
TEST_F(ReflectionMotionTest, MirrorsKeepNoLightOfWhatLeft) {
  const FrameDescription camera = cameraAt({}, {}, kSize, 0);
  const auto method = makeDenoiser("accumulate");
  ReflectionRun run(device(), *method);
  for (const double roughness : {0.0, 0.04, 0.2}) {
    SCOPED_TRACE(roughness);
    run.reset();
    const auto show = [&](bool brightLeft) {
      HostFrame frame = specularFrame(flatWall(), camera, 1.0, roughness);
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        const bool bright = (p.x < kSize.x / 2) == brightLeft;
        frame.lighting[p] = glm::dvec3(bright ? 4.0 : 1.0);
        frame.lightAlpha[p] = bright ? 1.0 : 2.0;
      });
      run.frame(frame);
    };
    for (int i = 0; i < 4; ++i) show(true);
    show(false);
    const Image<glm::dvec4> output = run.output();
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      if (std::abs(p.x - kSize.x / 2) <= 2) return;  // Samples around show both.
      const double now = p.x < kSize.x / 2 ? 1.0 : 4.0;
      // The mean over five frames is 3.4 for 1, and 1.6 for 4.
      if (roughness < 0.1) {
        EXPECT_EQ(output[p].r, now) << p.x << " " << p.y;
      } else {
        EXPECT_GT(std::abs(output[p].r - now), 1.0) << p.x << " " << p.y;
      }
    });
  }
}

// Where a light is alone, one pass reads the G-buffer, finds the motion and accumulates.
TEST_F(ReflectionMotionTest, OnePassDoesWhatThreeDo) {
  const auto method = makeDenoiser("walr");
  ReflectionRun joined(device(), *method, {.history = true});
  ReflectionRun apart(device(), *method, {.alone = false, .history = true});
  const Scene worlds[]{sphere(), bumpyWall(0.1), Mirror{0.5, 0.7}.scene()};
  for (const Scene& world : worlds) {
    const bool zoom = &world == &worlds[2];
    SCOPED_TRACE(&world - worlds);
    joined.reset();
    apart.reset();
    const glm::dvec3 step = zoom ? glm::dvec3(0.005, -0.004, 0.003) : glm::dvec3(0.09, 0.04, -0.03);
    for (std::uint32_t i = 0; i < 4; ++i) {
      const FrameDescription at = jittered(cameraAt(double(i) * step, (i - 1.0) * step, kSize, i), i);
      HostFrame frame = specularFrame(world, zoom ? zoomed(at) : at, 1.5, 0.2);
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        const bool sampled = (p.x + p.y + int(i)) % 5 != 0;
        frame.lightAlpha[p] = sampled ? 1.0 + 0.5 * (p.x % 2) : 0.0;
        frame.roughness[p] = double(p.x / 8 % 4) * 0.2;
        frame.lighting[p] *= 0.5 + double((7 * p.x + 3 * p.y + 5 * int(i)) % 11) / 11.0;
      });
      joined.frame(frame);
      apart.frame(frame);
    }
    // Drivers may contract the same arithmetic in other ways: some hundred roundings by 2^-24 each.
    constexpr double kArithmetic = 0x1p-16;
    for (std::size_t view = 0; view < 3; ++view) {
      const Image<glm::dvec3> one = joined.view(view);
      const Image<glm::dvec3> three = apart.view(view);
      Comparison comparison("view " + std::to_string(view));
      std::size_t seen = 0;
      std::size_t shortened = 0;
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        comparison.compared();
        comparison.colour(p, one[p], three[p], kArithmetic * glm::abs(three[p]));
        seen += one[p].x != 0.0 ? 1 : 0;
        shortened += one[p].z != 0.0 && one[p].x < 3.0 ? 1 : 0;
      });
      if (view == 1) {
        // Slopes leave hardly any miss on a smooth curved mirror.
        EXPECT_GT(shortened, zoom ? 5U : 100U);
      }
      comparison.expect(0.0);
      EXPECT_GT(seen, 500U);
    }
    // They may also tip the rounding of packed light, whose unit is 2^-7 of the brightest channel.
    const Image<glm::dvec4> one = joined.output();
    const Image<glm::dvec4> three = apart.output();
    Comparison comparison("output");
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      comparison.compared();
      const glm::dvec3 expected(three[p]);
      comparison.colour(p, glm::dvec3(one[p]), expected,
                        glm::dvec3(0x1p-7 * std::max({expected.r, expected.g, expected.b})));
    });
    comparison.expect(0.0);
  }
}

TEST_F(ReflectionMotionTest, HardCasesAreFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using enum InputConventions::MotionDepth;
  for (const auto& [name, motionDepth] : {std::pair("walr", Given), std::pair("svgf", Given),
                                          std::pair("accumulate", Given), std::pair("accumulate", Found)}) {
    SCOPED_TRACE(name);
    const auto method = makeDenoiser(name);
    ReflectionRun run(device(), *method, {.motionDepth = motionDepth});
    for (const Mirror& mirror :
         {Mirror{kInfinity, 1.55}, Mirror{0.02, 0.0}, Mirror{-0.05, 1.2}, Mirror{kInfinity, 0.0}}) {
      run.reset();
      for (std::uint32_t i = 0; i < 3; ++i) {
        const glm::dvec3 eye = double(i) * glm::dvec3(0.005, 0.003, -0.002);
        HostFrame frame = specularFrame(mirror.scene(), zoomed(cameraAt(eye, eye, kSize, i)), 1.0, 0.0);
        reference::forEachPixel(kSize, [&](glm::ivec2 p) {
          const double distances[]{0.0, 1e-7, 1.0, 6e4, kInfinity, nan, -1.0};
          frame.lightAlpha[p] = distances[(p.x / 3 + p.y / 3) % 7];
          frame.roughness[p] = double((p.x / 5) % 3) / 2.0;
          if ((p.x + p.y) % 13 == 0) frame.motion[p] = glm::dvec3(nan, kInfinity, 0.0);
        });
        run.frame(frame);
        const Image<glm::dvec4> output = run.output();
        const Image<glm::dvec3> motion = run.view(0);
        const Image<glm::dvec3> history = run.view(1);
        reference::forEachPixel(kSize, [&](glm::ivec2 p) {
          for (const glm::dvec3& v : {glm::dvec3(output[p]), motion[p], history[p]})
            EXPECT_TRUE(reference::isFinite(v)) << p.x << " " << p.y;
          const bool lit = frame.lightAlpha[p] > 0.0 && frame.depth[p] < 1e9;
          EXPECT_TRUE(!lit || output[p].g > 0.0) << p.x << " " << p.y;
        });
      }
    }
  }
}

TEST(SpecularLight, IsRefusedByNameWhereAMethodCannotTakeIt) {
  for (const std::string& name : denoiserNames()) {
    const auto views = [&] { return makeDenoiser(name)->views({.specular = true}); };
    if (name == "walr" || name == "svgf" || name == "accumulate" || name == "none") {
      EXPECT_NO_THROW((void)views());
      continue;
    }
    try {
      (void)views();
      ADD_FAILURE() << name;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(std::string(error.what()), "method '" + name +
                                               "' takes diffuse light only; methods that take specular light: walr, "
                                               "svgf, accumulate, none");
    }
  }
  const auto method = makeDenoiser("accumulate");
  const auto expectRefused = [&](const InputConventions& conventions, std::string_view why) {
    fg::test::expectError<std::invalid_argument>([&] { (void)method->views(conventions); }, {why});
  };
  expectRefused({.specular = true, .light = {.columns = 2}}, "distances, not counts");
  EXPECT_NO_THROW((void)method->views({.motionDepth = InputConventions::MotionDepth::Found, .specular = true}));
  method->set("accumulation.rejection", "depth");
  expectRefused({.specular = true}, "accumulation.rejection");
  const auto svgf = makeDenoiser("svgf");
  svgf->usePreset("paper");
  EXPECT_NO_THROW((void)svgf->views({.specular = true})) << "weighs by normals";
  for (const char* const name : {"walr", "svgf"}) {
    const auto antialiased = makeDenoiser(name);
    antialiased->set("antialiasing.object-ids", "on");
    fg::test::expectError<std::invalid_argument>([&] { (void)antialiased->views({.specular = true}); },
                                                 {"antialiasing.object-ids", "diffuse light"});
  }
  svgf->set("spatial-only", "on");
  fg::test::expectError<std::invalid_argument>([&] { (void)svgf->views({.specular = true}); }, {"spatial-only"});
}

}  // namespace
}  // namespace walr::test
