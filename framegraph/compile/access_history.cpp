#include "framegraph/compile/access_history.h"

#include <algorithm>

#include "framegraph/declare/access.h"
#include "framegraph/declare/topology.h"

namespace fg {
namespace {

bool isHistory(const ResourceDecl& resource) {
  return resource.lifetime == Lifetime::HistoryPrevious || resource.lifetime == Lifetime::HistoryCurrent;
}

/// True if the access belongs to the group: a further read in the same layout, or an access in the same batch.
bool continues(const AccessGroup& group, const AccessInfo& info, VkImageLayout layout, std::uint32_t batch) {
  return group.layout == layout && (group.batch == batch || (group.writeMask == VK_ACCESS_2_NONE && !info.writes()));
}

BarrierReason reasonFor(const SubresourceState& state, const AccessGroup& next) {
  if (state.pendingWrite != VK_ACCESS_2_NONE) {
    return next.readMask != VK_ACCESS_2_NONE ? BarrierReason::ReadAfterWrite : BarrierReason::WriteAfterWrite;
  }
  return next.writeMask != VK_ACCESS_2_NONE ? BarrierReason::WriteAfterRead : BarrierReason::LayoutChange;
}

}  // namespace

AccessHistory::AccessHistory(const GraphDesc& graph, const Plan& plan)
    : graph_(&graph), first_(graph.resources.size() + 1) {
  for (std::size_t i = 0; i < graph.resources.size(); ++i) {
    const ResourceDecl& resource = graph.resources[i];
    const SubresourceRange all = resolved(resource, {});
    first_[i + 1] = first_[i] + (isHistory(resource) ? 1 : all.mipCount * all.layerCount);
  }
  groups_.resize(first_.back());
  for (const PlannedPass& planned : plan.passes) {
    for (const AccessDecl& access : graph.passes[planned.pass].accesses) add(planned.batch, access);
  }
}

SubresourceRange AccessHistory::range(std::uint32_t resource, std::uint32_t subresource) const {
  if (subresourceCount(resource) == 1) return {};
  const std::uint32_t layers = resolved(graph_->resources[resource], {}).layerCount;
  return {subresource / layers, 1, subresource % layers, 1};
}

std::uint32_t AccessHistory::lastUnreadWrite(std::uint32_t resource) const {
  std::uint32_t last = kNone;
  for (std::uint32_t i = 0; i < subresourceCount(resource); ++i) {
    const std::span<const AccessGroup> all = groups(resource, i);
    if (all.empty() || all.back().writeMask == VK_ACCESS_2_NONE) continue;
    last = last == kNone ? all.back().batch : std::max(last, all.back().batch);
  }
  return last;
}

void AccessHistory::add(std::uint32_t batch, const AccessDecl& access) {
  const AccessInfo& info = accessInfo(access.access);
  const ResourceDecl& resource = graph_->resources[access.resource];
  const bool isTexture = std::holds_alternative<TextureDesc>(resource.desc);
  const VkImageLayout layout = isTexture ? info.layout : VK_IMAGE_LAYOUT_UNDEFINED;
  SubresourceRange part = resolved(resource, access.range);
  if (subresourceCount(access.resource) == 1) part = {0, 1, 0, 1};
  const std::uint32_t layers = resolved(resource, {}).layerCount;
  for (std::uint32_t mip = part.baseMip; mip < part.baseMip + part.mipCount; ++mip) {
    for (std::uint32_t layer = part.baseLayer; layer < part.baseLayer + part.layerCount; ++layer) {
      auto& groups = groups_[first_[access.resource] + mip * layers + layer];
      if (groups.empty() || !continues(groups.back(), info, layout, batch)) {
        groups.emplace_back();
        groups.back().batch = batch;
        groups.back().layout = layout;
      }
      groups.back().stage |= info.stage;
      groups.back().readMask |= info.readMask;
      groups.back().writeMask |= info.writeMask;
    }
  }
}

SubresourceState externalState(const ExternalState& state) {
  const VkAccessFlags2 writes = state.access & kWriteAccesses;
  // No stage: the host has waited for a fence or semaphore, which makes all writes available and visible.
  const bool waited = state.stage == VK_PIPELINE_STAGE_2_NONE;
  return {.stage = state.stage,
          .pendingWrite = waited ? VK_ACCESS_2_NONE : writes,
          .visibleStage = waited ? ~VkPipelineStageFlags2{0} : state.stage,
          .visibleAccess = waited ? ~VkAccessFlags2{0} : (writes != 0 ? VK_ACCESS_2_NONE : state.access),
          .layout = state.layout};
}

std::optional<PlannedBarrier> advance(SubresourceState& state, const AccessGroup& next) {
  const bool visible = (next.stage & ~state.visibleStage) == 0 && (next.readMask & ~state.visibleAccess) == 0;
  const bool relayout = state.layout != next.layout;
  const bool waits = state.stage != VK_PIPELINE_STAGE_2_NONE &&
                     (next.writeMask != VK_ACCESS_2_NONE || state.pendingWrite != VK_ACCESS_2_NONE || !visible);
  std::optional<PlannedBarrier> barrier;
  if (relayout || waits) {
    barrier.emplace();
    barrier->reason = reasonFor(state, next);
    barrier->srcStage = state.stage;
    barrier->srcAccess = state.pendingWrite;
    barrier->dstStage = next.stage;
    barrier->dstAccess = next.readMask | next.writeMask;
    barrier->oldLayout = state.layout;
    barrier->newLayout = next.layout;
    state = SubresourceState{};
    state.visibleStage = next.stage;
    state.visibleAccess = next.readMask;
  }
  state.stage |= next.stage;
  state.layout = next.layout;
  if (next.writeMask != VK_ACCESS_2_NONE) {
    state.pendingWrite = next.writeMask;
    state.visibleStage = VK_PIPELINE_STAGE_2_NONE;
    state.visibleAccess = VK_ACCESS_2_NONE;
  }
  return barrier;
}

}  // namespace fg
