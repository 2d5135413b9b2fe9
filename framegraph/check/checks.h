#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framegraph/check/diagnose.h"
#include "framegraph/check/diagnostic_codes.h"
#include "framegraph/declare/memory_model.h"
#include "framegraph/declare/topology.h"

/// The checks that `diagnose` runs. Each adds what it finds to `Findings`.
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
  [[nodiscard]] bool has(std::string_view code) const {
    return std::ranges::find(list_, code, &Diagnostic::code) != list_.end();
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

/// Checks names, sizes, formats and the states of imports.
void checkResources(const Topology& topology, const MemoryModel& memory, Findings& findings);
/// Checks every pass on its own: handles, ranges, conflicting accesses, attachments and dispatches.
void checkPasses(const Topology& topology, Findings& findings);
/// Checks that every version has one writer, that what is read has been written, and the rules of histories and
/// exports.
void checkVersions(const Topology& topology, Findings& findings);
/// Finds passes that wait for each other, and reads of versions that have been overwritten by then.
void checkOrder(const Topology& topology, Findings& findings);
/// Compares what passes declare with what their shaders do.
void checkShaders(const Topology& topology, Findings& findings);

}  // namespace fg
