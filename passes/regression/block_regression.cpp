#include "passes/regression/block_regression.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "passes/stage/grid_extent.h"
#include "shaders/regression/block_regression.h"
#include "shaders/regression/stored_fit.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

/// Shared by all passes: the grids of blocks and cells, and the constants of the shaders.
struct BlockGrid {
  StageGraph graph;
  fg::Buffer frame;
  fg::Extent pixels;
  fg::Extent blocks;
  fg::Extent cells;          // Size of the grid of the coarse fit.
  std::uint32_t size;        // Pixels per axis of a block.
  std::uint32_t cellBlocks;  // Blocks per axis of a cell.
  std::uint32_t cellSize;    // Pixels per axis of a cell.
  BlockRegressionConstants constants;
};

/// Moments of every block or cell and the depth that their depth feature is relative to.
struct BlockAverages {
  std::array<fg::Texture, 5> moments;
  fg::Texture depth;
};

/// Side of a cell in blocks: the largest power of two whose pixels exceed neither `cellPixels` nor `mostPixels`, and at
/// least 1. A workgroup merges the cells of its 4 x 4 blocks, so that the side of a cell must divide 4.
std::uint32_t cellBlocksFor(float cellPixels, float mostPixels, std::uint32_t blockSize) {
  const auto fits = [&](std::uint32_t blocks) {
    return blocks <= 4 && static_cast<float>(blocks * blockSize) <= std::min(cellPixels, mostPixels);
  };
  std::uint32_t blocks = 1;
  while (fits(2 * blocks)) blocks *= 2;
  return blocks;
}

/// Largest side of a cell in pixels: 8 texels of accumulated light.
float mostCellPixels(const LightPattern& groups) {
  return 8.0F * static_cast<float>(std::min(groups.columns, groups.rows));
}

/// Groups of pixels that share a texel of accumulated light.
LightPattern groupsOf(const BlockLight& light) {
  return light.lightGrid ? light.lightGrid->groups : LightPattern{};
}

/// Converts `coarseSigma` from a fraction of the image's height to cells, and `planeNear` and `planeFar` to the
/// coefficients of a linear function.
BlockGrid gridOf(StageGraph graph, fg::Buffer frame, fg::Extent pixels, const BlockRegressionSettings& s,
                 const BlockLight& light) {
  const LightPattern groups = groupsOf(light);
  const fg::Extent blocks = gridExtent(pixels, s.size);
  const float sigma = s.coarseSigma * static_cast<float>(pixels.height);
  const std::uint32_t cellBlocks = cellBlocksFor(sigma / s.coarseResolution, mostCellPixels(groups), s.size);
  const std::uint32_t cellSize = cellBlocks * s.size;
  BlockRegressionConstants constants{};
  constants.planeScale = 1.0F / (s.planeFar - s.planeNear);
  constants.planeOffset = constants.planeScale * s.planeFar;
  constants.sdfFraction = s.sdfFraction;
  constants.ridge = s.ridge;
  constants.growthErrors = s.growthErrors;
  constants.coarseSigma = sigma / static_cast<float>(cellSize);
  constants.coarseNarrowing = s.coarseNarrowing;
  constants.coarseReach = s.coarseReach;
  constants.coarseGrowthErrors = s.coarseGrowthErrors;
  constants.coarseGrowthOcclusion = s.coarseGrowthOcclusion;
  constants.coarseSamples = coarseSamplesAt(pixels.height, s.coarseSamples);
  constants.inverseCoarseLeastShare = 1.0F / s.coarseLeastShare;
  constants.residualGain = s.share.gain;
  constants.residualEdgeGain = s.share.edgeGain;
  constants.residualLeastShare = s.share.leastShare;
  constants.lightShare = 1.0F / static_cast<float>(groups.columns * groups.rows);
  if (light.antilag) constants.maxHistory = light.antilag->maxHistory;
  return {graph, frame, pixels, blocks, gridExtent(pixels, cellSize), s.size, cellBlocks, cellSize, constants};
}

void readAverages(fg::PassBuilder& pass, const BlockAverages& averages) {
  static constexpr std::array kBindings{"moments0", "moments1", "moments2", "moments3", "moments4"};
  for (std::size_t i = 0; i < kBindings.size(); ++i) pass.sample(kBindings.at(i), averages.moments.at(i));
  pass.sample("depth", averages.depth);
}

BlockAverages writeAverages(const BlockGrid& grid, fg::PassBuilder& pass, fg::Extent extent, const std::string& suffix,
                            const std::string& prefix = "out") {
  BlockAverages averages;
  for (std::size_t i = 0; i < averages.moments.size(); ++i) {
    const fg::Texture texture =
        grid.graph->texture("block moments " + std::to_string(i) + suffix, {VK_FORMAT_R32G32B32A32_UINT, extent});
    averages.moments.at(i) = pass.store(prefix + "Moments" + std::to_string(i), texture);
  }
  averages.depth =
      pass.store(prefix + "Depth", grid.graph->texture("block depth" + suffix, {VK_FORMAT_R32_UINT, extent}));
  return averages;
}

/// Lets a pass write the fit of every block or cell.
fg::Buffer writeFits(const BlockGrid& grid, fg::PassBuilder& pass, fg::Extent extent, std::uint64_t fitBytes,
                     const std::string& name) {
  return pass.store("outFits", grid.graph->buffer(name, {fitBytes * extent.width * extent.height}));
}

/// The fit of a Gaussian window around every cell, regardless of edges. The window grows where the light is the same,
/// unless all blocks that reconstruction mixes the cell with have converged. `fitDepth` is `FineFit::depth`, which
/// tells that.
fg::Buffer addCoarseFit(const BlockGrid& grid, const BlockAverages& averages, fg::Texture fitDepth) {
  const auto declare = [&](const std::string& name, const fg::Shader& shader, const BlockAverages& read) {
    fg::PassBuilder pass = grid.graph->compute(name, shader);
    readAverages(pass, read);
    pass.specialize("kCellSize", grid.cellSize).constants(grid.constants).dispatch(grid.cells);
    return pass;
  };
  fg::PassBuilder across = declare("coarse fit, across", shaders::blockCoarse, averages);
  across.specialize("kVertical", false);
  const BlockAverages blurred = writeAverages(grid, across, grid.cells, " blurred across");
  fg::PassBuilder down = declare("coarse fit, down", shaders::blockCoarse, blurred);
  down.specialize("kVertical", true);
  const BlockAverages windows = writeAverages(grid, down, grid.cells, " blurred");
  fg::PassBuilder growth = declare("coarse fit, growth", shaders::blockCoarseGrowth, windows);
  growth.sample("fitDepth", fitDepth).specialize("kCellBlocks", grid.cellBlocks);
  return writeFits(grid, growth, grid.cells, sizeof(StoredFit), "coarse fits");
}

/// In the order of `view` of block_atrous.comp. Views that the regression over pixels also has share its names.
const std::vector<ViewInfo>& blockIterationViews() {
  static const std::vector<ViewInfo> kViews{
      {"edges",
       "Of the pixel's block: step of the nearest edge on the eight traces (one past the last: none), taps lost, W"},
      {"pivots",
       "Of the pixel's block: smallest pivot of the solve without its ridge, in units of the ridge; pivots that the "
       "ridge outweighs, and 1 where there are any",
       {{"regularised-fits", "Z"}}},
      {"colour-mean", "Of the pixel's block: mean of the colour"},
      {"feature-mean", "Of the pixel's block: mean of the shading normal"},
      {"feature-mean-2", "Of the pixel's block: mean of the depth feature, of ambient occlusion, and 0"},
      {"covariance-normal", "Of the pixel's block: variances of the normal's components"},
      {"covariance-normal-2", "Of the pixel's block: covariances xy, xz, yz of the normal's components"},
      {"covariance-depth", "Of the pixel's block: covariances of the depth feature with the normal"},
      {"covariance-occlusion", "Of the pixel's block: covariances of ambient occlusion with the normal"},
      {"covariance-scalars",
       "Of the pixel's block: variance of the depth feature, its covariance with, and variance of, "
       "ambient occlusion"},
      {"covariance-x", "Of the pixel's block: covariances of the colour with the normal's x"},
      {"covariance-y", "Of the pixel's block: covariances of the colour with the normal's y"},
      {"covariance-z", "Of the pixel's block: covariances of the colour with the normal's z"},
      {"covariance-d", "Of the pixel's block: covariances of the colour with the depth feature"},
      {"covariance-o", "Of the pixel's block: covariances of the colour with ambient occlusion"},
  };
  return kViews;
}

/// In the order of `view` of block_apply.comp.
const std::vector<ViewInfo>& reconstructionViews() {
  static const std::vector<ViewInfo> kViews{
      {"samples",
       "Sample count W of the blocks around, share of the coarse fit in the mixture, 1 where there is no fit at all",
       {{"unfitted-pixels", "Z"}}},
      {"occlusion",
       "Ambient occlusion, weight of the blocks around that lie on the pixel's plane, 1 where only the coarse fit is "
       "left",
       {{"coarse-fit-alone", "Z"}}},
      {"fine-fit", "The fine fits' colour before the mixture"},
      {"coarse-fit", "The coarse fits' colour before the mixture"},
      {"clamped", "1 in each channel where a fine fit is below 0", {{"clamped-channels", "XYZ"}}},
      {"coarse-clamped", "1 in each channel where a coarse fit is below 0", {{"clamped-coarse-channels", "XYZ"}}},
      {"slope-x", "Coefficients of the normal's x in the fine fits"},
      {"slope-y", "Coefficients of the normal's y in the fine fits"},
      {"slope-z", "Coefficients of the normal's z in the fine fits"},
      {"slope-depth", "Coefficients of the depth feature in the fine fits"},
      {"slope-occlusion", "Coefficients of ambient occlusion in the fine fits"},
      {"coarse-slope-x", "Coefficients of the normal's x in the coarse fits"},
      {"coarse-slope-y", "Coefficients of the normal's y in the coarse fits"},
      {"coarse-slope-z", "Coefficients of the normal's z in the coarse fits"},
      {"coarse-slope-depth", "Coefficients of the depth feature in the coarse fits"},
      {"coarse-slope-occlusion", "Coefficients of ambient occlusion in the coarse fits"},
      {"few-samples",
       "1 where W is below 6, the number of coefficients; 1 where the coarse fit has the larger share; 1 where "
       "the pixel has no finite sample",
       {{"few-samples", "X"}, {"mostly-coarse-fit", "Y"}, {"unsampled-pixels", "Z"}}},
  };
  return kViews;
}

/// The fits of blocks.
struct FineFit {
  fg::Buffer fits;
  fg::Texture depth;  ///< `BlockFits::depth`.
};

/// The fit of an edge-aware window around every block (Meunier & Harada 2022, 3.2).
FineFit addFineFit(const BlockGrid& grid, BlockAverages averages, fg::Texture normal, std::uint32_t iterations) {
  std::uint32_t spacing = 1;
  for (std::uint32_t t = 0;; ++t, spacing *= 3) {
    const auto declare = [&](const std::string& name, const fg::Shader& shader) {
      fg::PassBuilder pass = grid.graph->compute(name, shader);
      readAverages(pass, averages);
      pass.uniform("frameConstants", grid.frame)
          .sample("normal", normal)
          .specialize("kBlockSize", grid.size)
          .specialize("kSpacing", spacing)
          .constants(grid.constants)
          .dispatch(grid.blocks);
      return pass;
    };
    grid.graph.offer(blockIterationViews(), grid.pixels,
                     [&](const std::string& name) { return declare(name, shaders::blockAtrousView); },
                     {.index = t, .count = iterations});
    const bool last = t + 1 == iterations;
    const std::string suffix = " " + std::to_string(t);
    fg::PassBuilder pass = declare("block a-trous" + suffix, last ? shaders::blockAtrousLast : shaders::blockAtrous);
    if (last) {
      return {
          .fits = writeFits(grid, pass, grid.blocks, sizeof(StoredBlockFit), "block fits"),
          .depth = pass.store("outDepth", grid.graph->texture("block fit depth", {VK_FORMAT_R32_UINT, grid.blocks}))};
    }
    averages = writeAverages(grid, pass, grid.blocks, suffix);
  }
}

/// A pass that reads the depth and the features of pixels: both the moments of blocks and the reconstruction do.
fg::PassBuilder readPixels(const BlockGrid& grid, fg::Texture depth, fg::Texture features, const std::string& name,
                           const fg::Shader& shader) {
  fg::PassBuilder pass = grid.graph->compute(name, shader);
  pass.uniform("frameConstants", grid.frame)
      .sample("depth", depth)
      .sample("features", features)
      .specialize("kBlockSize", grid.size)
      .constants(grid.constants);
  return pass;
}

/// Pixels of the first block interval that lie before the image, per axis.
std::uint32_t pixelsBeforeImage(const BlockGrid& grid) {
  return (grid.size + 1) / 2;
}

/// Pixels per axis that a work group of the reconstruction takes.
std::uint32_t tileSizeOf(const BlockGrid& grid, const fg::Shader& shader) {
  return shader.localSize[0] / grid.size * grid.size;
}

/// Work groups of the reconstruction.
fg::Extent tilesOf(const BlockGrid& grid, const fg::Shader& shader) {
  const std::uint32_t before = pixelsBeforeImage(grid);
  return gridExtent({grid.pixels.width + before, grid.pixels.height + before}, tileSizeOf(grid, shader));
}

/// Threads of the reconstruction: each of its work groups takes whole intervals between the centres of blocks, of which
/// the first begins half a block before the image (block_apply.comp).
fg::Extent reconstructionThreads(const BlockGrid& grid, const fg::Shader& shader) {
  const fg::Extent tiles = tilesOf(grid, shader);
  return {shader.localSize[0] * tiles.width, shader.localSize[1] * tiles.height};
}

bool isPacked(const BlockGrid& grid, fg::Texture texture) {
  return lightStorageOf(grid.graph->textureDesc(texture).format) == LightStorage::Packed;
}

void specializeAlpha(const BlockLight& light, fg::PassBuilder& pass) {
  pass.specialize("kAlphaIsSampleCount", light.alpha == LightingAlpha::SampleCount);
}

/// Declare what a view of the reconstruction reads of the light, in either storage.
/// @param number a texture that the pass samples, with texels that are unsigned integers
void readLightInView(const BlockGrid& grid, const BlockLight& light, fg::Texture number, fg::PassBuilder& pass) {
  const bool packed = isPacked(grid, light.accumulated);
  pass.specialize("kPackedLight", packed).specialize("kLightGrid", light.lightGrid.has_value());
  specializeLight(pass, groupsOf(light));
  specializeAlpha(light, pass);
  pass.sampleIf(packed, "packedAccumulated", light.accumulated, number);
  if (packed) {
    pass.sample("accumulated", light.lighting);
  } else {
    pass.sample("accumulated", light.accumulated);
  }
}

/// Whether accumulated light is mixed into the result. That takes both a history and this frame's light.
bool addsResidual(const BlockLight& light, const BlockRegressionSettings& settings) {
  return settings.share.enabled && light.alpha == LightingAlpha::SampleCount && light.lighting.valid();
}

/// The pass that gathers the moments of blocks and cells, without its outputs.
fg::PassBuilder declareMoments(const BlockGrid& grid, const BlockLight& light, const Guides& guides) {
  const bool packed = isPacked(grid, light.accumulated);
  fg::PassBuilder gather = readPixels(grid, light.lightGrid ? light.lightGrid->depth : guides.depth,
                                      light.lightGrid ? light.lightGrid->features : guides.features, "block moments",
                                      shaders::blockMoments({.packed = packed}));
  gather.sample("accumulated", light.accumulated);
  // What stands in for an unread texture of colours is another one that is read. Beside packed light there is only the
  // lighting, which is therefore declared as read even without antilag.
  const bool antilag = light.antilag.has_value();
  const fg::Texture colour = packed ? light.lighting : light.accumulated;
  gather.specialize("kAntilag", antilag)
      .sampleIf(antilag, "antilag", antilag ? light.antilag->factor : fg::Texture{}, colour)
      .sampleIf(antilag || packed, "lighting", light.lighting, colour);
  if (!packed) specializeAlpha(light, gather);
  // Antilag reads the lighting of one frame, which may be sparse even if accumulated light has a texel for every pixel.
  specializeLight(gather, light.antilag ? light.pattern : groupsOf(light));
  gather.specialize("kLightGrid", light.lightGrid.has_value())
      .specialize("kCellBlocks", grid.cellBlocks)
      .dispatch({kThreadsPerBlock * grid.blocks.width, grid.blocks.height});
  return gather;
}

}  // namespace

float coarseSamplesAt(std::uint32_t height, float coarseSamples) {
  constexpr float kLargestUnscaled = 360.0F;
  const float larger = std::max(static_cast<float>(height) / kLargestUnscaled, 1.0F);
  return coarseSamples / (larger * larger);
}

BlockFits addBlockRegression(StageGraph graph, fg::Buffer frame, const BlockLight& light, const Guides& guides,
                             const BlockRegressionSettings& settings) {
  if (!(settings.planeNear < settings.planeFar)) {
    throw std::invalid_argument("setting blocks.plane-near must be below blocks.plane-far");
  }
  const BlockGrid grid = gridOf(graph, frame, graph->textureDesc(guides.depth).extent, settings, light);
  if (std::uint64_t{sizeof(StoredBlockFit)} * grid.blocks.width * grid.blocks.height > kLargestBuffer) {
    throw std::invalid_argument(
        "setting blocks.size of " + std::to_string(grid.size) + " makes " + std::to_string(grid.blocks.width) + " x " +
        std::to_string(grid.blocks.height) +
        " blocks, whose fits are too many for one buffer; take larger blocks or a smaller image");
  }
  fg::PassBuilder gather = declareMoments(grid, light, guides);
  const BlockAverages blocks = writeAverages(grid, gather, grid.blocks, "");
  const BlockAverages cells = writeAverages(grid, gather, grid.cells, " of cells", "outCell");
  const fg::Texture normal =
      gather.store("outNormal", graph->texture("block normal", {VK_FORMAT_R32_UINT, grid.blocks}));
  const FineFit fine = addFineFit(grid, blocks, normal, settings.iterations);
  return {.fine = fine.fits, .coarse = addCoarseFit(grid, cells, fine.depth), .depth = fine.depth};
}

fg::Texture addBlockReconstruction(StageGraph graph, fg::Buffer frame, const BlockLight& light, const Guides& guides,
                                   const BlockFits& fits, fg::Texture target, const BlockRegressionSettings& settings) {
  const BlockGrid grid = gridOf(graph, frame, graph->textureDesc(guides.depth).extent, settings, light);
  const bool readsPacked = isPacked(grid, light.accumulated);
  const bool writesPacked = lightStorageOf(graph->textureDesc(target).format) == LightStorage::Packed;
  const auto reconstruct = [&](const std::string& name, const fg::Shader& shader) {
    fg::PassBuilder pass = readPixels(grid, guides.depth, guides.features, name, shader);
    pass.load("fineFits", fits.fine)
        .load("coarseFits", fits.coarse)
        .specialize("kCellSize", grid.cellSize)
        .dispatch(reconstructionThreads(grid, shader));
    return pass;
  };
  graph.offer(reconstructionViews(), grid.pixels, [&](const std::string& name) {
    fg::PassBuilder pass = reconstruct(name, shaders::blockApplyView);
    readLightInView(grid, light, guides.depth, pass);
    return pass;
  });
  graph.offerLightDirection([&](const std::string& name) { return reconstruct(name, shaders::blockApplyDirection); });

  const bool residual = addsResidual(light, settings);
  const fg::Shader& shader = residual ? (writesPacked ? shaders::blockApplyResidualPacked : shaders::blockApplyResidual)
                                      : (writesPacked ? shaders::blockApplyPacked : shaders::blockApply);
  fg::PassBuilder pass = reconstruct("block apply", shader);
  if (!writesPacked) {
    // Accumulated light that is not packed is never sparse: it has a texel for every pixel, which is 0 where a pixel
    // without a surface has no sample.
    pass.sample("passThrough", readsPacked ? light.lighting : light.accumulated);
    specializeLight(pass, readsPacked ? light.pattern : LightPattern{});
  }
  if (residual) {
    addAccumulatedShare(graph, pass,
                        {.frame = frame,
                         .accumulated = light.accumulated,
                         .lighting = light.lighting,
                         .antilag = light.antilag ? light.antilag->factor : fg::Texture{},
                         .guides = guides,
                         .blockDepth = fits.depth,
                         .blockSize = grid.size,
                         .tileSize = tileSizeOf(grid, shader),
                         .tileOffset = pixelsBeforeImage(grid),
                         .tiles = tilesOf(grid, shader),
                         .history = light.history},
                        settings.share);
  }
  return pass.store("outFiltered", target);
}

}  // namespace walr
