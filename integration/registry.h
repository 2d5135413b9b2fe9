#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "framegraph/declare/graph.h"
#include "integration/ports.h"
#include "integration/setting_info.h"
#include "passes/conventions/inputs.h"

/// Pass types by name. A host's graph editor or scripting layer can list, create, connect and configure them. Ports,
/// formats and accesses are not listed by hand: each type declares its passes in a scratch graph, and they are read
/// from that. No device is needed.
namespace walr {

/// An instance of a pass type with its own settings.
class PassNode : public Configurable {
 public:
  /// The ports with the current settings.
  [[nodiscard]] virtual std::vector<Port> ports() = 0;
  /// Names of the passes that `add` declares with the current settings and connections, in the order of declaration.
  [[nodiscard]] virtual std::vector<std::string> passNames() = 0;
  /// Names of the presets that `usePreset` takes. Empty where there are none.
  [[nodiscard]] virtual std::vector<std::string> presets() const = 0;
  /// @throws std::invalid_argument naming the unknown preset and the known ones
  virtual void usePreset(std::string_view name) = 0;

  /// Connect a port.
  /// @throws std::invalid_argument naming the unknown port and the known ones
  void connect(std::string_view port, fg::Texture texture);
  void connect(std::string_view port, fg::Buffer buffer);

  /// How the host's textures differ from the project's conventions.
  void setConventions(const InputConventions& conventions) { conventions_ = conventions; }

  /// Declare the passes.
  /// @returns the outputs, at their new versions
  /// @throws std::invalid_argument naming an input that is not connected or not of the port's format, or a setting that
  ///         is out of range
  virtual Connections add(fg::Graph& graph) = 0;

 protected:
  Connections connections_;
  InputConventions conventions_;

 private:
  [[nodiscard]] const Port& requirePort(const std::vector<Port>& all, std::string_view name, bool buffer) const;
};

/// Properties of a pass type.
struct PassType {
  std::string name;
  std::string description;
  bool composition = false;  ///< A whole denoising method.
  std::vector<Port> ports;   ///< With default settings.
  std::vector<SettingDescription> settings;
  std::vector<std::string> presets;
  std::vector<std::string> passes;  ///< Passes that it declares with default settings and no optional input.
};

/// All pass types, stages first. Created on the first call; thread-safe.
const std::vector<PassType>& passTypes();

/// @throws std::invalid_argument naming the unknown type and the known ones
std::unique_ptr<PassNode> makePass(std::string_view type);

/// A text that lists all pass types with ports, settings and passes.
std::string passListing();

}  // namespace walr
