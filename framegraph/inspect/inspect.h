#pragma once

#include <string>
#include <string_view>

#include "framegraph/plan/plan.h"

/// Writes plans in readable form. Resources and passes are written by name and in a fixed order, so that the output
/// does not depend on the order of registration.
namespace fg {

/// The plan as lines of text: memory, resources with their places, batches with their barriers and passes, releases,
/// culled passes.
std::string toText(const GraphDesc& graph, const Plan& plan);

/// One barrier as text, without the resource's name.
std::string toText(const GraphDesc& graph, const PlannedBarrier& barrier);

/// The whole plan: `passes[]`, `textures[]`, `buffers[]`, `barriers[]`, `heaps[]`, `histories[]`, `culled[]`,
/// `memory` (bytes: `persistent_bytes`, `transient_unaliased_bytes`, `transient_peak_bytes`,
/// `transient_lower_bound_bytes`) and `traffic` (`bytes_read`, `bytes_written`, `pixels`, `bytes_per_pixel`). Flags are
/// Vulkan's numbers; every barrier also has a `description` as text. A transient in the memory of histories lists their
/// images as `aliases`. Heaps that swap roles every frame name each other as `swaps_with`.
std::string toJson(const GraphDesc& graph, const Plan& plan);

/// Read a plan that `toJson` has written. The description must be the same, in any order of registration.
/// @throws std::invalid_argument if something is missing, of the wrong type or not in the graph; the message names it
Plan planFromJson(const GraphDesc& graph, std::string_view json);

/// Passes and versions of resources as a directed graph in the DOT language of Graphviz. Culled passes are dashed.
std::string toDot(const GraphDesc& graph, const Plan& plan);

/// An SVG image of shared memory: passes from left to right, heaps stacked, one rectangle per transient. Images of
/// histories that transients may alias are grey while they hold something.
std::string toSvg(const GraphDesc& graph, const Plan& plan);

/// Explains why a pass is culled, or states that it is executed.
std::string whyCulled(const GraphDesc& graph, const Plan& plan, std::string_view pass);

/// Explains every barrier that a pass needs by the declarations that cause it. It is recorded before the pass's batch.
std::string whyBarriers(const GraphDesc& graph, const Plan& plan, std::string_view pass);

/// Explains why two resources do not share memory, or states that they do.
std::string whyNotAliased(const GraphDesc& graph, const Plan& plan, std::string_view first, std::string_view second);

}  // namespace fg
