#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <walr/walr_passes.h>

#include "tests/integration/call_check.h"
#include "tests/integration/random_device.h"
#include "tests/integration/random_structs.h"

namespace walr::test {

inline constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Words of which the text of an error about a WalrDenoiserInfo holds one.
inline const std::vector<std::string_view> kInfoNames = {
    "WalrDenoiserInfo", "WalrDevice",  "WalrMemory",      "WalrConventions",      "WalrDenoiser",
    "method",           "preset",      "setting",         "image size",           "input",
    "orthographic",     "queue famil", "created without", "the result's address", "regression",
    "specular light",   "svgf."};

/// All that a WalrDenoiserInfo points to.
class RandomInfo {
 public:
  /// @param types those whose names are valid
  /// @param host  without a device the info is valid only for passes
  RandomInfo(Dice& dice, Expectation& expected, const std::vector<const WalrPassType*>& types, const RandomHost& host);
  RandomInfo(const RandomInfo&) = delete;
  RandomInfo& operator=(const RandomInfo&) = delete;

  [[nodiscard]] const WalrDenoiserInfo* get() const { return &info_.value; }
  /// Null if the name is wrong.
  [[nodiscard]] const WalrPassType* type() const { return type_; }
  [[nodiscard]] std::vector<WalrLightKind> lights() const;
  [[nodiscard]] bool rectangle() const { return info_.value.conventions != nullptr && conventions_.value.rectangle; }
  [[nodiscard]] bool orthographic() const {
    return info_.value.conventions != nullptr && conventions_.value.orthographic;
  }
  [[nodiscard]] bool allocates() const {
    return info_.value.device != nullptr && info_.value.device->device_memory != nullptr;
  }
  /// The library reads its members.
  [[nodiscard]] bool hasRightSize() const { return info_.value.struct_size == sizeof(WalrDenoiserInfo); }
  /// States another denoiser, for walr_create_denoiser.
  void shareWith(WalrDenoiser other) { info_.value.shared_with = other; }

 private:
  void chooseMethod(Dice& dice, Expectation& expected, const std::vector<const WalrPassType*>& types);
  void chooseImages(Dice& dice, Expectation& expected);
  void chooseConventions(Dice& dice, Expectation& expected);
  void chooseOutputs(Dice& dice, Expectation& expected);
  void chooseLights(Dice& dice, Expectation& expected);
  void chooseKinds(Dice& dice, Expectation& expected);
  [[nodiscard]] bool ofTwoKinds() const { return info_.value.light_kind != info_.value.second_light_kind; }
  void chooseDevice(Dice& dice, Expectation& expected, const RandomHost& host);

  const WalrPassType* type_ = nullptr;
  Grown<WalrDenoiserInfo> info_;
  Grown<WalrConventions> conventions_;
  std::optional<RandomDevice> device_;
};

/// A width or height.
std::uint32_t randomLength(Dice& dice, Expectation& expected);

/// A name and a value for a setting of a pass type, mostly right ones. The name may be null, and the value too.
/// @param type null: no name is right
WalrSettingValue randomSetting(Dice& dice, Expectation& expected, const WalrPassType* type, std::string& storage);

/// Whether a setting of a method acts on one of these lights; also if there is no such setting, and for stages.
bool actsOn(const WalrPassType* type, const char* setting, std::span<const WalrLightKind> lights);

/// A camera, or null.
const WalrCamera* randomCamera(Dice& dice, Expectation& expected, bool orthographic, WalrCamera& storage);

/// What WalrFrame and WalrPassFrame have in common, mostly rightly. Both have members of the same names.
template <typename Frame>
void chooseFrame(Dice& dice, Expectation& expected, Frame& frame) {
  constexpr double kFarthest = 536870912.0;
  frame.sky_depth = dice.of({0.0F, 100.0F, 1e9F});
  frame.pre_exposure = dice.of({0.0F, 1.0F, 0.5F});
  frame.frame_index = dice.of({0U, 7U, 0xffffffffU});
  for (double* const origin : {frame.origin, frame.previous_origin}) {
    if (dice.oneIn(4)) origin[dice.below(3)] = dice.of({-1.0, 1e6, kFarthest});
  }
  if (!dice.oneIn(16)) return;
  expected.fails();
  switch (dice.below(5)) {
    case 0:
      frame.flags = dice.of({0x80U, 0xffffffffU});
      break;
    case 1:
      frame.sky_depth = dice.of({-1.0F, kNotANumber});
      break;
    case 2:
      frame.pre_exposure = dice.of({-1.0F, kNotANumber, kInfinity});
      break;
    case 3:
      frame.origin[dice.below(3)] = dice.of({2.0 * kFarthest, double(kInfinity), double(kNotANumber)});
      break;
    default:
      frame.offset[dice.below(2)] = dice.of({16385U, 0xffffffffU});
  }
}

}  // namespace walr::test
