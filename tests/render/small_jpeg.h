#pragma once

#include <string>
#include <string_view>

namespace walr::render::test {

/// A baseline JPEG of 24 x 16 texels, written by libjpeg: ramps of red and green.
inline std::string smallJpeg() {
  constexpr std::string_view kHex =
      "ffd8ffe000104a46494600010100000100010000ffdb0043001b12141714111b1716171e1c1b2028422b28252528513a3d30"
      "42605565645f555d5b6a7899816a7190735b5d85b586909ea3abadab6780bcc9baa6c799a8aba4ffdb0043011c1e1e282328"
      "4e2b2b4ea46e5d6ea4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4"
      "a4a4a4a4a4a4a4a4ffc00011080010001803012200021101031101ffc4001600010101000000000000000000000000000405"
      "00ffc4001b10000105010100000000000000000000000001020304611121ffc4001601010101000000000000000000000000"
      "00030105ffc4001a110003000301000000000000000000000000010203041112ffda000c03010002110311003f008ccaf821"
      "95b07475f05475b0187e83c5b04f655c3161b0237ce754c5758a5f1b34a361f0ffd9";
  const auto digit = [](char c) { return static_cast<unsigned int>(c <= '9' ? c - '0' : c - 'a' + 10); };
  std::string bytes;
  for (std::size_t i = 0; i < kHex.size(); i += 2) {
    bytes += static_cast<char>(digit(kHex[i]) << 4U | digit(kHex[i + 1]));
  }
  return bytes;
}

}  // namespace walr::render::test
