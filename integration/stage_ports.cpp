#include "integration/stage_ports.h"

#include <algorithm>
#include <stdexcept>

#include "framegraph/declare/access.h"
#include "integration/host_inputs.h"

namespace walr {
namespace {

/// Any state will do for the imports of the scratch graph: it is never compiled.
constexpr fg::ExternalState kAnyState{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                      VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};

/// Ports of geometric normals. "prepare_guides_with_occlusion" writes them to its depth and has no such ports.
constexpr std::string_view kGeometricNormal = "guides.geometric-normal";
constexpr std::string_view kPreviousGeometricNormal = "guides.previous-geometric-normal";
constexpr std::string_view kNormalsBesideDepth =
    "from prepare_guides; leave it unconnected if the depth comes from prepare_guides_with_occlusion, which holds it";

template <typename Handle>
Handle find(const std::map<std::string, Handle, std::less<>>& connections, std::string_view port) {
  const auto found = connections.find(port);
  return found == connections.end() ? Handle{} : found->second;
}

/// Describe a port by the accesses of the recorded passes to its resource.
Port describe(const fg::GraphDesc& graph, const KnownPorts& known, std::string name, std::uint32_t resource) {
  Port port;
  port.name = std::move(name);
  if (const auto found = known.find(port.name); found != known.end()) port.description = found->second.description;
  const auto& desc = graph.resources[resource].desc;
  if (const auto* texture = std::get_if<fg::TextureDesc>(&desc)) {
    port.format = texture->format;
    port.tile = kListedExtent.width / texture->extent.width;
  }
  if (const auto* buffer = std::get_if<fg::BufferDesc>(&desc)) {
    port.buffer = true;
    port.size = buffer->size;
  }
  for (const fg::PassDecl& pass : graph.passes) {
    for (const fg::AccessDecl& access : pass.accesses) {
      if (access.resource != resource) continue;
      if (std::ranges::find(port.accesses, access.access) == port.accesses.end()) {
        port.accesses.push_back(access.access);
      }
      const fg::AccessInfo& info = fg::accessInfo(access.access);
      if (port.buffer) {
        port.bufferUsage |= info.bufferUsage;
      } else {
        port.imageUsage |= info.imageUsage;
      }
    }
  }
  return port;
}

}  // namespace

fg::Texture StagePorts::texture(std::string_view port) {
  return find(connections_.textures, port);
}

fg::Texture StagePorts::texture(std::string_view port, VkFormat /*format*/) {
  return texture(port);
}

fg::Texture StagePorts::optionalTexture(std::string_view port, std::string_view /*description*/) {
  return texture(port);
}

fg::Buffer StagePorts::buffer(std::string_view port) {
  return find(connections_.buffers, port);
}

fg::Texture StagePorts::target(std::string_view port, VkFormat format, fg::Extent extent) {
  const fg::Texture connected = find(connections_.textures, port);
  return connected.valid() ? connected : graph_->texture(instance_ + "." + std::string(port), {format, extent});
}

DenoiserInputs StagePorts::hostInputs() {
  DenoiserInputs inputs;
  for (const HostInput& input : kHostInputs) inputs.*input.texture = texture(input.name);
  inputs.frame = buffer(kFrameName);
  inputs.conventions = conventions_;
  return inputs;
}

Guides StagePorts::guides(bool normalsBesideDepth) {
  const auto normals = [&](std::string_view port) {
    return normalsBesideDepth ? optionalTexture(port, kNormalsBesideDepth) : texture(port);
  };
  return {.depth = texture("guides.depth"),
          .shadingNormal = texture("guides.shading-normal"),
          .features = texture("guides.features"),
          .geometricNormal = normals(kGeometricNormal),
          .previousDepth = texture("guides.previous-depth"),
          .previousGeometricNormal = normals(kPreviousGeometricNormal)};
}

void StagePorts::setOutputs(const Guides& guides) {
  setOutput("guides.depth", guides.depth);
  if (guides.shadingNormal.valid()) setOutput("guides.shading-normal", guides.shadingNormal);
  if (guides.features.valid()) setOutput("guides.features", guides.features);
  setOutput("guides.previous-depth", guides.previousDepth);
  if (!guides.geometricNormal.valid()) return;
  setOutput(kGeometricNormal, guides.geometricNormal);
  setOutput(kPreviousGeometricNormal, guides.previousGeometricNormal);
}

fg::ResourceVersion RecordingPorts::ask(std::string_view port, VkFormat format, std::string_view optional) {
  const auto known = known_->find(port);
  if (known == known_->end()) {
    throw std::logic_error("no pass type makes what port '" + std::string(port) + "' takes");
  }
  const auto asked = std::ranges::find(asked_, port, &Asked::port);
  if (asked != asked_.end()) return asked->resource;
  std::string name(port);
  if (const auto* texture = std::get_if<fg::TextureDesc>(&known->second.desc)) {
    fg::TextureDesc desc = *texture;
    if (format != VK_FORMAT_UNDEFINED) desc.format = format;
    asked_.push_back({name, graph().import(name, desc, kAnyState), optional});
  } else {
    asked_.push_back({name, graph().import(name, std::get<fg::BufferDesc>(known->second.desc), kAnyState)});
  }
  return asked_.back().resource;
}

fg::Texture RecordingPorts::texture(std::string_view port) {
  const HostInput* input = hostInputNamed(port);
  if (input != nullptr && input->optional && !present_(port)) return {};
  return {ask(port)};
}

fg::Texture RecordingPorts::texture(std::string_view port, VkFormat format) {
  return {ask(port, format)};
}

fg::Texture RecordingPorts::optionalTexture(std::string_view port, std::string_view description) {
  return {ask(port, VK_FORMAT_UNDEFINED, description)};
}

fg::Buffer RecordingPorts::buffer(std::string_view port) {
  return {ask(port)};
}

fg::Texture RecordingPorts::target(std::string_view port, VkFormat format, fg::Extent extent) {
  return graph().import(std::string(port) + " target", {format, extent}, kAnyState);
}

std::vector<Port> RecordingPorts::takePorts(bool unread) {
  std::vector<Port> ports;
  const fg::GraphDesc& desc = graph().desc();
  for (const Asked& asked : asked_) {
    Port port = describe(desc, *known_, asked.port, asked.resource.resource);
    const HostInput* input = hostInputNamed(port.name);
    const bool isRead = !port.accesses.empty();
    port.optional = !isRead || !asked.optional.empty() || (input != nullptr && input->optional);
    if (isRead && !asked.optional.empty()) port.description = asked.optional;
    if (unread || isRead) ports.push_back(std::move(port));
  }
  for (const auto& [name, texture] : takeOutputs().textures) {
    Port port = describe(desc, *known_, name, texture.resource);
    port.output = true;
    port.optional = true;
    ports.push_back(std::move(port));
  }
  return ports;
}

}  // namespace walr
