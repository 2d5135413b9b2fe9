#pragma once

#include <optional>

#include "framegraph/declare/graph.h"
#include "framegraph/plan/plan.h"

namespace walr {

/// Values of light that a method gathers a pixel: how often its passes fetch a texel or cell of the light itself, of
/// its history, or of averages that hold it, without guides, and without what edge tracing walks over. Passes on a
/// coarser grid count by their share of the pixels.
/// @returns nothing where the plan holds a shader that this does not know
std::optional<double> tapsPerPixel(const fg::GraphDesc& graph, const fg::Plan& plan, fg::Extent extent);
/// The same of one pass of the plan.
std::optional<double> tapsPerPixel(const fg::GraphDesc& graph, const fg::PlannedPass& planned, fg::Extent extent);

}  // namespace walr
