#pragma once

#include <optional>
#include <span>
#include <string>

#include "framegraph/compile/compile.h"

namespace fg {

/// Compiles again only what has changed: for hosts that declare their graph anew every frame or with every setting.
class Compiler {
 public:
  /// @param memory must outlive the compiler
  explicit Compiler(const MemoryModel& memory) : memory_(&memory) {}

  /// What `fg::compile` makes of a graph; the last result where the topology is that of the last graph. Also an error
  /// is a history whose description differs from that of the last graph without errors.
  /// @param resets names of the histories that the host resets with the change, which may then differ
  /// @returns valid until the next call
  const CompileResult& compile(const GraphDesc& graph, std::span<const std::string> resets = {});
  /// Whether the last call had to compile: executors of the plan before it are then out of date.
  [[nodiscard]] bool recompiled() const { return recompiled_; }

 private:
  const MemoryModel* memory_;
  std::optional<GraphDesc> last_;
  std::optional<GraphDesc> lastWithoutErrors_;
  CompileResult result_;
  bool recompiled_ = false;
};

}  // namespace fg
