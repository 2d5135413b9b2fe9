#pragma once

#include <string>
#include <vector>

#include "framegraph/check/diagnose.h"
#include "framegraph/declare/graph.h"
#include "framegraph/declare/memory_model.h"
#include "framegraph/plan/plan.h"

namespace fg {

/// A plan with warnings, or the errors that prevented it.
struct CompileResult {
  Plan plan;                            ///< Empty if there are errors.
  std::vector<Diagnostic> diagnostics;  ///< Errors and warnings, in a fixed order.
  [[nodiscard]] bool ok() const;
  /// All diagnostics, one per line.
  [[nodiscard]] std::string text() const;
};

struct CompileOptions {
  /// Let transients alias the memory of histories while it holds nothing (see alias.h). Such a transient needs two
  /// images, one for even and one for odd frames. Hosts that make one image per resource must switch this off.
  bool aliasHistories = true;
};

/// Turn a declared graph into a plan: a pure function of its arguments that needs no device.
CompileResult compile(const GraphDesc& graph, const MemoryModel& memory, const CompileOptions& options = {});

}  // namespace fg
