#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "samples/bench/variant.h"
#include "samples/estimate/machine.h"
#include "samples/estimate/shader_figures.h"

namespace walr {

/// ESTIMATED time of one pass on a machine (`estimateOf`), which is no measurement.
struct PassEstimate {
  std::string pass;  ///< See `PassWork`.
  std::uint32_t batch = 0;
  std::vector<std::size_t> planned;  ///< Its passes, by their positions in the plan.
  std::uint64_t bytes = 0;
  std::optional<Bounds> bounds;  ///< Nothing where the table has no figures.
};

/// Estimates of the passes of a variant, in the order of execution. A variant with other settings than those of its
/// method and preset has no estimates, because the table's rounds of loops hold for those only; nor has sparse light.
/// @param conventions of these, whether light is specular, and the pixels that have a sample; all others are the
///        project's own, because those of other sequences change only a few instructions
/// @throws std::invalid_argument naming a setting that is out of range
std::vector<PassEstimate> estimatePasses(const Variant& variant, fg::Extent extent, const FigureTable& table,
                                         const Machine& machine, const InputConventions& conventions = {});

/// The estimate of a frame (`FrameEstimate`) in microseconds; nothing if a pass has none.
std::optional<double> estimatedMicroseconds(const Variant& variant, fg::Extent extent, const FigureTable& table,
                                            const Machine& machine, const InputConventions& conventions = {});

}  // namespace walr
