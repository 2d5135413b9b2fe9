#include <algorithm>

#include "framegraph/check/checks.h"
#include "framegraph/declare/access.h"

namespace fg {
namespace {

std::string quoted(const std::string& name) {
  return "'" + name + "'";
}

std::string size(Extent extent) {
  return std::to_string(extent.width) + "x" + std::to_string(extent.height);
}

/// Extent of the first mip level that the access covers.
Extent accessedExtent(const TextureDesc& texture, const AccessDecl& access) {
  const std::uint32_t mip = std::min(access.range.baseMip, 31U);
  return {std::max(texture.extent.width >> mip, 1U), std::max(texture.extent.height >> mip, 1U)};
}

bool meets(std::uint32_t base, std::uint32_t count, std::uint32_t otherBase, std::uint32_t otherCount) {
  return base < otherBase + otherCount && otherBase < base + count;
}

bool meets(const ResourceDecl& resource, const AccessDecl& a, const AccessDecl& b) {
  const SubresourceRange x = resolved(resource, a.range);
  const SubresourceRange y = resolved(resource, b.range);
  return meets(x.baseMip, x.mipCount, y.baseMip, y.mipCount) &&
         meets(x.baseLayer, x.layerCount, y.baseLayer, y.layerCount);
}

class PassCheck {
 public:
  PassCheck(const GraphDesc& graph, const PassDecl& pass, Findings& findings)
      : graph_(graph), pass_(pass), findings_(findings) {}

  void run() {
    for (const AccessDecl& access : pass_.accesses) checkAccess(access);
    for (std::size_t i = 0; i < pass_.accesses.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) checkPair(pass_.accesses[j], pass_.accesses[i]);
    }
    checkAttachments();
    if (const auto* dispatch = std::get_if<ComputeDispatch>(&pass_.work)) checkDispatch(*dispatch);
  }

 private:
  [[nodiscard]] bool valid(const AccessDecl& access) const { return validHandle(graph_, access); }

  void checkAccess(const AccessDecl& access) {
    if (!valid(access)) {
      findings_.error(code::kInvalidHandle, pass_, access,
                      "pass " + quoted(pass_.name) + " uses a handle that is empty or belongs to another graph" +
                          (access.binding.empty() ? "" : " for " + quoted(access.binding)));
      return;
    }
    const ResourceDecl& resource = graph_.resources[access.resource];
    const AccessInfo& info = accessInfo(access.access);
    const auto* texture = std::get_if<TextureDesc>(&resource.desc);
    if ((texture != nullptr ? info.imageUsage : info.bufferUsage) == 0) {
      findings_.error(code::kAccessKind, pass_, access,
                      "pass " + quoted(pass_.name) + ": " + (texture != nullptr ? "texture " : "buffer ") +
                          quoted(resource.name) + " cannot be accessed as " + std::string(info.name));
    }
    if (texture != nullptr) {
      checkRange(access, *texture);
      checkExtent(access, *texture);
    }
    if (access.unread) checkUnread(access);
    const bool readOnly = resource.lifetime == Lifetime::Upload || resource.lifetime == Lifetime::HistoryPrevious;
    if (info.writes() && readOnly) {
      findings_.error(code::kReadOnlyWritten, pass_, access,
                      "pass " + quoted(pass_.name) + " writes " + quoted(resource.name) +
                          (resource.lifetime == Lifetime::Upload
                               ? ", which only the host writes; use a transient buffer"
                               : ", which holds last frame's contents; write the history's `current`"));
    }
  }

  /// Nothing is done for a resource that is only bound: some other access must bring it into the state of a read.
  void checkUnread(const AccessDecl& access) {
    const bool isRead = std::ranges::any_of(pass_.accesses, [&](const AccessDecl& other) {
      return !other.unread && other.resource == access.resource && other.readVersion == access.readVersion &&
             other.access == access.access && other.range == access.range;
    });
    if (isRead) return;
    findings_.error(code::kUnreadStandIn, pass_, access,
                    "pass " + quoted(pass_.name) + " binds " + quoted(findings_.resourceName(access.resource)) +
                        " to " + quoted(access.binding) + " as unread, but does not read it under another name; " +
                        "bind a resource that it reads anyhow, or declare the read (sample, load)");
  }

  void checkRange(const AccessDecl& access, const TextureDesc& texture) {
    const auto inside = [](std::uint32_t base, std::uint32_t count, std::uint32_t whole) {
      const bool remaining = count == VK_REMAINING_MIP_LEVELS;
      return base < whole && (remaining || (count != 0 && count <= whole - base));
    };
    const SubresourceRange& range = access.range;
    if (inside(range.baseMip, range.mipCount, texture.mipLevels) &&
        inside(range.baseLayer, range.layerCount, texture.arrayLayers)) {
      return;
    }
    findings_.error(code::kSubresourceRange, pass_, access,
                    "pass " + quoted(pass_.name) + " accesses mip level " + std::to_string(range.baseMip) +
                        " and layer " + std::to_string(range.baseLayer) + " onwards of " +
                        quoted(findings_.resourceName(access.resource)) + ", which has " +
                        std::to_string(texture.mipLevels) + " mip levels and " + std::to_string(texture.arrayLayers) +
                        " layers");
  }

  void checkExtent(const AccessDecl& access, const TextureDesc& texture) {
    const Extent extent = accessedExtent(texture, access);
    if (!pass_.extent || extent == *pass_.extent) return;
    findings_.error(code::kExtentMismatch, pass_, access,
                    "pass " + quoted(pass_.name) + " works on " + size(*pass_.extent) + " texels, but " +
                        quoted(findings_.resourceName(access.resource)) + producers(access) + " has " + size(extent) +
                        "; give the texture that extent, or access the mip level that has it");
  }

  /// The passes that wrote what an access reads, as text: ", written by 'x',". Empty if there is none.
  [[nodiscard]] std::string producers(const AccessDecl& access) const {
    if (access.readVersion == kNone) return {};
    std::string text;
    for (const PassDecl& pass : graph_.passes) {
      for (const AccessDecl& other : pass.accesses) {
        if (other.resource != access.resource || other.writeVersion != access.readVersion) continue;
        text += (text.empty() ? ", written by " : " and ") + quoted(pass.name) + ",";
      }
    }
    return text;
  }

  void checkPair(const AccessDecl& first, const AccessDecl& second) {
    if (first.resource != second.resource || !valid(first) || !valid(second)) return;
    const ResourceDecl& resource = graph_.resources[first.resource];
    const AccessInfo& a = accessInfo(first.access);
    const AccessInfo& b = accessInfo(second.access);
    const auto readsOwn = [](const AccessDecl& read, const AccessDecl& write) {
      return read.readVersion != kNone && read.readVersion == write.writeVersion;
    };
    if (readsOwn(first, second) || readsOwn(second, first) ||
        ((a.writes() || b.writes()) && meets(resource, first, second))) {
      findings_.error(
          code::kReadAndWritten, pass_, second,
          "pass " + quoted(pass_.name) + " accesses " + quoted(resource.name) +
              " twice and writes it; declare one access that reads and writes (update), or use two textures");
    } else if (std::holds_alternative<TextureDesc>(resource.desc) && a.layout != b.layout &&
               (resource.history != kNone || meets(resource, first, second))) {
      findings_.error(code::kTwoLayouts, pass_, second,
                      "pass " + quoted(pass_.name) + " reads " + quoted(resource.name) + " as " + std::string(a.name) +
                          " and as " + std::string(b.name) +
                          ", which need two layouts at once; read it in only one of these ways");
    }
  }

  void checkAttachments() {
    constexpr VkImageUsageFlags kAttachment =
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    const AccessDecl* first = nullptr;
    for (const AccessDecl& access : pass_.accesses) {
      if (!valid(access) || (accessInfo(access.access).imageUsage & kAttachment) == 0) continue;
      const auto* texture = std::get_if<TextureDesc>(&graph_.resources[access.resource].desc);
      if (texture == nullptr) continue;
      if (first == nullptr) {
        first = &access;
        continue;
      }
      const ResourceDecl& other = graph_.resources[first->resource];
      const Extent expected = accessedExtent(std::get<TextureDesc>(other.desc), *first);
      const Extent extent = accessedExtent(*texture, access);
      if (extent == expected) continue;
      findings_.error(code::kExtentMismatch, pass_, access,
                      "pass " + quoted(pass_.name) + " draws into " + quoted(other.name) + " of " + size(expected) +
                          " and " + quoted(findings_.resourceName(access.resource)) + " of " + size(extent) +
                          "; the attachments of one pass must have one extent");
    }
  }

  void checkDispatch(const ComputeDispatch& dispatch) {
    if (dispatch.indirect.valid()) {
      checkIndirect(dispatch);
    } else if (std::ranges::find(dispatch.groups, 0U) != std::end(dispatch.groups)) {
      findings_.error(
          code::kEmptyDispatch, pass_,
          "pass " + quoted(pass_.name) + " dispatches no work group; call dispatch with an extent that is not empty");
    }
  }

  void checkIndirect(const ComputeDispatch& dispatch) {
    if (dispatch.indirect.resource >= graph_.resources.size()) return;
    const auto* buffer = std::get_if<BufferDesc>(&graph_.resources[dispatch.indirect.resource].desc);
    if (buffer == nullptr) return;
    const bool fits = buffer->size >= sizeof(VkDispatchIndirectCommand) &&
                      dispatch.indirectOffset <= buffer->size - sizeof(VkDispatchIndirectCommand);
    if (fits && dispatch.indirectOffset % sizeof(std::uint32_t) == 0) return;
    findings_.add(code::kIndirectArguments, Severity::Error, pass_.name,
                  findings_.resourceName(dispatch.indirect.resource),
                  "pass " + quoted(pass_.name) + " takes 12 bytes of dispatch arguments at offset " +
                      std::to_string(dispatch.indirectOffset) + " of " + std::to_string(buffer->size) +
                      " bytes; the offset must be a multiple of 4, and the arguments must lie inside the buffer",
                  pass_.where);
  }

  const GraphDesc& graph_;
  const PassDecl& pass_;
  Findings& findings_;
};

}  // namespace

void checkPasses(const Topology& topology, Findings& findings) {
  const GraphDesc& graph = topology.graph();
  for (const PassDecl& pass : graph.passes) PassCheck(graph, pass, findings).run();
}

}  // namespace fg
