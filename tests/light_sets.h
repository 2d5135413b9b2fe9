#pragma once

#include <string>
#include <vector>

#include "integration/denoise_graph.h"
#include "passes/methods/denoiser.h"

/// The lights that one graph denoises, for records of all methods.
namespace walr::test {

struct LightSet {
  bool diffuse = true;
  bool specular = false;

  /// What follows a method's name; nothing of diffuse light alone.
  [[nodiscard]] std::string suffix(char separator) const {
    if (!specular) return {};
    return separator + std::string(diffuse ? "both" : "specular");
  }
  [[nodiscard]] std::vector<DenoisedLight> denoisedBy(Denoiser& method) const {
    std::vector<DenoisedLight> lights;
    if (diffuse) lights.push_back({&method, false});
    if (specular) lights.push_back({&method, true});
    return lights;
  }
};

inline constexpr LightSet kDiffuse{};
inline constexpr LightSet kSpecular{.diffuse = false, .specular = true};
inline constexpr LightSet kBoth{.diffuse = true, .specular = true};

/// Those that a method takes. `none` does the same to each.
inline std::vector<LightSet> lightSetsOf(const Denoiser& method) {
  if (!method.takesSpecularLight() || !method.sharesGuides()) return {kDiffuse};
  return {kDiffuse, kSpecular, kBoth};
}

}  // namespace walr::test
