#pragma once

#include <string>
#include <string_view>

namespace walr {

/// Something that looks wrong in a host's inputs.
struct LintFinding {
  std::string_view name;    ///< For programs: "motion-x-direction".
  std::string what;         ///< What was found, with figures.
  std::string_view cause;   ///< What it most likely comes from.
  std::string_view wayOut;  ///< What to do about it.

  /// All of it in a paragraph.
  [[nodiscard]] std::string text() const;
};

}  // namespace walr
