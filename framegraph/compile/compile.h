#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "framegraph/check/diagnose.h"
#include "framegraph/declare/graph.h"
#include "framegraph/declare/memory_model.h"
#include "framegraph/plan/plan.h"

namespace fg {

/// A plan with the warnings met on the way, or the errors that prevented it.
struct CompileResult {
  Plan plan;                            ///< Empty where there are errors.
  std::vector<Diagnostic> diagnostics;  ///< Errors and warnings, in a fixed order.
  [[nodiscard]] bool ok() const;
  /// All diagnostics, one a line.
  [[nodiscard]] std::string text() const;
};

struct CompileOptions {
  /// Let transients alias the memory of histories while that holds nothing (see alias.h). A transient there needs two
  /// images, one for even and one for odd frames: switch this off where a plan's resources get one image each.
  bool aliasHistories = true;
};

/// Turn a declared graph into a plan: a pure function of its arguments that needs no device.
CompileResult compile(const GraphDesc& graph, const MemoryModel& memory, const CompileOptions& options = {});

}  // namespace fg
