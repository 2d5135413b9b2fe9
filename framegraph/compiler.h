#pragma once

#include <optional>
#include <span>
#include <string>

#include "framegraph/compile.h"

namespace fg {

/// True where two descriptions have one plan: where they differ at most in what is only recorded, which is values of
/// push constants and of specialization constants, work group counts, callbacks, and where in the source it all stands.
/// `vk::Executor::update` takes such differences over as they are.
bool sameTopology(const GraphDesc& a, const GraphDesc& b);

/// True where two descriptions would have the same topology if their textures and buffers were of the same sizes.
bool sameButForSizes(const GraphDesc& a, const GraphDesc& b);

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
