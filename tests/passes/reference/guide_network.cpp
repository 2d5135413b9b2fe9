#include "tests/passes/reference/guide_network.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/common.hpp>
#include <glm/gtc/packing.hpp>

#include "tests/passes/reference/octahedral.h"

namespace walr::reference {
namespace {

constexpr std::size_t kTaps = 9;
constexpr std::size_t kFeatures = 8;
constexpr double kSlope = 0.1;

/// Position in the shader's weights of that of a result, an input and a tap.
std::size_t packedIndex(std::size_t output, std::size_t input, std::size_t tap, std::size_t inputs) {
  const std::size_t eight = (output / 8 * (inputs / 4) + input / 4) * kTaps + tap;
  return (eight * 4 + input % 4) * 8 + output % 8;
}

double halfAt(std::span<const std::uint16_t> halves, std::size_t i) {
  return double(glm::unpackHalf1x16(halves[i]));
}

template <typename Visit>
void forEachWeight(std::size_t inputs, std::size_t outputs, Visit visit) {
  for (std::size_t o = 0; o < outputs; ++o)
    for (std::size_t i = 0; i < inputs; ++i)
      for (std::size_t t = 0; t < kTaps; ++t) visit((o * inputs + i) * kTaps + t, packedIndex(o, i, t, inputs));
  for (std::size_t o = 0; o < outputs; ++o) visit(outputs * inputs * kTaps + o, outputs * inputs * kTaps + o);
}

bool hasSample(const Guide& guide, glm::dvec4 light) {
  return guide.depth > 0.0 && std::isfinite(light.x) && std::isfinite(light.y) && std::isfinite(light.z) &&
         light.w > 0.0;
}

glm::dvec3 usableLight(glm::dvec4 light) {
  return glm::clamp(glm::dvec3(light), 0.0, kLargestHalf);
}

void roundAll(ChannelImage& image, Storage storage) {
  if (storage == Storage::Exact) return;
  for (double& value : image.values) value = roundToFiniteHalf(value);
}

/// Which of the pixels of its texel a pixel is.
std::size_t placeOf(glm::ivec2 p, int shrink) {
  return std::size_t(p.x % shrink + shrink * (p.y % shrink));
}

/// What the network sees. Each `shrink` x `shrink` pixels are a texel.
ChannelImage encodedGuides(const Image<Guide>& guides, const Image<glm::dvec4>& lighting, int shrink) {
  double light = 0.0, samples = 0.0, inverseDepth = 0.0, surfaces = 0.0;
  forEachPixel(guides.size(), [&](glm::ivec2 p) {
    if (guides[p].depth > 0.0) {
      inverseDepth += 1.0 / guides[p].depth;
      surfaces += 1.0;
    }
    if (!hasSample(guides[p], lighting[p])) return;
    const glm::dvec3 rgb = usableLight(lighting[p]);
    light += (rgb.x + rgb.y + rgb.z) / 3.0;
    samples += 1.0;
  });
  light /= std::max(samples, 1.0);
  inverseDepth /= std::max(surfaces, 1.0);

  const auto pixels = std::size_t(shrink * shrink);
  ChannelImage result((guides.size() + shrink - 1) / shrink, pixels * kFeatures);
  forEachPixel(guides.size(), [&](glm::ivec2 p) {
    if (guides[p].depth == 0.0) return;
    const bool sampled = hasSample(guides[p], lighting[p]);
    const glm::dvec3 normal = octahedralDecode(guides[p].features);
    const double ratio = 1.0 / guides[p].depth / (1.0 / guides[p].depth + inverseDepth);
    const glm::dvec3 rgb = sampled ? usableLight(lighting[p]) / std::max(light, 1e-30) : glm::dvec3(0.0);
    const std::array<double, kFeatures> features{normal.x,
                                                 normal.y,
                                                 ratio,
                                                 guides[p].occlusion,
                                                 std::log1p(rgb.x),
                                                 std::log1p(rgb.y),
                                                 std::log1p(rgb.z),
                                                 sampled ? lighting[p].w / 16.0 : 0.0};
    const std::size_t place = placeOf(p, shrink);
    for (std::size_t f = 0; f < kFeatures; ++f) result.at(pixels * f + place, p / shrink) = features[f];
  });
  return result;
}

/// The guides that the last layers of a network make (flnr_head.comp).
ChannelImage heads(const ChannelImage& input, std::span<const std::uint16_t> halves, glm::ivec2 size, int shrink,
                   std::size_t guides) {
  const std::size_t groups =
      shrink == 2 ? 3 : 1;  // Of four results in a layer: a guide of four pixels, or four guides.
  ChannelImage result(size, guides);
  forEachPixel(size, [&](glm::ivec2 p) {
    for (std::size_t g = 0; g < guides; ++g) {
      const std::size_t layer = shrink == 2 ? 0 : g / 4;
      const std::size_t lane = shrink == 2 ? 4 * g + placeOf(p, shrink) : g % 4;
      const std::span<const std::uint16_t> weights = halves.subspan(layer * 4 * (input.count + 1));
      double sum = halfAt(weights, input.count * 4 * groups + lane);
      for (std::size_t i = 0; i < input.count; ++i)
        sum += input.at(i, p / shrink) * halfAt(weights, i * 4 * groups + lane);
      result.at(g, p) = 1.0 / (1.0 + std::exp(-sum));
    }
  });
  return result;
}

}  // namespace

ChannelImage pooled(const ChannelImage& image) {
  ChannelImage result((image.size + 1) / 2, image.count);
  for (std::size_t c = 0; c < image.count; ++c) {
    forEachPixel(result.size, [&](glm::ivec2 p) {
      const glm::ivec2 last = glm::min(2 * p + 1, image.size - 1);
      double largest = image.at(c, 2 * p);
      for (int y = 2 * p.y; y <= last.y; ++y)
        for (int x = 2 * p.x; x <= last.x; ++x) largest = std::max(largest, image.at(c, {x, y}));
      result.at(c, p) = largest;
    });
  }
  return result;
}

ChannelImage grown(const ChannelImage& image, glm::ivec2 size) {
  ChannelImage result(size, image.count);
  for (std::size_t c = 0; c < image.count; ++c)
    forEachPixel(size, [&](glm::ivec2 p) { result.at(c, p) = image.at(c, p / 2); });
  return result;
}

ChannelImage joined(const ChannelImage& first, const ChannelImage& second) {
  ChannelImage result(first.size, first.count + second.count);
  std::ranges::copy(first.values, result.values.begin());
  std::ranges::copy(second.values, result.values.begin() + std::ptrdiff_t(first.values.size()));
  return result;
}

LayerResult convolution(const ChannelImage& input, std::span<const double> weights, std::size_t count, Sums sums) {
  constexpr std::size_t kInputsOfSum = 4;
  LayerResult result{{input.size, count}, {input.size, count}};
  for (std::size_t o = 0; o < count; ++o) {
    forEachPixel(input.size, [&](glm::ivec2 p) {
      const double bias = weights[count * input.count * kTaps + o];
      double sum = bias;
      double magnitude = std::abs(bias);
      for (std::size_t first = 0; first < input.count; first += kInputsOfSum) {
        double partial = 0.0;
        for (int t = 0; t < int(kTaps); ++t) {
          const glm::ivec2 q = p + glm::ivec2(t % 3, t / 3) - 1;
          if (q.x < 0 || q.y < 0 || q.x >= input.size.x || q.y >= input.size.y) continue;
          for (std::size_t i = first; i < first + kInputsOfSum; ++i) {
            const double term = weights[(o * input.count + i) * kTaps + std::size_t(t)] * input.at(i, q);
            partial += term;
            if (sums == Sums::InHalves) partial = roundToHalf(partial);
            magnitude += std::abs(term);
          }
        }
        sum += partial;
      }
      result.values.at(o, p) = std::max(sum, kSlope * sum);
      result.magnitudes.at(o, p) = magnitude;
    });
  }
  return result;
}

std::vector<double> unpackConvolution(std::span<const std::uint16_t> halves, std::size_t inputs, std::size_t outputs) {
  std::vector<double> weights(outputs * (inputs * kTaps + 1));
  forEachWeight(inputs, outputs,
                [&](std::size_t plain, std::size_t packed) { weights[plain] = halfAt(halves, packed); });
  return weights;
}

std::vector<std::uint16_t> packConvolution(std::span<const double> weights, std::size_t inputs, std::size_t outputs) {
  std::vector<std::uint16_t> halves(weights.size());
  forEachWeight(inputs, outputs, [&](std::size_t plain, std::size_t packed) {
    halves[packed] = glm::packHalf1x16(float(weights[plain]));
  });
  return halves;
}

std::size_t guideCount(NetworkKind kind) {
  return kind == NetworkKind::Paper ? 5 : 3;
}

ChannelImage guideNetwork(const Image<Guide>& guides, const Image<glm::dvec4>& lighting, const GuideNetwork& network,
                          Storage storage, Sums sums) {
  const int shrink = network.kind == NetworkKind::Small ? 2 : 1;
  std::vector<std::uint16_t> halves(network.weights.size() / sizeof(std::uint16_t));
  std::memcpy(halves.data(), network.weights.data(), network.weights.size());
  std::span<const std::uint16_t> left(halves);
  const auto block = [&](ChannelImage image, std::size_t count) {
    for (int i = 0; i < 2; ++i) {
      const std::vector<double> layer = unpackConvolution(left, image.count, count);
      left = left.subspan(layer.size());
      image = convolution(image, layer, count, sums).values;
      roundAll(image, storage);
    }
    return image;
  };

  ChannelImage last = encodedGuides(guides, lighting, shrink);
  roundAll(last, storage);
  std::vector<ChannelImage> skips;
  for (const std::uint32_t width : network.widths) {
    last = block(skips.empty() ? last : pooled(last), width);
    skips.push_back(last);
  }
  skips.pop_back();
  for (; !skips.empty(); skips.pop_back()) {
    const ChannelImage& skip = skips.back();
    last = block(joined(grown(last, skip.size), skip), skip.count);
  }
  return heads(last, left, guides.size(), shrink, guideCount(network.kind));
}

}  // namespace walr::reference
