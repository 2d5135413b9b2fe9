#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "integration/ports.h"
#include "passes/conventions/inputs.h"
#include "passes/guides/prepare_guides.h"

namespace walr {

/// Image size in scratch graphs, with which ports are recorded. Methods may choose passes by the size. It is a multiple
/// of all tiles (`Port::tile`).
inline constexpr fg::Extent kListedExtent{1920, 1080};

/// Properties of a port that are known before a stage that reads it is recorded.
struct KnownPort {
  std::variant<fg::TextureDesc, fg::BufferDesc> desc;
  std::string_view description = {};  ///< See `Port::description`.
};
using KnownPorts = std::map<std::string, KnownPort, std::less<>>;

/// Access to a stage's ports while it declares its passes.
class StagePorts {
 public:
  /// @param instance prefix for the names of textures that are created for unconnected outputs
  StagePorts(fg::Graph& graph, Connections connections, const InputConventions& conventions, std::string instance)
      : graph_(&graph),
        connections_(std::move(connections)),
        conventions_(conventions),
        instance_(std::move(instance)) {}
  virtual ~StagePorts() = default;

  [[nodiscard]] fg::Graph& graph() { return *graph_; }
  /// The texture of an input; an invalid handle if nothing is connected.
  virtual fg::Texture texture(std::string_view port);
  /// The same for an input whose format depends on the settings.
  virtual fg::Texture texture(std::string_view port, VkFormat format);
  /// The same for an input that may be left unconnected.
  /// @param description tells hosts when (`Port::description`); not empty
  virtual fg::Texture optionalTexture(std::string_view port, std::string_view description);
  virtual fg::Buffer buffer(std::string_view port);
  /// The texture to write an output to: the connected one, or a transient of the given format and size.
  virtual fg::Texture target(std::string_view port, VkFormat format, fg::Extent extent);
  void setOutput(std::string_view port, fg::Texture texture) {
    outputs_.textures.insert_or_assign(std::string(port), texture);
  }

  /// The textures of the ports of `DenoiserInputs`.
  DenoiserInputs hostInputs();
  /// The textures of the ports that the stages "prepare_guides" and "prepare_guides_with_occlusion" output.
  /// @param normalsBesideDepth whether the stage also takes guides whose depth holds the geometric normals
  Guides guides(bool normalsBesideDepth = false);
  void setOutputs(const Guides& guides);

  [[nodiscard]] Connections takeOutputs() { return std::move(outputs_); }

 private:
  fg::Graph* graph_;
  Connections connections_;
  InputConventions conventions_;
  std::string instance_;
  Connections outputs_;
};

/// Records which ports a stage uses. Every input is a separate import.
class RecordingPorts final : public StagePorts {
 public:
  /// @param present whether the host has an optional input (`HostInput::optional`)
  RecordingPorts(fg::Graph& scratch, const InputConventions& conventions, const KnownPorts& known,
                 std::function<bool(std::string_view port)> present)
      : StagePorts(scratch, {}, conventions, {}), known_(&known), present_(std::move(present)) {}

  fg::Texture texture(std::string_view port) override;
  fg::Texture texture(std::string_view port, VkFormat format) override;
  fg::Texture optionalTexture(std::string_view port, std::string_view description) override;
  fg::Buffer buffer(std::string_view port) override;
  fg::Texture target(std::string_view port, VkFormat format, fg::Extent extent) override;

  /// The recorded ports: inputs in the order in which the stage used them, then outputs by name.
  /// @param unread whether to include inputs that no pass reads
  std::vector<Port> takePorts(bool unread);

 private:
  struct Asked {
    std::string port;
    fg::ResourceVersion resource;
    std::string_view optional = {};  ///< Description of an optional input; empty: it must be connected.
  };
  /// @param format of a texture; VK_FORMAT_UNDEFINED: that in `known_`
  fg::ResourceVersion ask(std::string_view port, VkFormat format = VK_FORMAT_UNDEFINED, std::string_view optional = {});

  const KnownPorts* known_;
  std::function<bool(std::string_view port)> present_;
  std::vector<Asked> asked_;
};

}  // namespace walr
