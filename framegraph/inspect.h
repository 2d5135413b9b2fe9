#pragma once

#include <string>

#include "framegraph/plan.h"

/// A plan made readable. Everything goes by name and in an order of its own, so that two registrations of one
/// description print alike.
namespace fg {

/// Line by line: memory, resources with their place, passes with their barriers, releases, culled passes.
std::string toText(const GraphDesc& graph, const Plan& plan);

}  // namespace fg
