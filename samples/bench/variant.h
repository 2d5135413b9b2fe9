#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "passes/methods/denoiser.h"

namespace walr {

/// Name and value of a setting, as for `Configurable::set`.
using SettingValue = std::pair<std::string, std::string>;

/// A method with settings, under a name: one row of the report's tables.
struct Variant {
  std::string name;  ///< Letters, digits and . : - _ only, because it is part of file names.
  std::string method;
  std::string preset;                  ///< Empty: the method's first.
  std::vector<SettingValue> settings;  ///< Changes to the preset.

  friend bool operator==(const Variant&, const Variant&) = default;
};

/// The variant that all time ratios refer to: `walr` with its defaults.
inline constexpr std::string_view kBaseline = "walr";

/// Every method with each of its presets: "walr", "walr_paper", "walr_paper:robust", "bmfr", ...
std::vector<Variant> allMethods();

/// Parse a list of METHOD or METHOD:PRESET, separated by commas, or "all".
/// @throws std::invalid_argument naming the unknown method or preset
std::vector<Variant> parseMethods(const std::string& list);

/// Parse "NAME=METHOD[:PRESET][,SETTING=VALUE]...": a method and settings under a chosen name.
/// @param lights that are denoised
/// @throws std::invalid_argument naming the fault, which may be a setting without effect on these lights
Variant parseVariant(const std::string& text, LightKinds lights = kDiffuseLight);

/// Create the method with the variant's settings.
/// @throws std::invalid_argument naming the unknown method, preset or setting
std::unique_ptr<Denoiser> makeVariant(const Variant& variant);

/// All settings of a variant with their values.
/// @throws std::invalid_argument as `makeVariant`
std::vector<SettingValue> settingsOf(const Variant& variant);

/// @throws std::invalid_argument if two variants have the same name
void requireDistinctNames(const std::vector<Variant>& variants);

/// Move the baseline to the front; add it if it is missing.
/// @throws std::invalid_argument if two variants have the same name
std::vector<Variant> withBaseline(std::vector<Variant> variants);

}  // namespace walr
