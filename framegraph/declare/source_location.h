#pragma once

#include <cstdint>

namespace fg {

/// The place in the host's source at which something was declared. Replaces std::source_location, which clang has only
/// since version 16, and has the same interface.
class SourceLocation {
 public:
  /// The place of the call, if used as a default argument.
  static constexpr SourceLocation current(const char* file = __builtin_FILE(), std::uint32_t line = __builtin_LINE()) {
    SourceLocation location;
    location.file_ = file;
    location.line_ = line;
    return location;
  }
  [[nodiscard]] constexpr const char* file_name() const { return file_; }
  [[nodiscard]] constexpr std::uint32_t line() const { return line_; }

 private:
  const char* file_ = "";
  std::uint32_t line_ = 0;
};

}  // namespace fg
