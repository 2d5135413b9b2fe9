#pragma once

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"

namespace walr {

/// What a linter of specular light reads.
struct LintSpecularInputs {
  /// Of the light. `roughness`, `specularMotion` and the diffuse `albedo` may be missing.
  DenoiserInputs inputs;
  fg::Texture diffuse = {};  ///< Light of the diffuse lobe, a texel for every pixel; may be missing.
  bool distances = true;     ///< The light's alpha is a distance; if not, it only tells where there is a sample.
  bool ownAlbedo = true;     ///< The specular albedo is the one of walr/specular_albedo.h, not the renderer's own.
};

/// Add a pass that counts what is wrong in specular light; `InputLinter` turns counts into text.
///
/// Light that was not divided by its albedo is found from pairs of pixels on one surface whose specular albedo differs
/// (as `LintJudge::judgeAlbedo` does), so only where surfaces have textures of metal or of its colour. Without
/// roughness, which changes the light, too, pairs tell nothing. The encoding of roughness is found on dielectrics,
/// whose albedo depends on roughness in a known way (walr/specular_albedo.h). Lobes that were swapped are found on
/// metals, which reflect no diffuse light. Distances that are 1 on nearly all pixels are a mask, and those that are
/// short for their depth are in larger units. A mirror's pixel and its distance give a point. Where the picture shows
/// that place, it must show a surface there: else the point floats in the air, and the distance is another one. Where
/// the picture shows the point itself, its motion must be that surface's.
/// @param counters as `addLintInputs` returned them
/// @returns its new version
fg::Buffer addLintSpecular(fg::Graph& graph, const LintSpecularInputs& inputs, fg::Buffer counters);

}  // namespace walr
