#include "samples/image/fingerprint.h"

#include <fstream>
#include <iomanip>
#include <sstream>
#include <vector>

#include "samples/errors.h"

namespace walr {

Fingerprint& Fingerprint::add(std::span<const std::byte> bytes) {
  constexpr std::uint64_t kPrime = 1099511628211ULL;
  for (const std::byte byte : bytes) value_ = (value_ ^ std::to_integer<std::uint64_t>(byte)) * kPrime;
  return *this;
}

Fingerprint& Fingerprint::add(std::string_view text) {
  const std::uint64_t length = text.size();
  return add(std::as_bytes(std::span(&length, 1))).add(std::as_bytes(std::span(text)));
}

Fingerprint& Fingerprint::addFile(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::vector<char> buffer(1U << 20U);
  while (stream) {
    stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    add(std::as_bytes(std::span(buffer).first(static_cast<std::size_t>(stream.gcount()))));
  }
  if (!stream.eof()) throw InputError(path.string() + ": cannot be read");
  return *this;
}

std::string Fingerprint::text() const {
  std::ostringstream stream;
  stream << std::hex << std::setw(16) << std::setfill('0') << value_;
  return stream.str();
}

}  // namespace walr
