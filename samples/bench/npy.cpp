#include "samples/bench/npy.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "samples/image/file_output.h"
#include "samples/image/half.h"

namespace walr {

void writeNpy(const std::filesystem::path& path, const Image& image) {
  static_assert(std::endian::native == std::endian::little, "the header declares little-endian data");
  std::string header = "{'descr': '<f2', 'fortran_order': False, 'shape': (" + std::to_string(image.height()) + ", " +
                       std::to_string(image.width()) + ", " + std::to_string(image.components()) + "), }";
  // Magic number, version and header length take 10 bytes; the data start at a multiple of 64 bytes.
  constexpr std::size_t kPreamble = 10;
  constexpr std::size_t kAlignment = 64;
  header.append(kAlignment - (kPreamble + header.size() + 1) % kAlignment, ' ');
  header += '\n';
  std::string bytes = std::string("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xFFU);
  bytes += static_cast<char>(header.size() >> 8U);
  bytes += header;
  std::vector<std::uint16_t> halves;
  halves.reserve(image.values().size());
  for (const float value : image.values()) halves.push_back(toHalf(value).bits());
  const std::size_t start = bytes.size();
  bytes.resize(start + halves.size() * sizeof(std::uint16_t));
  std::memcpy(bytes.data() + start, halves.data(), halves.size() * sizeof(std::uint16_t));
  writeFileAtomically(path, std::as_bytes(std::span(bytes)));
}

}  // namespace walr
