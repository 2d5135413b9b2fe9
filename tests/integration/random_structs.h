#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <walr/walr.h>

#include "tests/integration/call_check.h"

namespace walr::test {

/// A structure of a caller whose header is newer: it has further fields at its end.
template <typename Struct>
struct Grown {
  Struct value{};
  std::array<std::byte, 16> later{};
};

/// Sets `struct_size`, mostly rightly.
template <typename Struct>
void chooseSize(Dice& dice, Expectation& expected, Grown<Struct>& grown) {
  static_assert(sizeof(Grown<Struct>) == sizeof(Struct) + 16);
  grown.value.struct_size = sizeof(Struct);
  if (!dice.oneIn(24)) return;
  switch (dice.below(4)) {
    case 0:
      grown.value.struct_size = sizeof(grown);
      break;
    case 1:
      grown.value.struct_size = sizeof(grown);
      grown.later[dice.below(grown.later.size())] = std::byte{1};
      expected.fails(WALR_ERROR_STRUCT_SIZE);
      break;
    default:
      grown.value.struct_size = dice.of({0U, 4U, 1U << 20});
      expected.fails(WALR_ERROR_STRUCT_SIZE);
  }
}

}  // namespace walr::test
