#pragma once

#include <cstdint>
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

/// "12.3 % of 4567 pixels".
std::string share(std::uint64_t part, std::uint64_t whole, const std::string& of);

}  // namespace walr
