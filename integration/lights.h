#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "framegraph/declare/graph.h"

/// The lights of a view, for instance indirect and direct light. They share depth, normals, motion and albedo. Each has
/// images of its own, which a method denoises.
namespace walr {

/// What names begin with that belong to one light.
struct LightNames {
  std::string_view images;    ///< Of the host's images.
  std::string_view passes;    ///< Of passes, textures and histories.
  std::string_view settings;  ///< Of settings and presets in the C API, and of views.
};

/// One line a light, in the order in which a host gives them. Another light is a line here, with members of
/// `WalrFrame` in integration/c_api/host_images.cpp.
inline constexpr std::array kLightNames{
    LightNames{},
    LightNames{.images = "second_", .passes = "second light: ", .settings = "second."},
};

/// The most lights that one graph denoises.
inline constexpr std::size_t kMostLights = kLightNames.size();

/// A name of a setting, a preset or a view, without the prefix of the light that it is about.
struct OwnName {
  std::optional<std::size_t> light;  ///< Nothing if it has no prefix of one of the lights.
  std::string_view name;
};

/// @param lights how many there are
inline OwnName withoutLight(std::string_view name, std::size_t lights) {
  for (std::size_t i = 1; i < lights; ++i) {
    const std::string_view prefix = kLightNames.at(i).settings;
    if (name.starts_with(prefix)) return {i, name.substr(prefix.size())};
  }
  return {std::nullopt, name};
}

/// Imports of a graph: the host's images of one light.
struct LightImages {
  fg::Texture lighting;
  fg::Texture confidence;  ///< Invalid if the host has none.
  fg::Texture output;
  fg::Texture historyLength;   ///< Invalid unless requested.
  fg::Texture lightDirection;  ///< Invalid unless requested.
  fg::Texture expectedError;   ///< Invalid unless requested.
};

}  // namespace walr
