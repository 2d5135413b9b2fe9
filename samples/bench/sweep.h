#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "samples/bench/variant.h"

namespace walr {

/// One value on a sweep.
struct SweepPoint {
  std::string_view label;
  std::vector<SettingValue> settings;
};

/// A question about a method's settings, and the settings that answer it. Its variants are named "SWEEP=LABEL".
struct Sweep {
  std::string_view name;
  std::string_view question;
  std::string_view method;
  std::string_view preset;         ///< That the settings are changes to; empty: the default.
  std::vector<SettingValue> held;  ///< Further settings that all points share, and with them the default.
  std::vector<SweepPoint> points;  ///< The default is one of them.
};

/// All sweeps. A new one is a line here.
std::span<const Sweep> sweeps();

/// The variants of a sweep.
/// @throws std::invalid_argument naming the unknown sweep and the known ones
std::vector<Variant> sweepVariants(std::string_view name);

/// Whether a variant is its method with its preset and nothing else, whatever it is called; for a variant of a sweep,
/// besides what the sweep holds.
/// @throws std::invalid_argument as `makeVariant`
bool isDefault(const Variant& variant);

}  // namespace walr
