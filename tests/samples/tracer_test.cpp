// The sample host's tracer on the processor. No device is needed.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "samples/denoise/frame_output.h"
#include "samples/host/tracer.h"
#include "samples/image/exposure.h"
#include "samples/render/film.h"
#include "samples/render/load_scene.h"
#include "samples/render/render_sequence.h"
#include "samples/render/view.h"
#include "samples/sequence/sequence.h"
#include "tests/render/gltf_builder.h"
#include "tests/samples/host_tracing.h"
#include "tests/samples/temporary_directory.h"

namespace walr::host {
namespace {

TEST(Tracer, ExposureMapsTheScenesLuminanceToMiddleGrey) {
  Tracer::Options options = tracing();
  Tracer tracer(options);
  const float stops = tracer.exposure(0.0);
  options.referenceSamples = 512;
  Tracer fine(options);
  const Frame frame = fine.trace({.reference = true});
  const std::optional<float> expected =
      autoExposure(composite(frame.reference->indirect, frame.reference->direct, frame.albedo, frame.emission));
  ASSERT_TRUE(expected.has_value());
  // Luminances of this picture spread by about 2 stops, and the small picture has 64 x 36 pixels: 2 / 48 = .04 stops.
  // Noise of relative variance v lowers a mean of logarithms by about .7 v stops: .05 for the 64 samples.
  EXPECT_NEAR(stops, *expected, 0.1);
}

double meanSquaredDifference(const Image& a, const Image& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    const double difference = static_cast<double>(a.values()[i]) - b.values()[i];
    sum += difference * difference;
  }
  return sum / static_cast<double>(a.values().size());
}

// The same count as that of the path tracer alone; and a reference's rays count, too.
TEST(Tracer, CountsTheRaysOfAFrameAndMeasuresTheirTime) {
  Tracer::Options options = tracing();
  options.samples = 2;
  Tracer tracer(options);
  const render::Scene scene = render::loadScene(options.scene);
  const render::World world(scene);
  const render::View view =
      render::viewFrom(world, render::findCamera(scene, ""), kExtent.width, kExtent.height, {}, {});
  const std::uint64_t expected = render::renderFilm(world, view, {.samples = options.samples}).rays;
  EXPECT_GT(expected, std::uint64_t{kExtent.width} * kExtent.height);
  const TracedRays traced = tracer.hostFrame({}).traced;
  EXPECT_EQ(traced.rays, expected);
  ASSERT_TRUE(traced.perSecond().has_value());
  EXPECT_DOUBLE_EQ(*traced.perSecond() * traced.seconds, static_cast<double>(expected));
  EXPECT_EQ(TracedRays{}.perSecond(), std::nullopt);
  EXPECT_GT(tracer.hostFrame({.number = 1, .reference = true}).traced.rays, expected + expected / 4);
}

TEST(Tracer, ReferencesAddUpWhileNothingMoves) {
  Tracer tracer(tracing());
  Tracer other([] {
    Tracer::Options options = tracing();
    options.seed = 9;
    options.referenceSamples = 64;
    return options;
  }());
  const Image converged = other.trace({.reference = true}).reference->indirect;
  Tracer::Request request{.reference = true};
  const double first = meanSquaredDifference(tracer.trace(request).reference->indirect, converged);
  Frame frame;
  for (request.number = 1; request.number < 16; ++request.number) {
    frame = tracer.trace(request);
  }
  // Ratio of the variance of one sample to that of sixteen, each compared with a reference of 64 samples:
  // (1 + 1/64) / (1/16 + 1/64) = 13 for independent random numbers, more for Sobol points. The relative spread of two
  // such means is below a third.
  EXPECT_GT(first / meanSquaredDifference(frame.reference->indirect, converged), 8.0);
  request.animationFrame = 9.0;
  const double moved = meanSquaredDifference(tracer.trace(request).reference->indirect, converged);
  EXPECT_GT(moved, 0.5 * first);
}

TEST(Tracer, DirectLightJoinsTheIndirectOnDemand) {
  Tracer::Options options = tracing();
  Tracer apart(options);
  options.denoiseDirect = true;
  Tracer together(options);
  const Tracer::Request request{.reference = true};
  const Frame both = apart.trace(request);
  const Frame sum = together.trace(request);
  for (std::size_t i = 0; i < both.indirect.values().size(); ++i) {
    ASSERT_EQ(sum.indirect.values()[i], both.indirect.values()[i] + both.direct.values()[i]);
    ASSERT_EQ(sum.reference->indirect.values()[i],
              both.reference->indirect.values()[i] + both.reference->direct.values()[i]);
    ASSERT_EQ(sum.direct.values()[i] + sum.reference->direct.values()[i], 0.0F);
  }
}

TEST(Tracer, FollowsTheFrameBefore) {
  Tracer tracer(tracing("turntable.gltf"));
  const glm::vec4 bounds = tracer.bounds();
  const Frame first = tracer.trace({.number = 12, .animationFrame = 12.0});
  EXPECT_TRUE(first.resetHistory);
  EXPECT_EQ(first.camera.view, first.camera.previousView);
  EXPECT_EQ(first.camera.view, tracer.sceneCamera(12.0));
  const Frame second = tracer.trace({.number = 13, .animationFrame = 14.0});
  EXPECT_FALSE(second.resetHistory);
  EXPECT_EQ(second.camera.previousView, first.camera.view);
  EXPECT_EQ(second.camera.view, tracer.sceneCamera(14.0));
  const Frame cut = tracer.trace({.number = 14, .animationFrame = 14.0, .view = glm::mat4(1.0F), .cut = true});
  EXPECT_TRUE(cut.resetHistory);
  EXPECT_EQ(cut.camera.view, glm::mat4(1.0F));
  EXPECT_EQ(tracer.lastAnimationFrame(), 47);
  EXPECT_GT(bounds.w, 2.0F);
  // The window asks for them while another thread moves the scene.
  EXPECT_EQ(tracer.bounds(), bounds);
}

// As a float, the time of frame 95 is a little before that frame.
TEST(Tracer, RoundsTheLastFrameOfAnAnimation) {
  const test::TemporaryDirectory folder;
  render::test::GltfBuilder builder;
  builder.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const auto end = static_cast<float>(95.0 / 24.0);
  const std::size_t input = builder.accessor<float>(render::test::GltfBuilder::Float, "SCALAR", {0, end});
  const std::size_t output = builder.accessor<float>(render::test::GltfBuilder::Float, "VEC3", {0, 0, 0, 0, 0, 1});
  builder.json["animations"] = {{{"samplers", {{{"input", input}, {"output", output}}}},
                                 {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  Tracer::Options options = tracing();
  options.scene = builder.write(folder.path());
  EXPECT_LT(double{end} * options.framesPerSecond, 95.0);
  EXPECT_EQ(Tracer(options).lastAnimationFrame(), 95);
  options.framesPerSecond = 1e6;  // An end that is not close to a frame of the slower clock.
  EXPECT_EQ(Tracer(options).lastAnimationFrame(), std::lround(double{end} * 1e6));
}

// The camera moves from frame 4 on.
TEST(Tracer, ResamplesAsWalrRenderDoes) {
  const test::TemporaryDirectory folder;
  render::RenderOptions options;
  options.scene = tracing().scene;
  options.output = folder.path();
  options.firstFrame = 2;
  options.lastFrame = 8;
  options.width = kExtent.width;
  options.height = kExtent.height;
  options.resampledFrames = 20;
  render::renderSequence(options, {});
  const Sequence sequence(folder.path(), {});
  Tracer tracer(tracing());
  Tracer plain(tracing());
  for (int number = options.firstFrame; number <= options.lastFrame; ++number) {
    const Frame expected = sequence.read(static_cast<std::size_t>(number - options.firstFrame));
    ASSERT_EQ(expected.number, number);
    Tracer::Request request{.number = number, .animationFrame = double(number)};
    const Image light = plain.trace(request).indirect;
    request.resampledFrames = options.resampledFrames;
    const Image resampled = inHalves(tracer.trace(request).indirect);
    EXPECT_TRUE(std::ranges::equal(resampled.values(), expected.indirect.values())) << number;
    EXPECT_FALSE(std::ranges::equal(inHalves(light).values(), expected.indirect.values())) << number;
  }
}

// Each of these leaves the light of the next frame as it is in a first frame.
TEST(Tracer, DropsSamplesWithTheHistory) {
  const auto light = [](Tracer& tracer, const Tracer::Request& request) { return tracer.trace(request).indirect; };
  const Tracer::Request usual{.number = 5, .resampledFrames = 20};
  const auto changed = [&](const std::function<void(Tracer::Request&)>& change) {
    Tracer::Request request = usual;
    change(request);
    return request;
  };
  struct Case {
    const char* name;
    Tracer::Request request;
    bool drops;
  };
  const std::vector<Case> cases{
      {"none", usual, false},
      {"a camera cut", changed([](Tracer::Request& request) { request.cut = true; }), true},
      {"a reset", changed([](Tracer::Request& request) { request.resetHistory = true; }), true},
      {"another size", changed([](Tracer::Request& request) {
         request.extent = {36, 20};
       }),
       true},
      {"another number", changed([](Tracer::Request& request) { request.resampledFrames = 19; }), true},
  };
  for (const Case& each : cases) {
    Tracer tracer(tracing());
    for (int number = 3; number < usual.number; ++number) light(tracer, {.number = number, .resampledFrames = 20});
    Tracer fresh(tracing());
    const bool same = std::ranges::equal(light(tracer, each.request).values(), light(fresh, each.request).values());
    EXPECT_EQ(same, each.drops) << each.name;
  }
  // A frame without resampling, and another scene.
  Tracer tracer(tracing());
  light(tracer, {.number = 3, .resampledFrames = 20});
  light(tracer, {.number = 4});
  Tracer fresh(tracing());
  EXPECT_TRUE(std::ranges::equal(light(tracer, usual).values(), light(fresh, usual).values()));
  tracer.show(tracer.read(tracing("turntable.gltf").scene));
  Tracer turntable(tracing("turntable.gltf"));
  EXPECT_TRUE(std::ranges::equal(light(tracer, usual).values(), light(turntable, usual).values()));
}

TEST(Tracer, RefusesToResampleSparseLight) {
  Tracer::Options options = tracing();
  EXPECT_EQ(Tracer(options).whyNotResampled(), "");
  options.light = {.columns = 2, .rows = 2};
  Tracer tracer(options);
  EXPECT_NE(tracer.whyNotResampled(), "");
  EXPECT_THROW(tracer.trace({.resampledFrames = 20}), std::invalid_argument);
}

}  // namespace
}  // namespace walr::host
