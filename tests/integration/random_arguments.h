#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <walr/walr_passes.h>

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
  if (!dice.oneIn(12)) return;
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

/// All that a WalrDenoiserInfo points to.
class RandomInfo {
 public:
  /// @param types those whose names are valid
  /// @param device null: valid only for passes
  RandomInfo(Dice& dice, Expectation& expected, const std::vector<const WalrPassType*>& types,
             const WalrDevice* device);
  RandomInfo(const RandomInfo&) = delete;
  RandomInfo& operator=(const RandomInfo&) = delete;

  [[nodiscard]] const WalrDenoiserInfo* get() const { return &info_.value; }
  /// Null if the name is wrong.
  [[nodiscard]] const WalrPassType* type() const { return type_; }
  [[nodiscard]] bool rectangle() const { return info_.value.conventions != nullptr && conventions_.value.rectangle; }

 private:
  void chooseMethod(Dice& dice, Expectation& expected, const std::vector<const WalrPassType*>& types);
  void chooseImages(Dice& dice, Expectation& expected);
  void chooseConventions(Dice& dice, Expectation& expected);
  void chooseDevice(Dice& dice, Expectation& expected, const WalrDevice* device);

  const WalrPassType* type_ = nullptr;
  Grown<WalrDenoiserInfo> info_;
  Grown<WalrConventions> conventions_;
  Grown<WalrDevice> device_;
};

/// A width or height.
std::uint32_t randomLength(Dice& dice, Expectation& expected);

/// A name and a value for a setting of a pass type, mostly right ones. The name may be null, and the value too.
/// @param type null: no name is right
WalrSettingValue randomSetting(Dice& dice, Expectation& expected, const WalrPassType* type, std::string& storage);

/// A camera, or null.
const WalrCamera* randomCamera(Dice& dice, Expectation& expected, WalrCamera& storage);

}  // namespace walr::test
