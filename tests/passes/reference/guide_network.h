#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "passes/network/guide_network.h"
#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// Several channels of an image.
struct ChannelImage {
  glm::ivec2 size{0};
  std::size_t count = 0;
  std::vector<double> values = {};

  ChannelImage() = default;
  ChannelImage(glm::ivec2 extent, std::size_t channels)
      : size(extent), count(channels), values(channels * std::size_t(extent.x) * std::size_t(extent.y)) {}
  double& at(std::size_t channel, glm::ivec2 p) { return values[index(channel, p)]; }
  [[nodiscard]] double at(std::size_t channel, glm::ivec2 p) const { return values[index(channel, p)]; }
  [[nodiscard]] std::size_t index(std::size_t channel, glm::ivec2 p) const {
    return (channel * std::size_t(size.y) + std::size_t(p.y)) * std::size_t(size.x) + std::size_t(p.x);
  }
};

/// The largest of 2 x 2 values, at odd borders of those that there are.
ChannelImage pooled(const ChannelImage& image);
/// Twice the size, or one less where that is odd: each value stands for 2 x 2.
ChannelImage grown(const ChannelImage& image, glm::ivec2 size);
/// The channels of one image, then those of another.
ChannelImage joined(const ChannelImage& first, const ChannelImage& second);

/// The result of a layer, and for each value the sum of the magnitudes of its terms, which bounds rounding.
struct LayerResult {
  ChannelImage values;
  ChannelImage magnitudes;
};

/// How a convolution sums its products.
enum class Sums : std::uint8_t {
  Exact,
  InHalves,  ///< Those of four inputs are halves, rounded after each product (convolution.comp, HALVES).
};

/// A 3 x 3 convolution with zeros beyond the image, and LeakyReLU of slope 0.1.
/// @param weights by result, input, row and column, then the biases
LayerResult convolution(const ChannelImage& input, std::span<const double> weights, std::size_t count,
                        Sums sums = Sums::Exact);

/// Values of a layer's weights in the order that `convolution` takes, from those of the shader (convolution.comp).
std::vector<double> unpackConvolution(std::span<const std::uint16_t> halves, std::size_t inputs, std::size_t outputs);
/// The opposite.
std::vector<std::uint16_t> packConvolution(std::span<const double> weights, std::size_t inputs, std::size_t outputs);

/// Number of guides that a network of this kind makes for a pixel.
std::size_t guideCount(NetworkKind kind);

/// The guides that a network makes, a channel each, with the results of all layers rounded to halves or not.
/// @param lighting with the number of samples in it; light that is not finite is no sample
ChannelImage guideNetwork(const Image<Guide>& guides, const Image<glm::dvec4>& lighting, const GuideNetwork& network,
                          Storage storage, Sums sums = Sums::Exact);

}  // namespace walr::reference
