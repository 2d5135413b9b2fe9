#include "passes/filters/lobe_filter.h"

#include <array>
#include <cstdint>
#include <string>

#include "passes/conventions/light_storage.h"
#include "passes/stage/grid_extent.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

/// Constants of lobe_filter.comp.
struct Iteration {
  std::uint32_t spacing;  ///< kSpacing.
  float luminanceErrors;  ///< kLuminanceErrors, halved from one iteration to the next (Dammertz et al. 2010).
};
/// With taps 1, 3 and 9 pixels apart, every pixel of the window would count once. Taps 8 apart count few pixels twice,
/// and an even spacing lets a work group take its taps from quads.
constexpr std::array kIterations{Iteration{1, 15.0F}, Iteration{3, 7.5F}, Iteration{8, 3.75F}};

/// Threads that cover all pixels: work groups of 16 x 16, which are interleaved where the spacing is even
/// (lobe_filter.comp).
fg::Extent threadsOf(fg::Extent pixels, std::uint32_t spacing) {
  const std::uint32_t area = spacing % 2 == 0 ? 8 * spacing : 16;
  return {gridExtent(pixels, area).width * area, gridExtent(pixels, area).height * area};
}

}  // namespace

fg::Texture addLobeFilter(StageGraph graph, const LobeFilterInputs& inputs, fg::Texture target) {
  const fg::Extent extent = graph->textureDesc(inputs.depth).extent;
  const bool readsPacked = lightStorageOf(graph->textureDesc(inputs.accumulated).format) == LightStorage::Packed;
  const bool writesPacked = lightStorageOf(graph->textureDesc(target).format) == LightStorage::Packed;
  fg::Texture colour, standardError;
  for (std::size_t i = 0; i < kIterations.size(); ++i) {
    const std::string number = std::to_string(i);
    const bool first = i == 0, last = i + 1 == kIterations.size();
    const fg::Shader& shader = first  ? shaders::lobeFilterFirst
                               : last ? shaders::lobeFilterLast({.packed = writesPacked})
                                      : shaders::lobeFilter;
    fg::PassBuilder pass = graph.compute("lobe filter " + number, shader);
    pass.uniform("frameConstants", inputs.frame)
        .sample("depth", inputs.depth)
        .sample("reflectors", inputs.reflectors)
        .specialize("kSpacing", kIterations.at(i).spacing)
        .specialize("kLuminanceErrors", kIterations.at(i).luminanceErrors)
        .dispatch(threadsOf(extent, kIterations.at(i).spacing));
    if (first) {
      pass.sample("lighting", inputs.lighting)
          .specialize("kPackedMean", readsPacked)
          .sampleIf(readsPacked, "accumulatedPacked", inputs.accumulated, inputs.depth)
          .sampleIf(!readsPacked, "accumulatedHalf", inputs.accumulated, inputs.lighting)
          .specialize("kAntilag", inputs.antilag.valid())
          .sampleIf(inputs.antilag.valid(), "antilag", inputs.antilag, inputs.lighting)
          .specialize("kMaxHistory", inputs.maxHistory);
    } else {
      pass.sample("colour", colour).sample("standardError", standardError);
      if (last && !writesPacked) pass.sample("lighting", inputs.lighting);
    }
    colour =
        pass.store("outFiltered", last ? target : graph->texture("lobe mean " + number, {VK_FORMAT_R32_UINT, extent}));
    if (last) break;
    standardError =
        pass.store("outStandardError", graph->texture("standard error " + number, {VK_FORMAT_R16_SFLOAT, extent}));
  }
  return colour;
}

}  // namespace walr
