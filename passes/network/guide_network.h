#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "framegraph/declare/graph.h"
#include "passes/conventions/lighting_alpha.h"
#include "passes/guides/prepare_guides.h"
#include "passes/regression/flr_regression.h"
#include "passes/stage/stage_graph.h"

namespace walr {

/// The kinds of networks.
enum class NetworkKind : std::uint32_t {
  Small,  ///< Works at half the picture's width and height. Makes three guides beside the geometric ones.
  Paper,  ///< Works at the picture's size. Makes five guides in place of the geometric ones, as published.
  Full,   ///< Works at the picture's size. Makes three guides beside the geometric ones.
};

/// A U-Net that makes guides for FLR's regression from the geometric guides and the noisy light (Salmi et al. 2024,
/// Enhancing Local Regression with Neural Networks). Every block of encoder and decoder is two 3 x 3 convolutions with
/// LeakyReLU.
struct GuideNetwork {
  NetworkKind kind;
  /// Channels of the encoder's blocks, each a multiple of eight. Every block but the first works at half the size of
  /// the one before it.
  std::array<std::uint32_t, 4> widths;
  /// Weights and biases as halves, in the order of the layers; see convolution.comp and flnr_head.comp for that within
  /// a layer. They must outlive the graph and its executors.
  std::span<const std::byte> weights;
};

/// Bytes of the weights of a network of this kind with these widths.
std::uint64_t weightBytesOf(NetworkKind kind, const std::array<std::uint32_t, 4>& widths);

/// Add the network's passes.
/// @param lighting RGBA16F: the light that the regression will fit
/// @param alpha    what its alpha channel holds
/// @param guides   with `features`
/// @throws std::invalid_argument if weights and widths do not fit, or if the picture is too large for one storage
/// buffer
LearnedGuides addGuideNetwork(StageGraph graph, fg::Texture lighting, LightingAlpha alpha, const Guides& guides,
                              const GuideNetwork& network);

/// What the input of a layer goes through on its way (convolution.comp).
enum class LayerInput : std::uint32_t {
  AsItIs,
  Pooled,  ///< Half the width and height: the largest of 2 x 2 texels.
  Grown,   ///< Twice the width and height: each texel stands for 2 x 2.
};

/// Channels of halves in a storage buffer, in groups of four (halves.glsl).
struct Channels {
  fg::Buffer buffer;
  fg::Extent extent;
  std::uint32_t count = 0;  ///< A multiple of four.
};

/// A 3 x 3 convolution with LeakyReLU.
struct Convolution {
  Channels first;
  LayerInput input = LayerInput::AsItIs;  ///< Of the first input.
  Channels second = {};                   ///< Of the result's extent; not valid if there is one input.
  fg::Extent extent;                      ///< Of the result.
  std::uint32_t count = 0;                ///< Channels of the result, a multiple of eight.
};

/// Add a convolution's pass.
/// @param weights all weights of the network
/// @param offset  bytes before the layer's own; moved behind them
Channels addConvolution(StageGraph graph, const char* name, const Convolution& layer, fg::Buffer weights,
                        std::uint64_t& offset);

}  // namespace walr
