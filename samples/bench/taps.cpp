#include "samples/bench/taps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

#include "passes/regression/flr_regression.h"
#include "shaders/network/guide_network.h"
#include "shaders/regression/block_regression.h"
#include "shaders/regression/flr.h"
#include "shaders/temporal/antilag.h"

namespace walr {
namespace {

constexpr double kBilinear = 4.0;
constexpr double kBicubic = 16.0;

/// A compute pass of a plan.
struct Stage {
  const fg::ComputeDispatch& work;
  fg::Extent extent;   ///< Size of the image.
  double share = 1.0;  ///< Texels that the pass writes per pixel of the image; its threads if it writes buffers only.
};

std::uint32_t specializationOf(const Stage& stage, std::string_view name) {
  const auto constants = stage.work.shader->constants;
  const auto found = std::ranges::find(constants, name, &fg::ShaderConstant::name);
  return stage.work.specialization.at(static_cast<std::size_t>(found - constants.begin()));
}

template <typename Constants>
Constants constantsOf(const Stage& stage) {
  Constants constants{};
  std::memcpy(&constants, stage.work.constants.data(), sizeof(constants));
  return constants;
}

double shareOf(const fg::GraphDesc& graph, const fg::PassDecl& pass, const fg::ComputeDispatch& work,
               fg::Extent extent) {
  for (const fg::AccessDecl& access : pass.accesses) {
    const auto* texture = std::get_if<fg::TextureDesc>(&graph.resources[access.resource].desc);
    if (access.writeVersion == fg::kNone || texture == nullptr) continue;
    return static_cast<double>(texture->extent.width) * texture->extent.height / extent.width / extent.height;
  }
  double threads = 1.0;
  for (int axis = 0; axis < 3; ++axis) threads *= static_cast<double>(work.groups[axis]) * work.shader->localSize[axis];
  return threads / extent.width / extent.height;
}

double window(std::uint32_t radius) {
  return (2.0 * radius + 1.0) * (2.0 * radius + 1.0);
}

/// Cells of FLR's grid per pixel of the image.
double flrCells(const Stage& stage) {
  const FlrConstants constants = constantsOf<FlrConstants>(stage);
  return static_cast<double>(constants.cells.x) * constants.cells.y / stage.extent.width / stage.extent.height;
}

double flrLine(const Stage& stage) {
  return (2.0 * constantsOf<FlrConstants>(stage).radius + 1.0) * flrCells(stage);
}

double flrUpsampling(const Stage& stage) {
  switch (static_cast<FlrUpsampling>(specializationOf(stage, "kUpsampling"))) {
    case FlrUpsampling::Nearest:
      return 1.0;
    case FlrUpsampling::Bilinear:
      return kBilinear;
    case FlrUpsampling::Bspline:
      break;
  }
  return kBicubic;
}

/// Groups of four channels of a texel that a layer of a network reads, over the pixels of the image.
double layerTaps(const Stage& stage, double tapsOfTexel, std::uint32_t channels) {
  const LayerConstants constants = constantsOf<LayerConstants>(stage);
  const double texels = static_cast<double>(constants.extent.x) * constants.extent.y;
  return tapsOfTexel * channels / 4.0 * texels / stage.extent.width / stage.extent.height;
}

double coarseLine(const Stage& stage) {
  const auto constants = constantsOf<BlockRegressionConstants>(stage);
  return (2.0 * std::ceil(constants.coarseReach * constants.coarseSigma) + 1.0) * stage.share;
}

/// The pixel itself, and the four blocks and four cells around it. For the share of accumulated light also that light,
/// the noisy light, and four texels each of the last frame's innovations, statistics and trust: a gather counts as
/// four.
double blockApply(const Stage& stage) {
  const bool takesShare = stage.work.shader->name.find(".residual") != std::string_view::npos;
  return 1.0 + 2.0 * kBilinear + (takesShare ? 2.0 + 3.0 * kBilinear : 0.0);
}

/// Workgroups share what they fetch: (8 + 2 R)^2 tiles for each of three sums over a window of radius R, and for the
/// slope those around the tiles of antilag. Each thread fetches seven more values of the last frame. Tiles outside the
/// image count, too.
double residualStatistics(const Stage& stage) {
  const auto square = [](std::uint32_t side) { return static_cast<double>(side) * side; };
  const std::uint32_t group = stage.work.shader->localSize[0];
  const std::uint32_t windows = 2 * specializationOf(stage, "kRadius");
  const std::uint32_t spanned = (group - 1) * kAntilagTile / specializationOf(stage, "kTileSize") + 2;
  const double taps = 3.0 * square(group + windows) + square(spanned + windows) + 7.0 * square(group);
  return taps * stage.work.groups[0] * stage.work.groups[1] / stage.extent.width / stage.extent.height;
}

/// Taps per pixel of each shader, by the first part of the shader's name.
struct ShaderTaps {
  std::string_view shader;
  double (*taps)(const Stage& stage);
};

constexpr std::array kShaders = {
    ShaderTaps{"pass_through", [](const Stage&) { return 1.0; }},
    ShaderTaps{"prepare_guides", [](const Stage&) { return 0.0; }},
    ShaderTaps{"temporal_accumulation",
               [](const Stage& stage) {
                 return 1.0 + (specializationOf(stage, "kBicubicHistory") != 0 ? kBicubic : kBilinear);
               }},
    ShaderTaps{"antilag", [](const Stage& stage) { return window(specializationOf(stage, "kRadius")) * stage.share; }},
    ShaderTaps{"temporal_antialiasing",
               [](const Stage& stage) { return kBicubic + 1.0 + window(specializationOf(stage, "kClipRadius")); }},
    ShaderTaps{"atrous", [](const Stage&) { return 9.0; }},
    ShaderTaps{"svgf_accumulation", [](const Stage&) { return 1.0 + 2.0 * kBilinear; }},
    ShaderTaps{"svgf_variance", [](const Stage&) { return window(3); }},
    // The window, and a 3 x 3 blur of the variance.
    ShaderTaps{"svgf_atrous", [](const Stage& stage) { return 9.0 + window(specializationOf(stage, "kRadius")); }},
    ShaderTaps{"bmfr_fit", [](const Stage&) { return 1.0; }},
    ShaderTaps{"bmfr_accumulation", [](const Stage&) { return 1.0 + kBilinear; }},
    ShaderTaps{"flr_moments", [](const Stage&) { return 1.0; }},
    ShaderTaps{"flr_blur", flrLine},
    ShaderTaps{"flr_solve", flrLine},
    ShaderTaps{"flr_apply", flrUpsampling},
    ShaderTaps{"flnr_means", [](const Stage&) { return 1.0; }},
    ShaderTaps{"flnr_encode", [](const Stage&) { return 1.0; }},
    ShaderTaps{"convolution",
               [](const Stage& stage) {
                 const auto channels =
                     specializationOf(stage, "kFirstChannels") + specializationOf(stage, "kSecondChannels");
                 return layerTaps(stage, window(1), channels);
               }},
    ShaderTaps{"flnr_head",
               [](const Stage& stage) { return layerTaps(stage, 1.0, specializationOf(stage, "kChannels")); }},
    ShaderTaps{"block_moments", [](const Stage&) { return 1.0; }},
    // At one sample per pixel; with more samples the window is narrower.
    ShaderTaps{"block_coarse", coarseLine},
    ShaderTaps{"block_coarse_growth", [](const Stage& stage) { return window(2) * stage.share; }},
    ShaderTaps{"block_atrous", [](const Stage& stage) { return 9.0 * stage.share; }},
    ShaderTaps{"block_apply", blockApply},
    ShaderTaps{"residual_statistics", residualStatistics},
    ShaderTaps{"joint_bilateral", [](const Stage& stage) { return window(specializationOf(stage, "kRadius")); }},
};

}  // namespace

std::optional<double> tapsPerPixel(const fg::GraphDesc& graph, const fg::PlannedPass& planned, fg::Extent extent) {
  const fg::PassDecl& pass = graph.passes[planned.pass];
  const auto* work = std::get_if<fg::ComputeDispatch>(&pass.work);
  if (work == nullptr || work->shader == nullptr) return std::nullopt;
  const std::string_view name = work->shader->name.substr(0, work->shader->name.find('.'));
  const auto found = std::ranges::find(kShaders, name, &ShaderTaps::shader);
  if (found == kShaders.end()) return std::nullopt;
  return found->taps({*work, extent, shareOf(graph, pass, *work, extent)});
}

std::optional<double> tapsPerPixel(const fg::GraphDesc& graph, const fg::Plan& plan, fg::Extent extent) {
  double taps = 0.0;
  for (const fg::PlannedPass& planned : plan.passes) {
    const auto ofPass = tapsPerPixel(graph, planned, extent);
    if (!ofPass) return std::nullopt;
    taps += *ofPass;
  }
  return taps;
}

}  // namespace walr
