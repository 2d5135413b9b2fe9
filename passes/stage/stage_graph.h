#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "framegraph/declare/graph.h"
#include "passes/stage/inspection.h"

namespace walr {

class SharedGuides;

/// One light of several in a graph.
struct SharedLight {
  SharedGuides* guides = nullptr;  ///< What the lights share; null if there is one light.
  /// What the names of its passes, textures and histories begin with, so that no two lights have the same. Empty for
  /// the first light. It must outlive the `StageGraph`.
  std::string_view prefix = {};
};

/// The graph that a stage adds its passes to, and optionally the views and counters that a caller wants of it, and what
/// several lights share. Refers to all of them, which must outlive it.
class StageGraph {
 public:
  using Where = fg::SourceLocation;

  StageGraph(fg::Graph& graph) : graph_(&graph) {}
  StageGraph(fg::Graph& graph, Inspection& inspection, const SharedLight& light = {})
      : graph_(&graph), inspection_(&inspection), light_(light) {}

  const StageGraph* operator->() const { return this; }
  operator const fg::Graph&() const { return *graph_; }

  /// What the lights of a view share; null if there is one light.
  [[nodiscard]] SharedGuides* shared() const { return light_.guides; }

  /// As the functions of `fg::Graph`, with the light's prefix before the name.
  [[nodiscard]] fg::Texture texture(const std::string& name, const fg::TextureDesc& desc,
                                    Where where = Where::current()) const {
    return graph_->texture(named(name), desc, where);
  }
  [[nodiscard]] fg::Buffer buffer(const std::string& name, const fg::BufferDesc& desc,
                                  Where where = Where::current()) const {
    return graph_->buffer(named(name), desc, where);
  }
  [[nodiscard]] fg::Buffer upload(const std::string& name, std::span<const std::byte> contents,
                                  Where where = Where::current()) const {
    return graph_->upload(named(name), contents, where);
  }
  [[nodiscard]] fg::History history(const std::string& name, const fg::TextureDesc& desc,
                                    Where where = Where::current()) const {
    return graph_->history(named(name), desc, where);
  }
  [[nodiscard]] fg::PassBuilder compute(const std::string& name, const fg::Shader& shader,
                                        Where where = Where::current()) const {
    return graph_->compute(named(name), shader, where);
  }
  [[nodiscard]] const fg::TextureDesc& textureDesc(fg::Texture texture) const { return graph_->textureDesc(texture); }

  /// Offer a stage's views: see `Inspection::offer`. Adds nothing without an `Inspection`.
  void offer(std::span<const ViewInfo> views, fg::Extent extent, const Inspection::DeclareView& declare,
             StageIteration iteration = {}) const {
    if (inspection_ != nullptr) inspection_->offer(*this, views, extent, declare, iteration);
  }
  /// Offer the mean over time of the method's light: see `Inspection::offerHistoryLength`.
  void offerHistoryLength(fg::Texture accumulated, std::uint32_t channel = 3, const LightPattern& groups = {}) const {
    if (inspection_ != nullptr) inspection_->offerHistoryLength(*this, accumulated, channel, groups);
  }
  /// Offer the slopes of the method's light over the normal: see `Inspection::offerLightDirection`.
  void offerLightDirection(const Inspection::DeclareView& declare) const {
    if (inspection_ != nullptr) inspection_->offerLightDirection(declare);
  }
  /// Offer the expected error of the method's result: see `Inspection::offerExpectedError`.
  void offerExpectedError(const Inspection::DeclareView& declare) const {
    if (inspection_ != nullptr) inspection_->offerExpectedError(declare);
  }
  /// @throws std::invalid_argument naming a wanted view that no stage has offered, or saying that no stage has history,
  ///         a light direction or an expected error
  void requireOutputs() const {
    if (inspection_ == nullptr) return;
    inspection_->requireViews();
    inspection_->requireHistoryLength();
    inspection_->requireLightDirection();
    inspection_->requireExpectedError();
  }

 private:
  [[nodiscard]] std::string named(const std::string& name) const { return std::string(light_.prefix) + name; }

  fg::Graph* graph_;
  Inspection* inspection_ = nullptr;
  SharedLight light_;
};

}  // namespace walr
