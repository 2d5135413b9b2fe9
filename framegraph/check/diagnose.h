#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framegraph/declare/source_location.h"

namespace fg {

class MemoryModel;
class Topology;
struct GraphDesc;

enum class Severity : std::uint8_t { Warning, Error };

/// One fault in a declared graph.
struct Diagnostic {
  std::string code;  ///< Stable identifier for programs: "FG001"; see diagnostic_codes.h.
  Severity severity = Severity::Error;
  std::string pass;      ///< Name of the pass at fault; empty if there is none.
  std::string resource;  ///< Name of the texture or buffer at fault; empty if there is none.
  std::string message;   ///< What is wrong and what to change.
  SourceLocation where;  ///< The declaration at fault.
};

/// One line: source location, severity, code, message.
std::string toText(const Diagnostic& diagnostic);

/// All faults of a declared graph on a device, ordered by code, pass and resource.
std::vector<Diagnostic> diagnose(const Topology& topology, const MemoryModel& memory);

}  // namespace fg
