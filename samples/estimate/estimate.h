#pragma once

#include <optional>

#include "samples/estimate/machine.h"
#include "samples/estimate/plan_work.h"
#include "samples/estimate/shader_figures.h"

namespace walr {

/// ESTIMATED bounds of a pass on a machine, from static figures of its shader: no measurement.
/// @returns nothing if the table lacks the pipeline or the rounds of its loops
std::optional<Bounds> estimateOf(const PassWork& work, const FigureTable& table, const Machine& machine);

}  // namespace walr
