#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "samples/bench/variant.h"

namespace walr {

/// One point of a sweep: a label and its settings.
struct SweepPoint {
  std::string_view label;
  std::vector<SettingValue> settings;
};

/// A question about a method's settings, and the values to measure for it. Its variants are named "SWEEP=LABEL".
struct Sweep {
  std::string_view name;
  std::string_view question;
  std::string_view method;
  std::string_view preset;         ///< Preset that the settings change; empty: the method's first.
  std::vector<SettingValue> held;  ///< Settings that all points share, including the default.
  std::vector<SweepPoint> points;  ///< One of them is the default.
};

/// All sweeps.
std::span<const Sweep> sweeps();

/// The variants of a sweep.
/// @throws std::invalid_argument if there is no such sweep; the message lists all sweeps
std::vector<Variant> sweepVariants(std::string_view name);

/// Whether all settings of a variant have the values of its method and preset. Settings that a sweep fixes for all its
/// variants are not compared.
/// @throws std::invalid_argument as `makeVariant`
bool isDefault(const Variant& variant);

}  // namespace walr
