#pragma once

#include <optional>

#include <nlohmann/json.hpp>

#include "samples/denoise/roughness_classes.h"

namespace walr {

/// An optional value as JSON; null if absent.
template <typename T>
nlohmann::ordered_json orNull(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

/// Adds figures by class of roughness to an object, unless all are absent, as those of diffuse light are.
inline void addByRoughness(nlohmann::ordered_json& object, const char* name, const FiguresByRoughness& figures) {
  if (!hasFigures(figures)) return;
  for (const std::optional<double>& figure : figures) object[name].push_back(orNull(figure));
}

}  // namespace walr
