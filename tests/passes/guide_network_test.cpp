// The network of FLNR: each layer and the whole against double precision, and against what PyTorch computes.
#include "passes/network/guide_network.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>

#include <glm/gtc/packing.hpp>

#include "passes/network/network_weights.h"
#include "passes/regression/flr_regression.h"
#include "tests/error_text.h"
#include "tests/passes/comparison.h"
#include "tests/passes/filter_run.h"
#include "tests/passes/reference/flr.h"
#include "tests/passes/reference/guide_network.h"
#include "tests/passes/reference/hash.h"
#include "tests/passes/shaders.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test {
namespace {

using reference::ChannelImage;
using reference::forEachPixel;
using reference::Guide;
using reference::Image;
using reference::Storage;
using reference::Sums;

GuideNetwork networkOf(NetworkKind kind) {
  return {kind, kFlnrWidths, flnrWeights(kind)};
}

/// A network with trained weights, and its name.
struct NamedNetwork {
  std::string name;
  GuideNetwork network;
};

std::vector<NamedNetwork> allNetworks() {
  return {{"flnr_small", networkOf(NetworkKind::Small)},
          {"flnr_full", networkOf(NetworkKind::Full)},
          {"flnr_paper", networkOf(NetworkKind::Paper)}};
}

fg::Extent extentOf(glm::ivec2 size) {
  return {std::uint32_t(size.x), std::uint32_t(size.y)};
}

/// Uniform in -1..1, exact as a half.
double randomHalf(int index, std::uint32_t stream) {
  const std::uint32_t word = reference::pcg4d({std::uint32_t(index), std::uint32_t(index) / 1000U, stream, 0U}).x;
  return reference::roundToHalf(double(word) * 0x1p-31 - 1.0);
}

ChannelImage randomImage(glm::ivec2 size, std::uint32_t count, std::uint32_t stream) {
  ChannelImage image(size, count);
  for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = randomHalf(int(i), stream);
  return image;
}

/// Halves in the order of halves.glsl.
std::vector<std::uint16_t> packed(const ChannelImage& image) {
  std::vector<std::uint16_t> halves;
  for (std::size_t group = 0; group < image.count / 4; ++group) {
    forEachPixel(image.size, [&](glm::ivec2 p) {
      for (std::size_t c = 0; c < 4; ++c) halves.push_back(glm::packHalf1x16(float(image.at(4 * group + c, p))));
    });
  }
  return halves;
}

struct LayerCase {
  glm::ivec2 size;
  std::uint32_t first;
  LayerInput input;
  std::uint32_t second;
  std::uint32_t count;
};

/// A test that can run networks with arithmetic in single precision or in halves.
class NetworkTest : public fg::test::GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    const fg::vk::PhysicalDevice physical = fg::vk::physicalDevices(instance()).front();
    if (physical.shaderFloat16)
      halves_.emplace(instance(), physical, std::span<const char* const>{}, nullptr,
                      fg::vk::HalfArithmetic::WhereSupported);
  }
  void TearDown() override {
    halves_.reset();
    GpuTest::TearDown();
  }
  /// Devices with single precision and, where they have it, with halves.
  [[nodiscard]] std::vector<Sums> arithmetics() const {
    return halves_ ? std::vector{Sums::Exact, Sums::InHalves} : std::vector{Sums::Exact};
  }
  [[nodiscard]] const fg::test::TestDevice& deviceWith(Sums sums) const {
    return sums == Sums::InHalves ? *halves_ : device();
  }

 private:
  std::optional<fg::test::TestDevice> halves_;
};

const char* nameOf(Sums sums) {
  return sums == Sums::InHalves ? "in halves" : "in single precision";
}

class GuideNetworkLayers : public NetworkTest {
 protected:
  /// A layer's result on a device, in the order of halves.glsl.
  static std::vector<std::uint16_t> run(const fg::test::TestDevice& device, const LayerCase& layer,
                                        const ChannelImage& first, const ChannelImage& second,
                                        const std::vector<std::uint16_t>& weights) {
    const std::vector<std::uint16_t> firstHalves = packed(first);
    const std::vector<std::uint16_t> secondHalves = packed(second);
    fg::Graph graph;
    Convolution convolution{
        .first = {graph.upload("first", std::as_bytes(std::span(firstHalves))), extentOf(first.size), layer.first},
        .input = layer.input,
        .extent = extentOf(layer.size),
        .count = layer.count};
    if (layer.second > 0) {
      convolution.second = {graph.upload("second", std::as_bytes(std::span(secondHalves))), extentOf(second.size),
                            layer.second};
    }
    const fg::Buffer bound = graph.upload("weights", std::as_bytes(std::span(weights)));
    std::uint64_t offset = 0;
    const Channels result = addConvolution(graph, "layer", convolution, bound, offset);
    EXPECT_EQ(offset, weights.size() * sizeof(std::uint16_t));
    const std::uint32_t words = layer.count * std::uint32_t(layer.size.x * layer.size.y) / 2;
    const fg::Buffer target = graph.import("result", fg::BufferDesc{words * 4ULL}, fg::vk::kOverwritable);
    fg::PassBuilder copy = graph.compute("copy", shaders::copyWords);
    copy.load("source", result.buffer).constants(words).dispatch({8 * ((words + 63) / 64), 8});
    graph.exported(copy.store("target", target), fg::vk::kReadable);
    fg::test::GraphRun graphRun(device, graph, {.shared = device.pipelines()});
    const std::uint32_t slot = graphRun.submitFrame();
    graphRun.finish();
    return graphRun.elements<std::uint16_t>(target, slot);
  }
};

/// Rounding: each term rounds in the product and in at most as many additions as there are terms; the result is a half.
/// In halves, it rounds so in the sum of its four inputs' 36 terms, and that in those of single precision.
double roundingOf(Sums sums, std::uint32_t inputs) {
  constexpr double kHalfRoundoff = 0x1p-11;
  const double single = (9.0 * inputs + 1.0) * reference::kFloatRoundoff;
  return sums == Sums::InHalves ? 37.0 * kHalfRoundoff + single : single;
}

TEST_F(GuideNetworkLayers, AgreeWithDoublePrecision) {
  for (const LayerCase& layer :
       {LayerCase{{17, 13}, 32, LayerInput::AsItIs, 0, 16}, LayerCase{{1, 1}, 16, LayerInput::AsItIs, 0, 8},
        LayerCase{{9, 7}, 16, LayerInput::Pooled, 0, 24}, LayerCase{{1, 1}, 8, LayerInput::Pooled, 0, 8},
        LayerCase{{17, 13}, 24, LayerInput::Grown, 16, 16}, LayerCase{{40, 33}, 8, LayerInput::AsItIs, 8, 8}}) {
    const std::string name = std::to_string(layer.size.x) + " x " + std::to_string(layer.size.y) + ", " +
                             std::to_string(layer.first) + " + " + std::to_string(layer.second) + " channels";
    SCOPED_TRACE(name);
    const glm::ivec2 odd = glm::max(2 * layer.size - 1, 1);
    const glm::ivec2 firstSize = layer.input == LayerInput::Pooled  ? odd
                                 : layer.input == LayerInput::Grown ? (layer.size + 1) / 2
                                                                    : layer.size;
    const ChannelImage first = randomImage(firstSize, layer.first, 1);
    const ChannelImage second = randomImage(layer.size, layer.second, 2);
    const std::uint32_t inputs = layer.first + layer.second;
    std::vector<double> weights(layer.count * (9 * inputs + 1));
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = randomHalf(int(i), 3);
    const ChannelImage seen = layer.input == LayerInput::Pooled  ? reference::pooled(first)
                              : layer.input == LayerInput::Grown ? reference::grown(first, layer.size)
                                                                 : first;
    const reference::LayerResult expected =
        reference::convolution(reference::joined(seen, second), weights, layer.count);
    for (const Sums sums : arithmetics()) {
      const std::vector<std::uint16_t> actual =
          run(deviceWith(sums), layer, first, second, reference::packConvolution(weights, inputs, layer.count));
      Comparison comparison(name + ", " + nameOf(sums));
      std::size_t i = 0;
      for (std::size_t group = 0; group < layer.count / 4; ++group) {
        forEachPixel(layer.size, [&](glm::ivec2 p) {
          comparison.compared();
          for (std::size_t c = 4 * group; c < 4 * group + 4; ++c) {
            const double error = roundingOf(sums, inputs) * expected.magnitudes.at(c, p);
            const double value = expected.values.at(c, p);
            comparison.value(p, "channel", double(glm::unpackHalf1x16(actual[i++])), value,
                             halfTolerance(value, error));
          }
        });
      }
      comparison.expect(0.0);
    }
  }
}

/// What the network sees, and what PyTorch makes of it with the committed weights: samples/training/export_weights.py.
struct Fixture {
  Image<Guide> guides;
  Image<glm::dvec4> lighting;  ///< Alpha: samples.
  ChannelImage learned;
};

/// @param of one of allNetworks(); a line of the file holds the guides of all of them in their order
Fixture readFixture(const NamedNetwork& of) {
  const std::string file = WALR_PASS_FIXTURES "/flnr.txt";
  std::ifstream in(file);
  glm::ivec2 size(0);
  in >> size.x >> size.y;
  if (!in) throw std::runtime_error(file + ": cannot be read");
  Fixture fixture{Image<Guide>(size), Image<glm::dvec4>(size),
                  ChannelImage(size, reference::guideCount(of.network.kind))};
  const std::vector<NamedNetwork> networks = allNetworks();
  forEachPixel(size, [&](glm::ivec2 p) {
    glm::dvec2 steps(0.0);
    double occlusion = 0.0;
    glm::dvec4& light = fixture.lighting[p];
    in >> steps.x >> steps.y >> fixture.guides[p].depth >> occlusion >> light.x >> light.y >> light.z >> light.w;
    for (const NamedNetwork& network : networks) {
      for (std::size_t g = 0; g < reference::guideCount(network.network.kind); ++g) {
        double guide = 0.0;
        in >> guide;
        if (network.name == of.name) fixture.learned.at(g, p) = guide;
      }
    }
    fixture.guides[p].features = steps * reference::kUnorm12Step;
    fixture.guides[p].occlusion = occlusion * reference::kUnorm8Step;
  });
  if (!in) throw std::runtime_error(file + ": ends early");
  return fixture;
}

/// Guides and light of a scene, of which some pixels have no sample.
Fixture sceneFixture(glm::ivec2 size) {
  const reference::HostFrame frame = renderStill(stairs(), size);
  Fixture fixture{
      reference::prepareGuides(frame, Storage::Quantised, {}, kOcclusionInSmallImages), withAlpha(frame.lighting), {}};
  forEachPixel(size, [&](glm::ivec2 p) {
    fixture.lighting[p].w = (p.x + 2 * p.y) % 5;
    if ((p.x + p.y) % 7 == 3) fixture.lighting[p].y = NAN;
  });
  return fixture;
}

ChannelImage expectedGuides(const Fixture& fixture, const GuideNetwork& network, Storage storage,
                            Sums sums = Sums::Exact) {
  return reference::guideNetwork(fixture.guides, fixture.lighting, network, storage, sums);
}

double largestDifference(const ChannelImage& a, const ChannelImage& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.values.size(); ++i) largest = std::max(largest, std::abs(a.values[i] - b.values[i]));
  return largest;
}

class WholeGuideNetwork : public NetworkTest {
 protected:
  /// @param more which of the two textures with guides
  Image<glm::dvec4> run(Sums sums, const Fixture& fixture, const GuideNetwork& network, bool more) {
    FilterRun filter(
        deviceWith(sums), fixture.guides.size(), 1,
        [&](fg::Graph& graph, fg::Buffer, const Guides& guides, const auto& inputs) {
          const LearnedGuides learned = addGuideNetwork(graph, inputs[0], LightingAlpha::SampleCount, guides, network);
          return more ? learned.more : learned.first;
        },
        true);
    return filter.run({}, fixture.guides, {fixture.lighting});
  }
  /// The guides of both textures.
  ChannelImage run(Sums sums, const Fixture& fixture, const GuideNetwork& network) {
    ChannelImage result(fixture.guides.size(), reference::guideCount(network.kind));
    const std::size_t inFirst = std::min<std::size_t>(result.count, 4);
    const Image<glm::dvec4> first = run(sums, fixture, network, false);
    const Image<glm::dvec4> more = result.count > inFirst ? run(sums, fixture, network, true) : Image<glm::dvec4>{};
    forEachPixel(result.size, [&](glm::ivec2 p) {
      for (std::size_t g = 0; g < inFirst; ++g) result.at(g, p) = first[p][glm::length_t(g)];
      for (std::size_t g = inFirst; g < result.count; ++g) result.at(g, p) = more[p][glm::length_t(g - inFirst)];
    });
    return result;
  }
  /// The results of layers are halves, and with arithmetic in halves their sums. What that changes is measured in
  /// double precision; the device rounds other values up and down, so that it may err as much in the other direction.
  void expectGuides(const Fixture& fixture, const GuideNetwork& network, const ChannelImage& expected, double further) {
    const ChannelImage exact = expectedGuides(fixture, network, Storage::Exact);
    for (const Sums sums : arithmetics()) {
      const double rounding =
          2.0 * largestDifference(expectedGuides(fixture, network, Storage::Quantised, sums), exact);
      const ChannelImage actual = run(sums, fixture, network);
      Comparison comparison(std::string("learned guides, ") + nameOf(sums));
      forEachPixel(expected.size, [&](glm::ivec2 p) {
        comparison.compared();
        for (std::size_t g = 0; g < expected.count; ++g) {
          const double value = expected.at(g, p);
          comparison.value(p, "guide", actual.at(g, p), value, halfTolerance(value, rounding + further));
        }
      });
      comparison.expect(0.0);
    }
  }
};

TEST_F(WholeGuideNetwork, AgreesWithDoublePrecision) {
  for (const NamedNetwork& of : allNetworks()) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(2, 4), glm::ivec2(45, 34), glm::ivec2(90, 19)}) {
      SCOPED_TRACE(of.name + " " + std::to_string(size.x) + " x " + std::to_string(size.y));
      const Fixture fixture = sceneFixture(size);
      expectGuides(fixture, of.network, expectedGuides(fixture, of.network, Storage::Exact), 0.0);
    }
  }
}

/// PyTorch computes in single precision. Fifteen layers of up to 721 terms, whose roundings are independent, err by
/// less than this.
constexpr double kSinglePrecision = 1e-4;

// The device reads depths of fewer bits than PyTorch did. What that changes is measured in double precision.
TEST_F(WholeGuideNetwork, AgreesWithPyTorch) {
  for (const NamedNetwork& of : allNetworks()) {
    SCOPED_TRACE(of.name);
    const Fixture fixture = readFixture(of);
    Fixture stored = fixture;
    forEachPixel(stored.guides.size(), [&](glm::ivec2 p) {
      stored.guides[p].depth = reference::roundDepthBesideNormal(stored.guides[p].depth);
    });
    const double byDepth = largestDifference(expectedGuides(stored, of.network, Storage::Exact),
                                             expectedGuides(fixture, of.network, Storage::Exact));
    EXPECT_LT(byDepth, 0.01);
    expectGuides(stored, of.network, fixture.learned, kSinglePrecision + byDepth);
  }
}

TEST(GuideNetworkReference, AgreesWithPyTorch) {
  for (const NamedNetwork& of : allNetworks()) {
    SCOPED_TRACE(of.name);
    const Fixture fixture = readFixture(of);
    EXPECT_LE(largestDifference(expectedGuides(fixture, of.network, Storage::Exact), fixture.learned),
              kSinglePrecision);
  }
}

TEST_F(WholeGuideNetwork, GivesTheSameBitsInEveryRun) {
  const Fixture fixture = sceneFixture({45, 34});
  for (const NamedNetwork& of : allNetworks()) {
    for (const Sums sums : arithmetics()) {
      const ChannelImage first = run(sums, fixture, of.network);
      EXPECT_EQ(run(sums, fixture, of.network).values, first.values) << of.name << ' ' << nameOf(sums);
    }
  }
}

TEST_F(WholeGuideNetwork, IsComputedInHalvesWhereTheDeviceHasThem) {
  if (arithmetics().size() < 2) GTEST_SKIP() << "the device has no feature shaderFloat16";
  const Fixture fixture = sceneFixture({45, 34});
  const GuideNetwork network = networkOf(NetworkKind::Small);
  EXPECT_NE(run(Sums::InHalves, fixture, network).values, run(Sums::Exact, fixture, network).values);
}

class FlrOnLearnedGuides : public fg::test::GpuTest {
 protected:
  /// @param count 3: beside the geometric guides; 5: in their place
  void expectAgreement(std::size_t count) {
    constexpr glm::ivec2 kSize(45, 34);
    const FlrRegressionSettings settings;
    FilterRun run(
        device(), kSize, 3,
        [&](fg::Graph& graph, fg::Buffer, const Guides& guides, const auto& inputs) {
          const fg::Texture filtered = graph.texture("filtered", graph.textureDesc(inputs[0]));
          const LearnedGuides learned{inputs[1], count == 5 ? inputs[2] : fg::Texture{}};
          return addFlrRegression(graph, inputs[0], LightingAlpha::Unused, guides, filtered, settings, learned);
        },
        true);
    ChannelImage learned(kSize, count);
    for (std::size_t i = 0; i < learned.values.size(); ++i)
      learned.values[i] = reference::roundToHalf(0.5 + 0.5 * randomHalf(int(i), 10));
    const auto textureOf = [&](std::size_t first) {
      Image<glm::dvec4> image(kSize);
      forEachPixel(kSize, [&](glm::ivec2 p) {
        for (std::size_t g = first; g < std::min(count, first + 4); ++g)
          image[p][glm::length_t(g - first)] = learned.at(g, p);
      });
      return image;
    };
    for (const NamedScene& scene : allScenes()) {
      const reference::HostFrame frame = renderStill(scene.scene, kSize);
      const Image<Guide> guides = reference::prepareGuides(frame, Storage::Quantised, {}, kOcclusionInSmallImages);
      const auto expected = reference::flrRegression(guides, frame.lighting, settings, &learned);
      const Image<glm::dvec4> actual = run.run({}, guides, {withAlpha(frame.lighting), textureOf(0), textureOf(4)});
      Comparison comparison(scene.name);
      forEachPixel(kSize, [&](glm::ivec2 p) {
        comparison.compared();
        comparison.colour(p, actual[p], expected[p].colour, halfTolerance(expected[p].colour, expected[p].error));
      });
      comparison.expect(0.0);
    }
  }
};

TEST_F(FlrOnLearnedGuides, BesideTheGeometricOnesAgreesWithTheReference) {
  expectAgreement(3);
}

TEST_F(FlrOnLearnedGuides, InTheirPlaceAgreesWithTheReference) {
  expectAgreement(5);
}

TEST(GuideNetworkSettings, WeightsOfOtherWidthsAreRefused) {
  fg::Graph graph;
  const fg::Texture lighting = graph.texture("lighting", {VK_FORMAT_R16G16B16A16_SFLOAT, {64, 64}});
  const GuideNetwork wide{NetworkKind::Small, {32, 24, 32, 48}, flnrWeights(NetworkKind::Small)};
  fg::test::expectError([&] { addGuideNetwork(graph, lighting, LightingAlpha::Unused, {}, wide); },
                        {"weights", std::to_string(wide.weights.size()), "widths"});
}

TEST(GuideNetworkSettings, APictureTooLargeForABufferIsRefused) {
  fg::Graph graph;
  const fg::Texture lighting = graph.texture("lighting", {VK_FORMAT_R16G16B16A16_SFLOAT, {7680, 4320}});
  fg::test::expectError(
      [&] { addGuideNetwork(graph, lighting, LightingAlpha::Unused, {}, networkOf(NetworkKind::Small)); },
      {"encoded guides", "smaller picture"});
}

}  // namespace
}  // namespace walr::test
