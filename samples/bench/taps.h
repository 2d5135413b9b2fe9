#pragma once

#include <optional>

#include "framegraph/declare/graph.h"
#include "framegraph/plan/plan.h"

namespace walr {

/// Number of taps of light that a method takes per pixel: fetches of a texel or cell of the light itself, of its
/// history, or of averages of it. Fetches of guides and those of edge tracing do not count. A pass on a coarser grid
/// counts by the number of its texels per pixel.
/// @returns nullopt if the plan contains a shader whose taps are not known here
std::optional<double> tapsPerPixel(const fg::GraphDesc& graph, const fg::Plan& plan, fg::Extent extent);
/// The same of one pass of the plan.
std::optional<double> tapsPerPixel(const fg::GraphDesc& graph, const fg::PlannedPass& planned, fg::Extent extent);

}  // namespace walr
