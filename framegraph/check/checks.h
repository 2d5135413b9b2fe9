#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framegraph/check/diagnose.h"
#include "framegraph/check/diagnostic_codes.h"
#include "framegraph/declare/memory_model.h"
#include "framegraph/declare/topology.h"

/// The checks that `diagnose` is made of. Each adds what it finds.
namespace fg {

/// Collects diagnostics about one graph.
class Findings {
 public:
  explicit Findings(const GraphDesc& graph) : graph_(&graph) {}

  void error(std::string_view code, const PassDecl& pass, const AccessDecl& access, std::string message) {
    add(code, Severity::Error, pass.name, resourceName(access.resource), std::move(message), access.where);
  }
  void error(std::string_view code, const PassDecl& pass, std::string message) {
    add(code, Severity::Error, pass.name, {}, std::move(message), pass.where);
  }
  void error(std::string_view code, const ResourceDecl& resource, std::string message) {
    add(code, Severity::Error, {}, resource.name, std::move(message), resource.where);
  }
  void error(std::string_view code, const ExportDecl& exported, std::string message) {
    add(code, Severity::Error, {}, resourceName(exported.resource.resource), std::move(message), exported.where);
  }
  void add(std::string_view code, Severity severity, std::string pass, std::string resource, std::string message,
           SourceLocation where) {
    list_.push_back({std::string(code), severity, std::move(pass), std::move(resource), std::move(message), where});
  }
  [[nodiscard]] std::vector<Diagnostic> take() { return std::move(list_); }
  /// Empty for invalid handles.
  [[nodiscard]] std::string resourceName(std::uint32_t resource) const {
    return resource < graph_->resources.size() ? graph_->resources[resource].name : std::string();
  }

 private:
  const GraphDesc* graph_;
  std::vector<Diagnostic> list_;
};

/// Names, sizes, formats, imports.
void checkResources(const Topology& topology, const MemoryModel& memory, Findings& findings);
/// Handles, ranges and conflicts inside every single pass; attachments and dispatches.
void checkPasses(const Topology& topology, Findings& findings);
/// Who writes and reads which version; histories and exports.
void checkVersions(const Topology& topology, Findings& findings);
/// Passes that wait for each other, and versions read too late.
void checkOrder(const Topology& topology, Findings& findings);
/// What passes declare against what their shaders do.
void checkShaders(const Topology& topology, Findings& findings);

}  // namespace fg
