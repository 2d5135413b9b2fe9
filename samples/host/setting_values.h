#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "passes/settings/settings.h"

namespace walr::host {

/// The values of all settings of a method, to go back to them later.
class SettingValues {
 public:
  explicit SettingValues(Configurable& method);
  /// @param method  that of the constructor, or another of the same kind
  void restore(Configurable& method) const;
  friend bool operator==(const SettingValues&, const SettingValues&) = default;

 private:
  using Value = std::variant<float, std::uint32_t, bool>;

  std::vector<Value> values_;  // In the order in which the method visits its settings.
};

}  // namespace walr::host
