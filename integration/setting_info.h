#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "passes/settings/settings.h"

namespace walr {

enum class SettingKind : std::uint32_t {
  Number,   ///< Any number within the range.
  Integer,  ///< A whole number within the range.
  Switch,   ///< "on" or "off".
  Choice,   ///< One of the names of `choices`.
};

/// A setting, described for a user interface.
struct SettingDescription {
  std::string name;
  SettingKind kind = SettingKind::Number;
  std::string value;                 ///< Current value, as text for `Configurable::set`.
  double least = 0.0;                ///< Numbers and integers.
  double most = 0.0;                 ///< Numbers and integers.
  std::vector<std::string> choices;  ///< Switches and choices: every value.
  std::string unit;                  ///< Empty for a pure number.
  std::string description;           ///< One line.
  std::string source;                ///< Paper and section, or "measured".
  LightKinds lights;                 ///< That it acts on.
};

/// All settings in order, with their current values.
std::vector<SettingDescription> describeSettings(Configurable& configurable);

}  // namespace walr
