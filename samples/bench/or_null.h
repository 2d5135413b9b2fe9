#pragma once

#include <optional>

#include <nlohmann/json.hpp>

namespace walr {

/// A value as JSON, null where there is none.
template <typename T>
nlohmann::ordered_json orNull(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

}  // namespace walr
