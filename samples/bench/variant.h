#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "passes/denoiser.h"

namespace walr {

/// Name and value of a setting, as `Configurable::set` takes them.
using SettingValue = std::pair<std::string, std::string>;

/// A method with its settings under a name: one line of the report.
struct Variant {
  std::string name;  ///< Letters, digits and . : = - _ only; it is part of file names.
  std::string method;
  std::string preset;                  ///< Empty: the method's first.
  std::vector<SettingValue> settings;  ///< On top of the preset.
  std::string sweep;                   ///< The sweep it belongs to; empty for the methods.

  friend bool operator==(const Variant&, const Variant&) = default;
};

/// The variant against which all times are given: WALR with its defaults.
inline constexpr std::string_view kBaseline = "walr";

/// Every method with each of its presets: "walr", "walr_paper", "walr_paper:robust", "bmfr", ...
std::vector<Variant> allMethods();

/// A list of METHOD or METHOD:PRESET, parted by commas, or "all".
/// @throws std::invalid_argument naming the unknown method or preset
std::vector<Variant> parseMethods(const std::string& list);

/// "NAME=METHOD[:PRESET][,SETTING=VALUE]...": settings under a name of one's own.
/// @throws std::invalid_argument naming what is wrong with it
Variant parseVariant(const std::string& text);

/// Make the method with the variant's settings.
/// @throws std::invalid_argument naming the unknown method, preset or setting
std::unique_ptr<Denoiser> makeVariant(const Variant& variant);

/// All settings of a variant with their values.
/// @throws std::invalid_argument as `makeVariant`
std::vector<SettingValue> settingsOf(const Variant& variant);

/// Put the baseline first, adding it where it is missing.
/// @throws std::invalid_argument naming a name that stands for two things
std::vector<Variant> withBaseline(std::vector<Variant> variants);

}  // namespace walr
