#pragma once

#include <cstdint>
#include <string>

#include "framegraph/source_location.h"

namespace fg {

enum class Severity : std::uint8_t { Warning, Error };

/// One thing found wrong in a declared graph.
struct Diagnostic {
  std::string code;  ///< Stable, for machines: "FG001".
  Severity severity = Severity::Error;
  std::string pass;      ///< Name of the pass, where one is at fault.
  std::string resource;  ///< Name of the texture or buffer, where one is at fault.
  std::string message;   ///< What is wrong and what to change.
  SourceLocation where;
};

}  // namespace fg
