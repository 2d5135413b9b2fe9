#pragma once

#include <cstdint>

namespace fg {

/// Where in the host's source something was declared. A stand-in for std::source_location, with its interface, which
/// clang has only from version 16 on.
class SourceLocation {
 public:
  /// As a default argument: the place of the call.
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
