#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/settings/settings.h"
#include "passes/stage/stage_graph.h"

namespace walr {

/// A whole denoising method with its settings.
class Denoiser : public Configurable {
 public:
  /// Names of the presets that `usePreset` takes; the first holds the defaults. Empty if the method has none.
  [[nodiscard]] virtual std::vector<std::string> presets() const = 0;
  /// Replace all settings.
  /// @throws std::invalid_argument naming the unknown preset and the known ones
  virtual void usePreset(std::string_view name) = 0;
  /// Whether the method prepares guides, which several lights can share (`SharedGuides`).
  [[nodiscard]] virtual bool sharesGuides() const = 0;
  [[nodiscard]] virtual bool takesSpecularLight() const = 0;
  /// @throws std::invalid_argument naming the methods that take such light, if this one does not
  virtual void requireLight(const InputConventions& conventions) const = 0;
  /// Add the method's passes to a graph.
  /// @param graph   the host's graph, with the views and counters that the caller wants, if any. For several lights
  ///                of a view: call `add` for each, with `SharedLight`s that have the same guides. The inputs differ
  ///                in `lighting` and `confidence` only
  /// @param inputs  the host's textures and scene description; settings may leave out more of the scene
  /// @param output  RGBA16F texture of the inputs' extent that the result is written to
  /// @returns the output's new version: the denoised light; sky and pixels without a
  ///          lobe of that light hold the input unchanged, or, where light is packed, rounded (`antialiasing.storage`)
  /// @throws std::invalid_argument naming a setting outside its range, or a view that does not exist, or the method
  ///         or setting that needs a sample of light at every pixel (`LightPattern`) where there is none, or that
  ///         does not take specular light, or saying that lights cannot share guides
  virtual fg::Texture add(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output) = 0;
  /// The views that `add` takes with the present settings.
  /// @throws std::invalid_argument naming a setting outside its range, or as `add` for these conventions
  [[nodiscard]] std::vector<ViewInfo> views(const InputConventions& conventions = {});
};

/// Names of all methods, as `--method` takes them.
std::vector<std::string> denoiserNames();

/// What a method is, in a line.
/// @throws std::invalid_argument naming the unknown method and the known ones
std::string_view denoiserDescription(std::string_view method);

/// Make a method with its default settings.
/// @throws std::invalid_argument naming the unknown method and the known ones
std::unique_ptr<Denoiser> makeDenoiser(std::string_view method);

}  // namespace walr
