#pragma once

#include <string>
#include <string_view>

#include "framegraph/plan/plan.h"

/// A plan made readable. Everything goes by name and in an order of its own, so that two registrations of one
/// description print alike.
namespace fg {

/// Line by line: memory, resources with their place, passes with their barriers, releases, culled passes.
std::string toText(const GraphDesc& graph, const Plan& plan);

/// One barrier in words, without the resource's name.
std::string toText(const GraphDesc& graph, const PlannedBarrier& barrier);

/// The whole plan: `passes[]`, `textures[]`, `buffers[]`, `barriers[]`, `heaps[]`, `histories[]`, `culled[]`,
/// `memory` (bytes: `persistent_bytes`, `transient_unaliased_bytes`, `transient_peak_bytes`,
/// `transient_lower_bound_bytes`) and `traffic` (`bytes_read`, `bytes_written`, `pixels`, `bytes_per_pixel`). Flags are
/// numbers, as Vulkan has them, next to a description in words. A transient in the memory of histories names their
/// images as `aliases`; heaps that change places every frame name each other as `swaps_with`.
std::string toJson(const GraphDesc& graph, const Plan& plan);

/// Read back what `toJson` wrote, for the same description in any order of registration.
/// @throws std::invalid_argument naming what is missing, of the wrong kind, or not in the graph
Plan planFromJson(const GraphDesc& graph, std::string_view json);

/// Passes and versions of resources as a directed graph in Graphviz' language. Culled passes are dashed.
std::string toDot(const GraphDesc& graph, const Plan& plan);

/// Shared memory over passes: one rectangle a transient, heaps stacked, as an SVG image. Images of histories that
/// transients may alias are grey while they hold something.
std::string toSvg(const GraphDesc& graph, const Plan& plan);

/// Why a pass is not executed, or that it is; follows the chain of readers to its ends.
std::string whyCulled(const GraphDesc& graph, const Plan& plan, std::string_view pass);

/// Why every barrier before a pass is there, with the declarations that cause it.
std::string whyBarriers(const GraphDesc& graph, const Plan& plan, std::string_view pass);

/// Why two resources do not share memory, or that they do.
std::string whyNotAliased(const GraphDesc& graph, const Plan& plan, std::string_view first, std::string_view second);

}  // namespace fg
