#include "integration/registry.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "framegraph/declare/access.h"
#include "framegraph/declare/format.h"
#include "integration/host_inputs.h"
#include "integration/stages.h"
#include "passes/settings/text.h"
#include "passes/stage/grid_extent.h"
#include "shaders/conventions/frame.h"

namespace walr {
namespace {

/// A texture in scratch graphs.
/// @param tile `Port::tile`
fg::TextureDesc listedTexture(VkFormat format, std::uint32_t tile) {
  return {.format = format, .extent = gridExtent(kListedExtent, tile)};
}

KnownPorts hostPorts() {
  KnownPorts known;
  for (const HostInput& input : kHostInputs) {
    known.emplace(input.name, KnownPort{.desc = listedTexture(input.format, 1), .description = input.description});
  }
  known.emplace(kFrameName, KnownPort{.desc = fg::BufferDesc{sizeof(FrameConstants)}});
  return known;
}

/// The ports of a stage if the host has all optional inputs.
/// @param composition whether it is a whole method, which has all of the host's textures as ports, read or not
std::vector<Port> portsOf(Stage& stage, bool composition, const InputConventions& conventions,
                          const KnownPorts& known) {
  fg::Graph scratch;
  RecordingPorts ports(scratch, conventions, known, [](std::string_view /*port*/) { return true; });
  stage.declare(ports);
  return ports.takePorts(composition);
}

/// The passes that a stage declares if the host has those optional inputs that `connections` hold.
std::vector<std::string> passesOf(Stage& stage, const InputConventions& conventions, const KnownPorts& known,
                                  const Connections& connections) {
  fg::Graph scratch;
  RecordingPorts ports(scratch, conventions, known,
                       [&](std::string_view port) { return connections.textures.contains(port); });
  stage.declare(ports);
  std::vector<std::string> names;
  for (const fg::PassDecl& pass : scratch.desc().passes) names.push_back(pass.name);
  return names;
}

/// All types with their ports. The ports of a type can be recorded only after those of all earlier types.
struct Catalogue {
  Catalogue() : known(hostPorts()) {
    for (const StageType& type : stageTypes()) {
      for (const SettingsOutput& output : type.settingsOutputs) {
        known.emplace(output.name,
                      KnownPort{.desc = listedTexture(output.format, output.tile), .description = output.description});
      }
      const std::unique_ptr<Stage> stage = type.make(type.name);
      std::vector<Port> ports = portsOf(*stage, type.composition, {}, known);
      for (const Port& port : ports) {
        if (port.output) learn(port);
      }
      types.push_back({.name = type.name,
                       .description = type.description,
                       .composition = type.composition,
                       .ports = std::move(ports),
                       .settings = describeSettings(*stage),
                       .presets = stage->presets(),
                       .passes = passesOf(*stage, {}, known, {})});
    }
  }
  /// Make an output known to later types.
  void learn(const Port& output) {
    known.emplace(output.name, KnownPort{.desc = listedTexture(output.format, output.tile)});
  }

  KnownPorts known;
  std::vector<PassType> types;
};

const Catalogue& catalogue() {
  static const Catalogue kCatalogue;
  return kCatalogue;
}

std::string formatName(VkFormat format) {
  return std::string(fg::formatInfo(format).name);
}

class StageNode final : public PassNode {
 public:
  explicit StageNode(const StageType& type)
      : name_(type.name), composition_(type.composition), stage_(type.make(type.name)) {}

  void visitSettings(SettingVisitor& visitor) override { stage_->visitSettings(visitor); }
  [[nodiscard]] std::vector<Port> ports() override {
    return portsOf(*stage_, composition_, conventions_, catalogue().known);
  }
  [[nodiscard]] std::vector<std::string> passNames() override {
    return passesOf(*stage_, conventions_, catalogue().known, connections_);
  }
  [[nodiscard]] std::vector<std::string> presets() const override { return stage_->presets(); }
  void usePreset(std::string_view name) override { stage_->usePreset(name); }

  Connections add(fg::Graph& graph) override {
    for (const Port& port : ports()) requireConnection(graph, port);
    StagePorts stagePorts(graph, connections_, conventions_, name_);
    stage_->declare(stagePorts);
    return stagePorts.takeOutputs();
  }

 private:
  void requireConnection(const fg::Graph& graph, const Port& port) const {
    if (port.buffer) {
      if (!port.optional && !connections_.buffers.contains(port.name)) rejectUnconnected(port);
      return;
    }
    const auto connected = connections_.textures.find(port.name);
    if (connected == connections_.textures.end()) {
      if (!port.optional) rejectUnconnected(port);
      return;
    }
    const VkFormat format = graph.textureDesc(connected->second).format;
    const HostInput* input = hostInputNamed(port.name);
    if (!port.output && input != nullptr) {
      if (input->texture != &DenoiserInputs::lighting) return requireInputFormat(*input, format);
      return requireLightFormat(*input, format, conventions_.light, conventions_.specular);
    }
    if (format == port.format) return;
    throw std::invalid_argument("port '" + port.name + "' of pass '" + name_ + "' takes " + formatName(port.format) +
                                ", but " + formatName(format) + " is connected");
  }
  [[noreturn]] void rejectUnconnected(const Port& port) const {
    throw std::invalid_argument("nothing is connected to port '" + port.name + "' of pass '" + name_ + "'" +
                                (port.description.empty() ? "" : ": " + port.description));
  }

  std::string name_;
  bool composition_;
  std::unique_ptr<Stage> stage_;
};

void listPort(std::ostream& out, const Port& port) {
  out << "    " << (port.output ? "out " : "in  ") << port.name << ": ";
  if (port.buffer) {
    out << port.size << " bytes";
  } else {
    out << formatName(port.format);
    if (port.tile > 1) out << ", a texel for each " << port.tile << " x " << port.tile << " pixels";
  }
  std::vector<std::string_view> accesses;
  for (const fg::Access access : port.accesses) accesses.push_back(fg::accessInfo(access).name);
  if (!accesses.empty()) out << ", " << join(accesses);
  if (port.optional && !port.output) out << ", optional";
  if (!port.description.empty()) out << "\n        " << port.description;
  out << '\n';
}

void listSetting(std::ostream& out, const SettingDescription& setting) {
  out << "    set " << setting.name << " = " << setting.value << "  (";
  if (setting.choices.empty()) {
    out << setting.least << ".." << setting.most;
  } else {
    out << join(setting.choices);
  }
  out << (setting.unit.empty() ? "" : " " + setting.unit) << ")\n        " << setting.description << '\n';
}

}  // namespace

const Port& PassNode::requirePort(const std::vector<Port>& all, std::string_view name, bool buffer) const {
  const auto found = std::ranges::find(all, name, &Port::name);
  if (found == all.end()) {
    std::vector<std::string> names;
    for (const Port& port : all) names.push_back(port.name);
    throw std::invalid_argument("there is no port \"" + std::string(name) + "\"; known ports: " + join(names));
  }
  if (found->buffer == buffer) return *found;
  throw std::invalid_argument("port '" + found->name + "' takes a " + (found->buffer ? "buffer" : "texture"));
}

void PassNode::connect(std::string_view port, fg::Texture texture) {
  connections_.textures.insert_or_assign(requirePort(ports(), port, false).name, texture);
}

void PassNode::connect(std::string_view port, fg::Buffer buffer) {
  connections_.buffers.insert_or_assign(requirePort(ports(), port, true).name, buffer);
}

const std::vector<PassType>& passTypes() {
  return catalogue().types;
}

std::unique_ptr<PassNode> makePass(std::string_view type) {
  const std::vector<StageType>& types = stageTypes();
  const auto found = std::ranges::find(types, type, &StageType::name);
  if (found != types.end()) return std::make_unique<StageNode>(*found);
  std::vector<std::string> names;
  for (const StageType& known : types) names.push_back(known.name);
  throw std::invalid_argument("there is no pass type \"" + std::string(type) + "\"; known types: " + join(names));
}

std::string passListing() {
  std::ostringstream out;
  for (const PassType& type : passTypes()) {
    out << type.name << (type.composition ? " (a whole method)" : "") << ": " << type.description << '\n';
    for (const Port& port : type.ports) listPort(out, port);
    for (const SettingDescription& setting : type.settings) listSetting(out, setting);
    if (!type.presets.empty()) out << "    presets: " << join(type.presets) << '\n';
    out << "    passes: " << join(type.passes) << "\n\n";
  }
  return out.str();
}

}  // namespace walr
