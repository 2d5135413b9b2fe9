#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace walr {

/// A running 64-bit hash of bytes (FNV-1a) that detects whether inputs have changed. Not cryptographic.
class Fingerprint {
 public:
  Fingerprint& add(std::span<const std::byte> bytes);
  /// Add a text and its length, so that two texts hash differently from their concatenation.
  Fingerprint& add(std::string_view text);
  /// Add the contents of a file.
  /// @throws InputError if the file cannot be read
  Fingerprint& addFile(const std::filesystem::path& path);

  [[nodiscard]] std::uint64_t value() const { return value_; }
  /// The hash as 16 hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

}  // namespace walr
