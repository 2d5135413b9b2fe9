#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/plan/plan.h"

namespace walr {

/// The work of one pass of a plan. Consecutive passes that run the same pipeline, such as the tiles of a picture,
/// count as one.
struct PassWork {
  std::string pass;                       ///< "a-trous 0"; "first to last" of several passes.
  std::uint32_t batch = 0;                ///< Of the first of them: see `fg::PlannedPass::batch`.
  const fg::ComputeDispatch* dispatch{};  ///< Of the first of them; belongs to the graph.
  std::vector<std::size_t> planned;       ///< Indices into `Plan::passes`.
  std::uint64_t groups = 0;
  std::uint64_t threads = 0;
  std::uint64_t bytes = 0;  ///< Each texel and each byte of a buffer that the pass accesses, once.
};

/// @param graph must outlive the result
/// @throws std::runtime_error naming a pass that is no dispatch, or whose number of work groups only the device knows
std::vector<PassWork> workOf(const fg::GraphDesc& graph, const fg::Plan& plan);

}  // namespace walr
