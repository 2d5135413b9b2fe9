#include "passes/network/guide_network.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "passes/stage/grid_extent.h"
#include "shaders/network/guide_network.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

static_assert(static_cast<std::uint32_t>(LayerInput::Pooled) == kInputPooled);
static_assert(static_cast<std::uint32_t>(LayerInput::Grown) == kInputGrown);

/// How a network meets the picture.
struct NetworkShape {
  std::uint32_t shrink;  ///< Pixels per axis that become one texel of the network.
  /// Results of each of the last layers (flnr_head.comp).
  std::vector<std::uint32_t> heads;
};

NetworkShape shapeOf(NetworkKind kind) {
  switch (kind) {
    case NetworkKind::Small:
      return {2, {12}};  // Three guides of four pixels.
    case NetworkKind::Full:
      return {1, {4}};  // Three guides of a pixel, and one that nothing reads.
    case NetworkKind::Paper:
      return {1, {4, 4}};  // Four guides of a pixel, then a fifth that has a group of four for itself.
  }
  throw std::logic_error("a kind of network has no shape");
}

/// Channels of the network's input: the features of the pixels of a texel (flnr_encode.comp).
std::uint32_t inputChannels(const NetworkShape& shape) {
  return static_cast<std::uint32_t>(kNetworkFeatures) * shape.shrink * shape.shrink;
}

constexpr std::uint64_t kHalfBytes = 2;
/// Bytes of the shaders' unit, four halves.
constexpr std::uint64_t kGroupBytes = 4 * kHalfBytes;
constexpr std::uint32_t kThreadTexels = 2;  ///< Texels per axis that a thread of convolution.comp makes.

std::uint64_t convolutionBytes(std::uint32_t inputs, std::uint32_t outputs, std::uint32_t taps) {
  return kHalfBytes * outputs * (std::uint64_t{inputs} * taps + 1);
}

fg::Extent halved(fg::Extent extent) {
  return gridExtent(extent, 2);
}

Channels channels(StageGraph graph, const std::string& name, fg::Extent extent, std::uint32_t count) {
  const std::uint64_t bytes = kHalfBytes * count * extent.width * extent.height;
  if (bytes > kLargestBuffer) {
    throw std::invalid_argument("method flnr needs " + std::to_string(bytes) + " bytes for '" + name +
                                "', more than the " + std::to_string(kLargestBuffer) +
                                " of a buffer that every device takes: denoise a smaller picture");
  }
  return {graph.buffer(name, {bytes}), extent, count};
}

LayerConstants constantsOf(fg::Extent extent, fg::Extent first, std::uint64_t offset) {
  const auto size = [](fg::Extent e) { return glm::ivec2(e.width, e.height); };
  return {size(extent), size(first), static_cast<glm::uint>(offset / kGroupBytes)};
}

/// The features of the pixels, as the network's first layer reads them.
Channels addEncoder(StageGraph graph, fg::Texture lighting, LightingAlpha alpha, const Guides& guides,
                    const NetworkShape& shape) {
  const fg::Extent extent = graph->textureDesc(lighting).extent;
  const bool counted = alpha == LightingAlpha::SampleCount;
  const fg::Extent tiles = gridExtent(extent, kMeansTile);
  fg::PassBuilder means = graph->compute("flnr means", shaders::flnrMeans);
  means.sample("lighting", lighting).sample("depth", guides.depth).specialize("kAlphaIsSampleCount", counted);
  means.dispatch({8 * tiles.width, 8 * tiles.height});
  const fg::Buffer sums = means.store(
      "outSums", graph->buffer("sums of tiles", {std::uint64_t{tiles.width} * tiles.height * sizeof(glm::vec4)}));

  Channels encoded = channels(graph, "encoded guides", gridExtent(extent, shape.shrink), inputChannels(shape));
  fg::PassBuilder encode = graph->compute("flnr encode", shaders::flnrEncode);
  encode.sample("lighting", lighting).sample("depth", guides.depth).sample("features", guides.features);
  encode.load("sums", sums).specialize("kAlphaIsSampleCount", counted).specialize("kShrink", shape.shrink);
  encode.dispatch(encoded.extent);
  encoded.buffer = encode.store("outEncoded", encoded.buffer);
  return encoded;
}

/// The last layers, whose results are the guides.
LearnedGuides addHeads(StageGraph graph, const Channels& input, fg::Extent picture, fg::Buffer weights,
                       std::uint64_t offset, const NetworkShape& shape) {
  std::array<fg::Texture, 2> learned;
  constexpr std::array kPasses{"flnr head", "flnr second head"};
  constexpr std::array kTextures{"learned guides", "more learned guides"};
  for (std::size_t i = 0; i < shape.heads.size(); ++i) {
    fg::PassBuilder head = graph->compute(kPasses[i], shaders::flnrHead);
    head.load("firstInput", input.buffer).load("weights", weights);
    head.specialize("kChannels", input.count).specialize("kShrink", shape.shrink);
    head.constants(constantsOf(input.extent, input.extent, offset)).dispatch(input.extent);
    learned[i] = head.store("outLearned", graph->texture(kTextures[i], {VK_FORMAT_R16G16B16A16_SFLOAT, picture}));
    offset += convolutionBytes(input.count, shape.heads[i], 1);
  }
  return {learned[0], learned[1]};
}

}  // namespace

std::uint64_t weightBytesOf(NetworkKind kind, const std::array<std::uint32_t, 4>& widths) {
  constexpr std::uint32_t kTaps = 9;
  const NetworkShape shape = shapeOf(kind);
  std::uint64_t bytes = 0;
  for (const std::uint32_t results : shape.heads) bytes += convolutionBytes(widths.front(), results, 1);
  for (std::size_t i = 0; i < widths.size(); ++i) {
    bytes += convolutionBytes(i == 0 ? inputChannels(shape) : widths[i - 1], widths[i], kTaps);
    bytes += convolutionBytes(widths[i], widths[i], kTaps);
    if (i + 1 == widths.size()) continue;
    bytes += convolutionBytes(widths[i + 1] + widths[i], widths[i], kTaps);
    bytes += convolutionBytes(widths[i], widths[i], kTaps);
  }
  return bytes;
}

Channels addConvolution(StageGraph graph, const char* name, const Convolution& layer, fg::Buffer weights,
                        std::uint64_t& offset) {
  Channels result = channels(graph, name, layer.extent, layer.count);
  const bool joins = layer.second.buffer.valid();
  fg::PassBuilder pass = graph->compute(name, shaders::convolution);
  pass.load("firstInput", layer.first.buffer)
      .load("secondInput", joins ? layer.second.buffer : layer.first.buffer)
      .load("weights", weights)
      .specialize("kFirstChannels", layer.first.count)
      .specialize("kSecondChannels", layer.second.count)
      .specialize("kFirstInput", static_cast<std::uint32_t>(layer.input))
      .constants(constantsOf(layer.extent, layer.first.extent, offset))
      .dispatch(gridExtent(layer.extent, kThreadTexels), layer.count / 8);
  result.buffer = pass.store("outResult", result.buffer);
  offset += convolutionBytes(layer.first.count + layer.second.count, layer.count, 9);
  return result;
}

LearnedGuides addGuideNetwork(StageGraph graph, fg::Texture lighting, LightingAlpha alpha, const Guides& guides,
                              const GuideNetwork& network) {
  const NetworkShape shape = shapeOf(network.kind);
  const std::uint64_t bytes = weightBytesOf(network.kind, network.widths);
  if (network.weights.size() != bytes) {
    throw std::invalid_argument("the weights of the network have " + std::to_string(network.weights.size()) +
                                " bytes, but its widths need " + std::to_string(bytes));
  }
  const fg::Buffer weights = graph->upload("weights", network.weights);
  std::uint64_t offset = 0;
  const auto convolve = [&](const std::string& name, const Convolution& layer) {
    return addConvolution(graph, name.c_str(), layer, weights, offset);
  };
  const auto block = [&](const std::string& name, const Convolution& layer) {
    const Channels inner = convolve(name + ", first", layer);
    return convolve(name + ", second", {.first = inner, .extent = layer.extent, .count = layer.count});
  };

  std::vector<Channels> skips;
  Channels last = addEncoder(graph, lighting, alpha, guides, shape);
  for (const std::uint32_t width : network.widths) {
    const bool first = skips.empty();
    last =
        block("encoder " + std::to_string(skips.size() + 1), {.first = last,
                                                              .input = first ? LayerInput::AsItIs : LayerInput::Pooled,
                                                              .extent = first ? last.extent : halved(last.extent),
                                                              .count = width});
    skips.push_back(last);
  }
  skips.pop_back();
  for (; !skips.empty(); skips.pop_back()) {
    const Channels& skip = skips.back();
    last =
        block("decoder " + std::to_string(skips.size()),
              {.first = last, .input = LayerInput::Grown, .second = skip, .extent = skip.extent, .count = skip.count});
  }
  return addHeads(graph, last, graph->textureDesc(lighting).extent, weights, offset, shape);
}

}  // namespace walr
