#pragma once

#include <string>
#include <string_view>

namespace walr {

/// Something that looks wrong in a host's inputs.
struct LintFinding {
  std::string_view name;    ///< For programs: "motion-x-direction".
  std::string what;         ///< What was found, with numbers.
  std::string_view cause;   ///< Its most likely cause.
  std::string_view wayOut;  ///< How to correct it.

  /// The finding as one paragraph.
  [[nodiscard]] std::string text() const;
};

}  // namespace walr
