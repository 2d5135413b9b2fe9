#include "framegraph/compile/lifetimes.h"

namespace fg {

void findLifetimes(const GraphDesc& graph, std::span<const PlannedPass> order,
                   std::vector<PlannedResource>& resources) {
  for (std::uint32_t position = 0; position < order.size(); ++position) {
    for (const AccessDecl& access : graph.passes[order[position].pass].accesses) {
      PlannedResource& resource = resources[access.resource];
      if (resource.firstUse == kNone) resource.firstUse = position;
      resource.lastUse = position;
    }
  }
}

}  // namespace fg
