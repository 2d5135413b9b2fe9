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

/// One thing found wrong in a declared graph.
struct Diagnostic {
  std::string code;  ///< Stable, for machines: "FG001"; see diagnostic_codes.h.
  Severity severity = Severity::Error;
  std::string pass;      ///< Name of the pass, where one is at fault.
  std::string resource;  ///< Name of the texture or buffer, where one is at fault.
  std::string message;   ///< What is wrong and what to change.
  SourceLocation where;
};

/// One line: place, severity, code, message.
std::string toText(const Diagnostic& diagnostic);

/// Everything wrong with a declared graph on a device, found in one go and ordered by code, pass and resource.
std::vector<Diagnostic> diagnose(const Topology& topology, const MemoryModel& memory);

}  // namespace fg
