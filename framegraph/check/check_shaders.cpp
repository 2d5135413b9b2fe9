#include <algorithm>

#include "framegraph/check/checks.h"
#include "framegraph/declare/access.h"
#include "framegraph/declare/format.h"

namespace fg {
namespace {

/// Whether a descriptor of this type can serve the access.
bool serves(VkDescriptorType type, Access access, bool texture) {
  switch (access) {
    case Access::SampledRead:
      return type == VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE || type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    case Access::StorageRead:
    case Access::StorageWrite:
    case Access::StorageReadWrite:
      return type == (texture ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    case Access::UniformRead:
      return type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    default:
      return false;
  }
}

std::string describe(const ShaderBinding& binding) {
  switch (binding.type) {
    case VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE:
    case VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER:
      return "a sampled image";
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
      return "a uniform block";
    case VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR:
      return "an acceleration structure, which only a callback can bind";
    default:
      break;
  }
  const std::string kind = binding.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE ? "storage image" : "storage buffer";
  if (binding.reads && binding.writes) return "a read and written " + kind;
  return (binding.writes ? "a writeonly " : "a readonly ") + kind;
}

class ShaderCheck {
 public:
  ShaderCheck(const GraphDesc& graph, const PassDecl& pass, const ComputeDispatch& work, Findings& findings)
      : graph_(graph), pass_(pass), work_(work), shader_(*work.shader), findings_(findings) {}

  void run() {
    for (std::size_t i = 0; i < pass_.accesses.size(); ++i) checkAccess(i);
    for (const ShaderBinding& binding : shader_.bindings) checkDeclared(binding);
    checkConstants();
  }

 private:
  [[nodiscard]] std::string start() const {
    return "pass '" + pass_.name + "', shader '" + std::string(shader_.name) + "': ";
  }

  void checkAccess(std::size_t index) {
    const AccessDecl& access = pass_.accesses[index];
    if (!validHandle(graph_, access)) return;
    if (access.binding.empty()) {
      if (access.access == Access::IndirectRead) return;
      findings_.error(code::kBindingNotInShader, pass_, access,
                      start() + "declares the access " + std::string(accessInfo(access.access).name) +
                          " without a binding, which only a callback pass can; use sample, load, store or uniform");
      return;
    }
    const auto end = pass_.accesses.begin() + static_cast<std::ptrdiff_t>(index);
    if (std::find_if(pass_.accesses.begin(), end,
                     [&](const AccessDecl& other) { return other.binding == access.binding; }) != end) {
      findings_.error(code::kBindingTwice, pass_, access,
                      start() + "'" + access.binding + "' is declared twice; declare each binding once");
      return;
    }
    const auto binding = std::ranges::find(shader_.bindings, access.binding, &ShaderBinding::name);
    if (binding == shader_.bindings.end()) {
      findings_.error(code::kBindingNotInShader, pass_, access,
                      start() + "'" + access.binding + "' is declared, but the shader has no such binding (has" +
                          bindingNames() + "); remove the declaration or correct the name");
      return;
    }
    checkBinding(access, *binding);
  }

  [[nodiscard]] std::string bindingNames() const {
    std::string names;
    for (const ShaderBinding& binding : shader_.bindings) names += " '" + std::string(binding.name) + "'";
    return names.empty() ? " none" : names;
  }

  void checkBinding(const AccessDecl& access, const ShaderBinding& binding) {
    const ResourceDecl& resource = graph_.resources[access.resource];
    const AccessInfo& info = accessInfo(access.access);
    const auto* texture = std::get_if<TextureDesc>(&resource.desc);
    if (!serves(binding.type, access.access, texture != nullptr) || binding.reads != info.reads() ||
        binding.writes != info.writes()) {
      findings_.error(code::kBindingAccess, pass_, access,
                      start() + "'" + access.binding + "' is declared as " + std::string(info.name) +
                          ", but the shader has it as " + describe(binding) +
                          "; correct the declaration, or the qualifiers in the shader");
      return;
    }
    if (texture != nullptr && binding.format != VK_FORMAT_UNDEFINED && binding.format != texture->format) {
      findings_.error(code::kBindingFormat, pass_, access,
                      start() + "'" + access.binding + "' has format " + std::string(formatInfo(binding.format).name) +
                          ", but texture '" + resource.name + "' has " + std::string(formatInfo(texture->format).name));
    }
    if (texture == nullptr && binding.blockSize > std::get<BufferDesc>(resource.desc).size) {
      findings_.error(code::kBufferTooSmall, pass_, access,
                      start() + "uniform block '" + access.binding + "' has " + std::to_string(binding.blockSize) +
                          " bytes, but buffer '" + resource.name + "' only " +
                          std::to_string(std::get<BufferDesc>(resource.desc).size));
    }
  }

  void checkDeclared(const ShaderBinding& binding) {
    if (std::ranges::find(pass_.accesses, binding.name, &AccessDecl::binding) != pass_.accesses.end()) return;
    findings_.error(code::kBindingNotDeclared, pass_,
                    start() + "binding '" + std::string(binding.name) + "', " + describe(binding) +
                        ", is not declared; declare what it is bound to");
  }

  void checkConstants() {
    if (work_.constants.size() != shader_.pushConstantSize) {
      findings_.error(code::kPushConstantSize, pass_,
                      start() + std::to_string(work_.constants.size()) +
                          " bytes of push constants are given, but the shader takes " +
                          std::to_string(shader_.pushConstantSize));
    }
    for (const HistoryAgeConstant& age : work_.historyAges) {
      const bool inside = age.offset % sizeof(std::uint32_t) == 0 && work_.constants.size() >= sizeof(std::uint32_t) &&
                          age.offset <= work_.constants.size() - sizeof(std::uint32_t);
      if (inside && age.history < graph_.histories.size()) continue;
      findings_.error(code::kHistoryAge, pass_,
                      start() + (inside ? "historyAge names a history of another graph"
                                        : "historyAge has offset " + std::to_string(age.offset) + " into " +
                                              std::to_string(work_.constants.size()) +
                                              " bytes of push constants; it must be a multiple of 4 inside them"));
    }
    for (const std::string& name : work_.unknownConstants) {
      findings_.error(code::kUnknownConstant, pass_, start() + "there is no specialization constant '" + name + "'");
    }
    for (std::size_t i = 0; i < shader_.constants.size(); ++i) {
      if (i < work_.specialized.size() && work_.specialized[i]) continue;
      findings_.error(code::kConstantNotSet, pass_,
                      start() + "specialization constant '" + std::string(shader_.constants[i].name) +
                          "' has no value; call specialize");
    }
  }

  const GraphDesc& graph_;
  const PassDecl& pass_;
  const ComputeDispatch& work_;
  const Shader& shader_;
  Findings& findings_;
};

}  // namespace

void checkShaders(const Topology& topology, Findings& findings) {
  const GraphDesc& graph = topology.graph();
  for (const PassDecl& pass : graph.passes) {
    const auto* work = std::get_if<ComputeDispatch>(&pass.work);
    if (work != nullptr && work->shader != nullptr) ShaderCheck(graph, pass, *work, findings).run();
  }
}

}  // namespace fg
