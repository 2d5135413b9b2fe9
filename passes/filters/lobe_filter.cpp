#include "passes/filters/lobe_filter.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "passes/conventions/light_storage.h"
#include "passes/stage/grid_extent.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

/// Pixels between the taps of each iteration: 1 or even (lobe_filter.comp).
constexpr std::array<std::uint32_t, 3> kSpacings{1, 2, 4};

/// Threads that cover all pixels: work groups of 16 x 16 that are interleaved where taps are more than 2 pixels apart.
fg::Extent threadsOf(fg::Extent pixels, std::uint32_t spacing) {
  const std::uint32_t area = 8 * std::max(spacing, 2U);
  return {gridExtent(pixels, area).width * area, gridExtent(pixels, area).height * area};
}

}  // namespace

fg::Texture addLobeFilter(StageGraph graph, const LobeFilterInputs& inputs, fg::Texture target) {
  const fg::Extent extent = graph->textureDesc(inputs.depth).extent;
  const bool readsPacked = lightStorageOf(graph->textureDesc(inputs.accumulated).format) == LightStorage::Packed;
  const bool writesPacked = lightStorageOf(graph->textureDesc(target).format) == LightStorage::Packed;
  fg::Texture colour, deviation;
  for (std::size_t i = 0; i < kSpacings.size(); ++i) {
    const std::string number = std::to_string(i);
    const bool first = i == 0, last = i + 1 == kSpacings.size();
    const fg::Shader& shader = first  ? shaders::lobeFilterFirst
                               : last ? shaders::lobeFilterLast({.packed = writesPacked})
                                      : shaders::lobeFilter;
    fg::PassBuilder pass = graph.compute("lobe filter " + number, shader);
    pass.uniform("frameConstants", inputs.frame)
        .sample("depth", inputs.depth)
        .sample("reflectors", inputs.reflectors)
        .specialize("kSpacing", kSpacings.at(i))
        .dispatch(threadsOf(extent, kSpacings.at(i)));
    if (first) {
      pass.sample("lighting", inputs.lighting)
          .specialize("kPackedMean", readsPacked)
          .sampleIf(readsPacked, "accumulatedPacked", inputs.accumulated, inputs.depth)
          .sampleIf(!readsPacked, "accumulatedHalf", inputs.accumulated, inputs.lighting)
          .specialize("kAntilag", inputs.antilag.valid())
          .sampleIf(inputs.antilag.valid(), "antilag", inputs.antilag, inputs.lighting)
          .specialize("kMaxHistory", inputs.maxHistory);
    } else {
      pass.sample("colour", colour).sample("deviation", deviation);
      if (last && !writesPacked) pass.sample("lighting", inputs.lighting);
    }
    colour =
        pass.store("outFiltered", last ? target : graph->texture("lobe mean " + number, {VK_FORMAT_R32_UINT, extent}));
    if (last) break;
    deviation = pass.store("outDeviation", graph->texture("deviation " + number, {VK_FORMAT_R16_SFLOAT, extent}));
  }
  return colour;
}

}  // namespace walr
