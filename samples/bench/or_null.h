#pragma once

#include <optional>

#include <nlohmann/json.hpp>

namespace walr {

/// An optional value as JSON; null if absent.
template <typename T>
nlohmann::ordered_json orNull(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

}  // namespace walr
