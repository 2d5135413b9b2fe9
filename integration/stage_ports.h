#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "integration/ports.h"
#include "passes/inputs.h"
#include "passes/prepare_guides.h"

namespace walr {

/// What is known of the port of a name before a stage that reads it is recorded.
struct KnownPort {
  std::variant<fg::TextureDesc, fg::BufferDesc> desc;
  std::vector<VkFormat> otherFormats = {};  ///< See `Port::otherFormats`.
  std::string_view description = {};        ///< See `Port::description`.
};
using KnownPorts = std::map<std::string, KnownPort, std::less<>>;

/// What a stage sees of its ports while it declares its passes.
class StagePorts {
 public:
  /// @param instance prefixed to the names of the textures that are made for outputs left unconnected
  StagePorts(fg::Graph& graph, Connections connections, const InputConventions& conventions, std::string instance)
      : graph_(&graph),
        connections_(std::move(connections)),
        conventions_(conventions),
        instance_(std::move(instance)) {}
  virtual ~StagePorts() = default;

  [[nodiscard]] fg::Graph& graph() { return *graph_; }
  /// An input; an invalid handle where nothing is connected.
  virtual fg::Texture texture(std::string_view port);
  /// The same of an input whose format the settings decide.
  virtual fg::Texture texture(std::string_view port, VkFormat format);
  virtual fg::Buffer buffer(std::string_view port);
  /// A texture to write an output to: what is connected, or a transient like the texture given.
  virtual fg::Texture target(std::string_view port, VkFormat format, fg::Extent extent);
  void setOutput(std::string_view port, fg::Texture texture) {
    outputs_.textures.insert_or_assign(std::string(port), texture);
  }

  /// The ports of `DenoiserInputs`.
  DenoiserInputs hostInputs();
  /// The ports that the stages "prepare_guides" and "prepare_guides_with_occlusion" make.
  Guides guides();
  void setOutputs(const Guides& guides);

  [[nodiscard]] Connections takeOutputs() { return std::move(outputs_); }

 private:
  fg::Graph* graph_;
  Connections connections_;
  InputConventions conventions_;
  std::string instance_;
  Connections outputs_;
};

/// Ports that are recorded instead of connected: every input is an import of its own.
class RecordingPorts final : public StagePorts {
 public:
  /// @param present whether the host has what `HostInput::optional` says that it need not have
  RecordingPorts(fg::Graph& scratch, const InputConventions& conventions, const KnownPorts& known,
                 std::function<bool(std::string_view port)> present)
      : StagePorts(scratch, {}, conventions, {}), known_(&known), present_(std::move(present)) {}

  fg::Texture texture(std::string_view port) override;
  fg::Texture texture(std::string_view port, VkFormat format) override;
  fg::Buffer buffer(std::string_view port) override;
  fg::Texture target(std::string_view port, VkFormat format, fg::Extent extent) override;

  /// What was recorded: inputs in the order in which they were asked for, then outputs by name.
  /// @param unread whether inputs that nothing reads count
  std::vector<Port> takePorts(bool unread);

 private:
  struct Asked {
    std::string port;
    fg::ResourceVersion resource;
    bool anyFormat = false;  ///< Else the settings decide its format.
  };
  /// @param format of a texture; VK_FORMAT_UNDEFINED: as it is known
  fg::ResourceVersion ask(std::string_view port, VkFormat format = VK_FORMAT_UNDEFINED);

  const KnownPorts* known_;
  std::function<bool(std::string_view port)> present_;
  std::vector<Asked> asked_;
};

}  // namespace walr
