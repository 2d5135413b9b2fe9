// SVGF's passes on a device agree with the double-precision reference. The reference of each pass starts from the
// device's own results of the pass before, so that no error is carried from pass to pass.
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <glm/gtc/packing.hpp>
#include <glm/packing.hpp>

#include "passes/methods/svgf.h"
#include "tests/error_text.h"
#include "tests/passes/comparison.h"
#include "tests/passes/filter_run.h"
#include "tests/passes/reference/hash.h"
#include "tests/passes/reference/svgf.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::svgf_test {
namespace {

using fg::test::GraphRun;
using reference::forEachPixel;
using reference::Guide;
using reference::HostFrame;
using reference::Image;
using reference::kFloatRoundoff;
using reference::SvgfMoments;
using reference::SvgfPixel;

constexpr glm::ivec2 kSize(45, 31);

/// Largest relative error of a product of edge-stopping weights in single precision. Where weights matter, Vulkan's
/// log2 errs by 2^-21 and its exp by 3 + 2 abs(x) units in the last place. A cosine of decoded normals errs by about
/// eight roundings, and a plane distance, whose terms are of order 1, by about sixteen. The relative error of an
/// exponent counts most where the product of exponent and weight is largest, at 1 / e.
double weightError(const SvgfFilterSettings& settings) {
  return double(settings.sigmaNormal) * (0x1p-21 + 8.0 * kFloatRoundoff) +
         16.0 * kFloatRoundoff / double(settings.sigmaDepth) + 32.0 * kFloatRoundoff;
}

double uniform(glm::ivec2 p, std::uint32_t channel) {
  return (reference::pcg4d({p, channel, 77U}).x + 0.5) * 0x1p-32;
}

Image<Guide> guidesOf(const HostFrame& frame) {
  return reference::prepareGuides(frame, reference::Storage::Quantised);
}

/// Colours with deviations, as the variance estimate produces them: some dark, some bright, some without a sample.
Image<glm::dvec4> someColours(const Image<Guide>& guides) {
  Image<glm::dvec4> colours(guides.size());
  forEachPixel(guides.size(), [&](glm::ivec2 p) {
    for (int i = 0; i < 4; ++i)
      colours[p][i] = reference::roundToHalf(std::exp(3.0 * uniform(p, static_cast<std::uint32_t>(i)) - 2.0));
    if (uniform(p, 5) < 0.05 && guides[p].depth > 0.0) colours[p] = {0.0, 0.0, 0.0, -1.0};
  });
  return colours;
}

Image<SvgfPixel> pixelsOf(const Image<glm::dvec4>& texels) {
  Image<SvgfPixel> pixels(texels.size());
  forEachPixel(texels.size(), [&](glm::ivec2 p) {
    pixels[p].colour = glm::dvec3(texels[p]);
    pixels[p].deviation = texels[p].w;
  });
  return pixels;
}

void expectNear(double value, double expected, double tolerance, glm::ivec2 p, const std::string& what) {
  EXPECT_LE(std::abs(value - expected), tolerance)
      << what << " at (" << p.x << ", " << p.y << "): " << value << " instead of " << expected;
}

class SvgfTest : public fg::test::GpuTest {
 protected:
  /// The a-trous iterations, with a colour and its deviation as input.
  FilterRun atrous(const SvgfFilterSettings& settings) {
    return {device(), kSize, 1,
            [&](fg::Graph& graph, fg::Buffer frame, const Guides& guides, const std::vector<fg::Texture>& inputs) {
              return addSvgfAtrous(graph, frame, inputs[0], guides, {}, {}, settings);
            }};
  }
};

void expectDeviations(const Image<glm::dvec4>& result, const Image<SvgfPixel>& expected) {
  const SvgfFilterSettings settings;
  forEachPixel(result.size(), [&](glm::ivec2 p) {
    for (int i = 0; i < 3; ++i) expectNear(result[p][i], expected[p].colour[i], 0.0, p, "colour");
    if (expected[p].deviation < 0.0) {
      EXPECT_LT(result[p].w, 0.0) << "a deviation without a sample at (" << p.x << ", " << p.y << ")";
      return;
    }
    // Error of the variance, on which arithmetic acts. Its weights err twice: in the mean and in the mean square.
    const double variance = expected[p].deviation * expected[p].deviation;
    const double arithmetic = 4.0 * weightError(settings) + 64.0 * kFloatRoundoff;
    const double stored = 2.0 * expected[p].deviation * halfTolerance(expected[p].deviation, 0.0) +
                          reference::kSmallestHalf * reference::kSmallestHalf;
    expectNear(result[p].w * result[p].w, variance, arithmetic * expected[p].secondMoment + stored, p, "variance");
  });
}

/// Whether the texels of accumulated colour and moments agree with the reference.
void expectMoments(glm::dvec4 colour, glm::dvec4 moments, const SvgfMoments& m, glm::ivec2 p) {
  const double arithmetic = 64.0 * kFloatRoundoff;
  for (int c = 0; c < 3; ++c) {
    expectNear(colour[c], m.colour[c],
               m.colourError[c] + arithmetic * std::abs(m.colour[c]) + halfTolerance(m.colour[c], 0.0), p, "colour");
  }
  expectNear(moments.x, m.mean, m.momentError.x + arithmetic * m.mean + halfTolerance(m.mean, 0.0), p, "mean");
  expectNear(moments.z, m.samples, m.momentError.w + arithmetic * m.samples + halfTolerance(m.samples, 0.0), p,
             "samples");
  expectNear(moments.w, m.nearness, m.momentError.z + arithmetic * m.nearness + halfTolerance(m.nearness, 0.0), p,
             "nearness");
  const double stored = 2.0 * std::sqrt(m.variance()) * halfTolerance(std::sqrt(m.variance()), 0.0);
  const double difference = m.momentError.y + 2.0 * m.mean * m.momentError.x + arithmetic * m.square;
  expectNear(moments.y * moments.y, m.variance(), stored + difference, p, "variance");
}

/// A device's stored moments, converted to the raw ones that the reference reads.
Image<glm::dvec4> rawMoments(const Image<glm::dvec4>& moments) {
  Image<glm::dvec4> raw(moments.size());
  forEachPixel(moments.size(), [&](glm::ivec2 p) {
    const glm::dvec4 m = moments[p];
    raw[p] = {m.x, m.y * m.y + m.x * m.x, m.w, m.z};
  });
  return raw;
}

TEST_F(SvgfTest, AccumulationAgreesWithRawMoments) {
  for (const Scene& scene : {flatWall(), skyBesideSurface(), thinBars()}) {
    fg::Graph graph;
    const DenoiserInputs inputs = importInputs(graph, kSize);
    const Guides guides = importGuides(graph, kSize);
    const fg::History colour =
        graph.history("colour", {VK_FORMAT_R16G16B16A16_SFLOAT, graph.textureDesc(inputs.lighting).extent});
    const SvgfAccumulated accumulated = addSvgfAccumulation(graph, inputs, guides, colour.previous, colour.current);
    const fg::Texture colourOut = copyOut(graph, "colour out", accumulated.colour);
    const fg::Texture momentsOut = copyOut(graph, "moments out", accumulated.moments);
    GraphRun run(device(), graph, {.shared = device().pipelines()});

    reference::SvgfHistory history;
    int compared = 0;
    int undecided = 0;
    for (std::uint32_t i = 0; i < 7; ++i) {
      const glm::dvec3 position(0.05 * i, 0.02 * i, 0.0);
      HostFrame frame = renderFrame(scene, cameraAt(position, position - glm::dvec3(0.05, 0.02, 0.0), kSize, i), kSize);
      frame.lighting[{7, 9}].x = NAN;
      frame.lighting[{20, 3}].y = INFINITY;
      const Image<Guide> guideValues = guidesOf(frame);
      upload(run, inputs, frame);
      upload(run, guides, guideValues);
      uploadPrevious(run, guides, history.guides.size() == kSize ? history.guides : Image<Guide>(kSize));
      run.frame();
      const Image<glm::dvec4> colours = readHalves(run, colourOut, kSize);
      const Image<glm::dvec4> moments = readHalves(run, momentsOut, kSize);
      const Image<SvgfMoments> expected = reference::svgfAccumulate(frame, guideValues, history);
      forEachPixel(kSize, [&](glm::ivec2 p) {
        undecided += expected[p].undecided ? 1 : 0;
        ++compared;
        if (!expected[p].undecided) expectMoments(colours[p], moments[p], expected[p], p);
      });
      history = {guideValues, colours, rawMoments(moments)};
    }
    EXPECT_LT(undecided, compared / 50) << "too few pixels are left to compare";
  }
}

/// A frame of specular light. Where the distance is 0 or NaN there is no sample.
HostFrame specularFrame(const Scene& scene, std::uint32_t index) {
  HostFrame frame = renderStill(scene, kSize, index);
  frame.conventions.specular = true;
  frame.lightAlpha = Image<double>(kSize);
  frame.roughness = Image<double>(kSize);
  forEachPixel(kSize, [&](glm::ivec2 p) {
    const double distances[]{0.0, 1e-4, 0.5, 4.0, 60000.0, INFINITY, NAN};
    frame.lightAlpha[p] = reference::roundToHalf(distances[(p.x / 2 + p.y + 3 * int(index)) % 7]);
    const int roughness[]{0, 25, 51, 102, 255};
    frame.roughness[p] = roughness[(p.x / 9 + p.y / 8) % 5] / 255.0;
  });
  return frame;
}

/// SVGF's accumulation of specular light and one iteration of its filter, on given taps and a given colour.
class SpecularRun {
 public:
  SpecularRun(const fg::test::TestDevice& device, const SvgfFilterSettings& settings)
      : inputs_(importInputs(graph_, kSize, {.specular = true})),
        guides_(importGuides(graph_, kSize)),
        colour_(importHalves(graph_, "colour to filter", kSize)) {
    const fg::Extent extent = graph_.textureDesc(inputs_.lighting).extent;
    reflection_.taps = graph_.import("taps", {VK_FORMAT_R32_UINT, extent}, fg::vk::kUploaded);
    reflection_.confidence = graph_.import("confidences", {VK_FORMAT_R8_UNORM, extent}, fg::vk::kUploaded);
    const fg::History colour = graph_.history("colour", {VK_FORMAT_R16G16B16A16_SFLOAT, extent});
    const SvgfAccumulated accumulated =
        addSvgfAccumulation(graph_, inputs_, guides_, colour.previous, colour.current, {}, reflection_);
    colourOut_ = copyOut(graph_, "colour out", accumulated.colour);
    momentsOut_ = copyOut(graph_, "moments out", accumulated.moments);
    filteredOut_ = copyOut(graph_, "filtered out",
                           addSvgfAtrous(graph_, inputs_.frame, colour_, guides_, accumulated.lobes, {}, settings));
    run_ = std::make_unique<GraphRun>(device, graph_, fg::vk::ExecutorOptions{.shared = device.pipelines()});
  }
  void frame(const HostFrame& frame, const Image<Guide>& guides, const reference::SvgfReflection& reflection,
             const Image<glm::dvec4>& toFilter) {
    std::vector<std::uint32_t> taps;
    std::vector<std::uint8_t> confidences;
    forEachPixel(kSize, [&](glm::ivec2 p) {
      // Accept bits in the lowest two bits of each half (history_taps.glsl).
      const std::uint32_t accepted = reflection.accepted[p];
      taps.push_back((glm::packHalf2x16(glm::vec2(reflection.motion)) & 0xfffcfffcU) | (accepted & 3U) |
                     ((accepted >> 2U) << 16U));
      confidences.push_back(static_cast<std::uint8_t>(std::lround(255.0 * reflection.confidence[p])));
    });
    run_->fill(reflection_.taps, taps);
    run_->fill(reflection_.confidence, confidences);
    upload(*run_, inputs_, frame);
    upload(*run_, guides_, guides);
    upload(*run_, colour_, toFilter);
    run_->frame();
  }
  [[nodiscard]] Image<glm::dvec4> colours() const { return readHalves(*run_, colourOut_, kSize); }
  [[nodiscard]] Image<glm::dvec4> moments() const { return readHalves(*run_, momentsOut_, kSize); }
  [[nodiscard]] Image<glm::dvec4> filtered() const { return readHalves(*run_, filteredOut_, kSize); }

 private:
  fg::Graph graph_;
  DenoiserInputs inputs_;
  Guides guides_;
  fg::Texture colour_;
  ReflectionMotion reflection_;
  fg::Texture colourOut_;
  fg::Texture momentsOut_;
  fg::Texture filteredOut_;
  std::unique_ptr<GraphRun> run_;
};

/// Some taps, and confidences in steps of 1/255.
reference::SvgfReflection someReflection() {
  reference::SvgfReflection reflection{{0.75, -1.5}, Image<std::uint32_t>(kSize), Image<double>(kSize)};
  forEachPixel(kSize, [&](glm::ivec2 p) {
    reflection.confidence[p] = (p.x + 2 * p.y) % 3 == 0 ? 51.0 / 255.0 : 1.0;
    for (int i = 0; i < 4; ++i) {
      const glm::ivec2 tap = glm::ivec2(glm::floor(glm::dvec2(p) + reflection.motion)) + glm::ivec2(i % 2, i / 2);
      const bool inside = tap.x >= 0 && tap.y >= 0 && tap.x < kSize.x && tap.y < kSize.y;
      if (inside && uniform(p, 20 + static_cast<std::uint32_t>(i)) < 0.8) reflection.accepted[p] |= 1U << i;
    }
  });
  return reflection;
}

TEST_F(SvgfTest, SpecularLightFollowsItsTaps) {
  SpecularRun run(device(), {.iterations = 1});
  const reference::SvgfReflection reflection = someReflection();
  reference::SvgfHistory history;
  for (std::uint32_t i = 0; i < 4; ++i) {
    HostFrame frame = specularFrame(skyBesideSurface(), i);
    frame.lighting[{7, 9}].x = NAN;
    const Image<Guide> guides = guidesOf(frame);
    run.frame(frame, guides, reflection, Image<glm::dvec4>(kSize));
    const Image<glm::dvec4> colours = run.colours();
    const Image<glm::dvec4> moments = run.moments();
    const Image<SvgfMoments> expected = reference::svgfAccumulate(frame, guides, history, {}, reflection);
    forEachPixel(kSize, [&](glm::ivec2 p) { expectMoments(colours[p], moments[p], expected[p], p); });
    history = {guides, colours, rawMoments(moments)};
  }
}

TEST_F(SvgfTest, VarianceIsTemporalOrSpatial) {
  FilterRun variance(
      device(), kSize, 2,
      [](fg::Graph& graph, fg::Buffer frame, const Guides& guides, const std::vector<fg::Texture>& inputs) {
        return addSvgfVariance(graph, frame, {.colour = inputs[0], .moments = inputs[1]}, guides);
      });
  for (const auto& [name, scene] : allScenes()) {
    SCOPED_TRACE(name);
    const HostFrame frame = renderStill(scene, kSize);
    const Image<Guide> guides = guidesOf(frame);
    const Image<glm::dvec4> colours = someColours(guides);
    Image<glm::dvec4> texels(kSize);
    Image<SvgfMoments> moments(kSize);
    forEachPixel(kSize, [&](glm::ivec2 p) {
      SvgfMoments& m = moments[p];
      m.colour = glm::dvec3(colours[p]);
      if (guides[p].depth == 0.0) return;
      m.samples = std::floor(8.0 * uniform(p, 8));
      if (m.samples == 0.0) return;
      m.mean = reference::roundToHalf(uniform(p, 6));
      const double deviation = reference::roundToHalf(uniform(p, 7));
      m.square = deviation * deviation + m.mean * m.mean;
      texels[p] = {m.mean, deviation, m.samples, 0.0};
    });
    expectDeviations(variance.run(frame, guides, {colours, texels}), reference::svgfVariance(frame, guides, moments));
  }
}

TEST_F(SvgfTest, VarianceOfASingleFrameIsSpatial) {
  HostFrame frame = renderStill(sphere(), kSize);
  frame.lighting[{20, 15}].x = NAN;
  frame.lighting[{22, 15}].z = INFINITY;
  const Image<Guide> guides = guidesOf(frame);
  FilterRun variance(
      device(), kSize, 1,
      [](fg::Graph& graph, fg::Buffer constants, const Guides& textures, const std::vector<fg::Texture>& inputs) {
        return addSvgfSingleFrameVariance(graph, constants, inputs[0], textures);
      });
  expectDeviations(variance.run(frame, guides, {withAlpha(frame.lighting)}),
                   reference::svgfVariance(frame, guides, reference::svgfSingleFrame(frame, guides)));
}

void expectIteration(const Image<glm::dvec4>& result, const Image<SvgfPixel>& expected,
                     const SvgfFilterSettings& settings) {
  const double error = 2.0 * weightError(settings);
  forEachPixel(result.size(), [&](glm::ivec2 p) {
    const SvgfPixel& e = expected[p];
    for (int c = 0; c < 3; ++c) {
      const double tolerance =
          error * e.spread[c] + 100.0 * kFloatRoundoff * e.colour[c] + halfTolerance(e.colour[c], 0.0);
      expectNear(result[p][c], e.colour[c], tolerance, p, "colour");
    }
    expectNear(result[p].w, e.deviation, error * std::abs(e.deviation) + halfTolerance(e.deviation, 0.0), p,
               "deviation");
  });
}

TEST_F(SvgfTest, EveryIterationAgreesWithTheReference) {
  const std::vector<NamedScene> scenes = allScenes();
  std::vector<HostFrame> frames;
  std::vector<Image<glm::dvec4>> inputs;
  for (const auto& [name, scene] : scenes) {
    frames.push_back(renderStill(scene, kSize));
    inputs.push_back(someColours(guidesOf(frames.back())));
  }
  std::vector<Image<glm::dvec4>> previous = inputs;
  for (std::uint32_t i = 0; i < 3; ++i) {
    SvgfFilterSettings settings;
    settings.iterations = i + 1;
    FilterRun filter = atrous(settings);
    for (std::size_t s = 0; s < scenes.size(); ++s) {
      SCOPED_TRACE(std::string(scenes[s].name) + ", iteration " + std::to_string(i));
      const Image<Guide> guides = guidesOf(frames[s]);
      const Image<glm::dvec4> result = filter.run(frames[s], guides, {inputs[s]});
      expectIteration(result, reference::svgfAtrous(frames[s], guides, pixelsOf(previous[s]), 1 << i, settings),
                      settings);
      previous[s] = result;
    }
  }
}

/// Largest relative error of a product of weights with the lobe of half angle `angle`. Its direction is stored in two
/// coordinates of 16 bits, whose rounding, the half steps of both, turns it by up to 2^-15 sqrt(2) radians, that of two
/// pixels by twice as much. With a turn of t over the unit u, weight times error, t / u exp(-t^2 / 2 u^2) / u, is at
/// most exp(-1/2) / u.
double lobeWeightError(const SvgfFilterSettings& settings, double angle) {
  const double unit = std::max(double(settings.lobeShare) * angle, 1e-4);
  return std::exp(-0.5) * (2.0 * 0x1p-15 * std::sqrt(2.0) + 32.0 * kFloatRoundoff) / unit;
}

TEST_F(SvgfTest, LobesWeighAsTheReferenceSays) {
  for (const std::uint32_t radius : {2U, 3U}) {
    const SvgfFilterSettings settings{.iterations = 1, .radius = radius};
    SpecularRun run(device(), settings);
    const reference::SvgfReflection none{{}, Image<std::uint32_t>(kSize), Image<double>(kSize)};
    for (const auto& [name, scene] : allScenes()) {
      SCOPED_TRACE(std::string(name) + ", radius " + std::to_string(radius));
      const HostFrame frame = specularFrame(scene, 0);
      const Image<Guide> guides = guidesOf(frame);
      const Image<glm::dvec4> colours = someColours(guides);
      run.frame(frame, guides, none, colours);
      const Image<glm::dvec4> result = run.filtered();
      const auto lobes = svgfLobes(frame, guides, reference::svgfAccumulate(frame, guides, {}, {}, none));
      const Image<SvgfPixel> expected = reference::svgfAtrous(frame, guides, pixelsOf(colours), 1, settings, lobes);
      forEachPixel(kSize, [&](glm::ivec2 p) {
        const SvgfPixel& e = expected[p];
        const double error = 2.0 * (weightError(settings) + lobeWeightError(settings, lobes[p].angle));
        for (int c = 0; c < 3; ++c) {
          const double tolerance = std::min(error, 1.0) * e.spread[c] + 100.0 * kFloatRoundoff * e.colour[c] +
                                   halfTolerance(e.colour[c], 0.0);
          expectNear(result[p][c], e.colour[c], tolerance, p, "colour");
        }
      });
    }
  }
}

TEST_F(SvgfTest, AMirrorKeepsItsLight) {
  SpecularRun run(device(), {.iterations = 1});
  HostFrame frame = specularFrame(flatWall(), 0);
  frame.roughness = Image<double>(kSize, 0.0);
  const Image<Guide> guides = guidesOf(frame);
  Image<glm::dvec4> colours = someColours(guides);
  colours[{20, 15}] = {0.0, 0.0, 0.0, -1.0};
  run.frame(frame, guides, {{}, Image<std::uint32_t>(kSize), Image<double>(kSize)}, colours);
  const Image<glm::dvec4> result = run.filtered();
  forEachPixel(kSize, [&](glm::ivec2 p) {
    if (colours[p].w >= 0.0) expectNear(result[p].x, colours[p].x, halfTolerance(colours[p].x, 0.0), p, "light");
  });
  EXPECT_GT(result[glm::ivec2(20, 15)].x, 0.1) << "where there is no sample, neighbours lend theirs";
}

TEST_F(SvgfTest, EveryKernelSizeAgreesWithTheReference) {
  const HostFrame frame = renderStill(sphere(), kSize);
  const Image<Guide> guides = guidesOf(frame);
  const Image<glm::dvec4> colours = someColours(guides);
  for (const std::uint32_t radius : {1U, 3U, 4U}) {
    SCOPED_TRACE("radius " + std::to_string(radius));
    SvgfFilterSettings settings;
    settings.radius = radius;
    settings.iterations = 1;
    expectIteration(atrous(settings).run(frame, guides, {colours}),
                    reference::svgfAtrous(frame, guides, pixelsOf(colours), 1, settings), settings);
  }
}

TEST_F(SvgfTest, TheFilterWithoutTheLuminanceWeightAgreesWithTheReference) {
  const HostFrame frame = renderStill(sphere(), kSize);
  const Image<Guide> guides = guidesOf(frame);
  const Image<glm::dvec4> colours = someColours(guides);
  for (const std::uint32_t radius : {1U, 2U, 3U, 4U}) {
    SCOPED_TRACE("radius " + std::to_string(radius));
    const SvgfFilterSettings settings{.iterations = 1, .radius = radius, .luminanceWeight = false};
    expectIteration(atrous(settings).run(frame, guides, {colours}),
                    reference::svgfAtrous(frame, guides, pixelsOf(colours), 1, settings), settings);
  }
}

TEST_F(SvgfTest, TheFullWindowAgreesWithTheReference) {
  const HostFrame frame = renderStill(stairs(), kSize);
  const Image<Guide> guides = guidesOf(frame);
  const Image<glm::dvec4> colours = someColours(guides);
  for (const bool luminanceWeight : {true, false}) {
    const SvgfFilterSettings settings{.window = SvgfWindow::Full, .iterations = 3, .luminanceWeight = luminanceWeight};
    expectIteration(atrous(settings).run(frame, guides, {colours}),
                    reference::svgfAtrous(frame, guides, pixelsOf(colours), 1, settings), settings);
  }
}

/// Mean squared distance along x of the light into which the filter spreads one bright pixel on a wall.
double spreadOf(const Image<glm::dvec4>& response, glm::ivec2 centre) {
  double sum = 0.0;
  double squares = 0.0;
  forEachPixel(response.size(), [&](glm::ivec2 p) {
    sum += response[p].x;
    squares += response[p].x * std::pow(p.x - centre.x, 2.0);
  });
  return squares / sum;
}

TEST_F(SvgfTest, TheFullWindowIsAsWideAsTheIterations) {
  const HostFrame frame = renderStill(flatWall(), kSize);
  const Image<Guide> guides = guidesOf(frame);
  const glm::ivec2 centre(22, 15);
  Image<glm::dvec4> impulse(kSize);
  impulse[centre].x = 4096.0;
  SvgfFilterSettings settings{.iterations = 3, .luminanceWeight = false};
  const double iterated = spreadOf(atrous(settings).run(frame, guides, {impulse}), centre);
  settings.window = SvgfWindow::Full;
  const double full = spreadOf(atrous(settings).run(frame, guides, {impulse}), centre);
  double sum = 0.0;
  double squares = 0.0;
  for (int x = -14; x <= 14; ++x) {  // The reach of the iterations.
    const double gaussian = std::exp(-0.5 * x * x / 21.0);
    sum += gaussian;
    squares += gaussian * x * x;
  }
  // The variances of the binomial kernels, with spacings of 1, 2 and 4, add up to 21. On the wall weights are one up to
  // a few parts in a thousand (`WeightsAreOneOnAPlane`).
  EXPECT_NEAR(iterated, 21.0, 0.01 * 21.0);
  EXPECT_NEAR(full, squares / sum, 0.01 * 21.0);
}

TEST_F(SvgfTest, AFullWindowThatReachesTooFarIsRefused) {
  fg::Graph graph;
  SvgfSettings settings;
  settings.filter.window = SvgfWindow::Full;
  settings.filter.iterations = 6;
  const DenoiserInputs inputs = importInputs(graph, kSize);
  const fg::Texture output = importOutput(graph, kSize);
  fg::test::expectError([&] { addSvgf(graph, inputs, output, settings); }, {"253 pixels"});
}

TEST_F(SvgfTest, WeightsAreOneOnAPlane) {
  const HostFrame frame = renderStill(flatWall(), kSize);
  const Image<Guide> guides = guidesOf(frame);
  Image<glm::dvec4> colours = someColours(guides);
  for (glm::dvec4& colour : colours.pixels()) colour.w = std::abs(colour.w);
  SvgfFilterSettings settings;
  settings.iterations = 1;
  settings.luminanceWeight = false;
  const Image<glm::dvec4> result = atrous(settings).run(frame, guides, {colours});

  // Rounded depths and normals deviate a little from the plane: a depth by its rounding, and a normal tilted by two
  // steps moves the plane at a tenth of the depth away by a fifth of a step. The cosine of such a tilt is 1.
  const double distance = 2.0 * reference::kDepthRoundoff + 0.2 * 2.0 * reference::kUnorm16Step;
  const double weights = distance / double(settings.sigmaDepth) + weightError(settings);
  constexpr double kSpline[] = {1.0, 4.0, 6.0, 4.0, 1.0};
  for (int y = 2; y < kSize.y - 2; ++y) {
    for (int x = 2; x < kSize.x - 2; ++x) {
      glm::dvec3 mean(0.0);
      for (int j = 0; j < 5; ++j)
        for (int i = 0; i < 5; ++i)
          mean += kSpline[i] * kSpline[j] / 256.0 * glm::dvec3(colours[{x + i - 2, y + j - 2}]);
      for (int c = 0; c < 3; ++c) {
        // No tap differs from the mean by more than the largest colour, exp(1).
        expectNear(result[{x, y}][c], mean[c], 2.0 * weights * std::exp(1.0) + halfTolerance(mean[c], 0.0), {x, y},
                   "colour");
      }
    }
  }
}

TEST_F(SvgfTest, FeedbackBeyondTheLastIterationIsRefused) {
  fg::Graph graph;
  SvgfSettings settings;
  settings.filter.iterations = 2;
  settings.filter.feedback = 3;
  const DenoiserInputs inputs = importInputs(graph, kSize);
  const fg::Texture output = importOutput(graph, kSize);
  EXPECT_THROW(addSvgf(graph, inputs, output, settings), std::invalid_argument);
  settings.filter.iterations = 4;
  settings.filter.window = SvgfWindow::Full;
  try {
    addSvgf(graph, inputs, output, settings);
    FAIL() << "the full window is one iteration";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("svgf.window=atrous"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace walr::test::svgf_test
