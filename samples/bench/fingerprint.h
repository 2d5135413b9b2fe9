#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace walr {

/// A running 64-bit hash of bytes (FNV-1a), to tell whether something is what it was. Not safe against malice.
class Fingerprint {
 public:
  Fingerprint& add(std::span<const std::byte> bytes);
  /// A text with its length, so that neighbours cannot run together.
  Fingerprint& add(std::string_view text);
  /// A file's contents.
  /// @throws InputError where it cannot be read
  Fingerprint& addFile(const std::filesystem::path& path);

  [[nodiscard]] std::uint64_t value() const { return value_; }
  /// 16 hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

}  // namespace walr
