#pragma once

#include <cstdint>
#include <span>

#include "framegraph/declare/graph.h"
#include "passes/inspection.h"

namespace walr {

/// The graph that a stage adds its passes to, and optionally the views and counters that a caller wants of it. Refers
/// to both, which must outlive it.
class StageGraph {
 public:
  StageGraph(fg::Graph& graph) : graph_(&graph) {}
  StageGraph(fg::Graph& graph, Inspection& inspection) : graph_(&graph), inspection_(&inspection) {}

  fg::Graph* operator->() const { return graph_; }
  operator fg::Graph&() const { return *graph_; }

  /// Offer a stage's views: see `Inspection::offer`. Adds nothing without an `Inspection`.
  void offer(std::span<const ViewInfo> views, fg::Extent extent, const Inspection::DeclareView& declare,
             StageIteration iteration = {}) const {
    if (inspection_ != nullptr) inspection_->offer(*graph_, views, extent, declare, iteration);
  }
  /// Offer the mean over time of the method's light: see `Inspection::offerHistoryLength`.
  void offerHistoryLength(fg::Texture accumulated, std::uint32_t channel = 3, const LightPattern& groups = {}) const {
    if (inspection_ != nullptr) inspection_->offerHistoryLength(*graph_, accumulated, channel, groups);
  }
  /// Offer the slopes of the method's light over the normal: see `Inspection::offerLightDirection`.
  void offerLightDirection(const Inspection::DeclareView& declare) const {
    if (inspection_ != nullptr) inspection_->offerLightDirection(declare);
  }
  /// @throws std::invalid_argument naming a wanted view that no stage has offered, or saying that no stage has history
  ///         or a light direction
  void requireOutputs() const {
    if (inspection_ == nullptr) return;
    inspection_->requireViews();
    inspection_->requireHistoryLength();
    inspection_->requireLightDirection();
  }

 private:
  fg::Graph* graph_;
  Inspection* inspection_ = nullptr;
};

}  // namespace walr
