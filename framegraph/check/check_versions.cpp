#include <algorithm>

#include "framegraph/check/checks.h"

namespace fg {
namespace {

/// One mark per subresource of a resource, indexed by mip level, then layer.
class Coverage {
 public:
  explicit Coverage(const ResourceDecl& resource)
      : resource_(&resource), all_(resolved(resource, {})), marked_(std::size_t{all_.mipCount} * all_.layerCount) {}

  void mark(const SubresourceRange& range, bool value) {
    const SubresourceRange part = resolved(*resource_, range);
    const std::uint32_t lastMip = std::min(part.baseMip + part.mipCount, all_.mipCount);
    const std::uint32_t lastLayer = std::min(part.baseLayer + part.layerCount, all_.layerCount);
    for (std::uint32_t mip = part.baseMip; mip < lastMip; ++mip) {
      for (std::uint32_t layer = part.baseLayer; layer < lastLayer; ++layer) {
        marked_[std::size_t{mip} * all_.layerCount + layer] = value;
      }
    }
  }
  [[nodiscard]] bool any() const { return std::ranges::find(marked_, true) != marked_.end(); }

 private:
  const ResourceDecl* resource_;
  SubresourceRange all_;
  std::vector<bool> marked_;
};

class VersionCheck {
 public:
  VersionCheck(const Topology& topology, Findings& findings)
      : topology_(topology), graph_(topology.graph()), findings_(findings) {}

  void run() {
    for (const std::uint32_t index : topology_.passesByName()) {
      const PassDecl& pass = graph_.passes[index];
      for (const AccessDecl& access : pass.accesses) {
        if (!validHandle(graph_, access)) continue;
        if (access.readVersion != kNone) checkRead(pass, access);
        if (access.writeVersion != kNone) checkWrite(pass, access);
      }
    }
    for (const HistoryDecl& history : graph_.histories) checkHistory(history);
    for (std::size_t i = 0; i < graph_.exports.size(); ++i) checkExport(i);
  }

 private:
  /// True if some part of the range has no contents at this version.
  [[nodiscard]] bool lacksContents(std::uint32_t resource, std::uint32_t version, const SubresourceRange& range) const {
    Coverage missing(graph_.resources[resource]);
    missing.mark(range, true);
    for (std::uint32_t steps = 0; steps < topology_.versionCount(resource) && version != kNone; ++steps) {
      const VersionUses& uses = topology_.uses(resource, version);
      if (uses.write != nullptr) missing.mark(uses.write->range, false);
      if (!missing.any()) return false;
      if (version == 0) break;
      version = uses.predecessor;
    }
    return version != 0 || !arrivesWithContents(graph_.resources[resource]);
  }

  static bool arrivesWithContents(const ResourceDecl& resource) {
    switch (resource.lifetime) {
      case Lifetime::Upload:
      case Lifetime::HistoryPrevious:
        return true;
      case Lifetime::Imported:
        return std::holds_alternative<BufferDesc>(resource.desc) ||
               (resource.acquire && resource.acquire->layout != VK_IMAGE_LAYOUT_UNDEFINED);
      default:
        return false;
    }
  }

  void checkRead(const PassDecl& pass, const AccessDecl& access) {
    if (!lacksContents(access.resource, access.readVersion, access.range)) return;
    const ResourceDecl& resource = graph_.resources[access.resource];
    const std::string start = "pass '" + pass.name + "' reads '" + resource.name + "'";
    if (resource.lifetime == Lifetime::Imported) {
      findings_.error(code::kImportWithoutState, pass, access,
                      start +
                          ", but the import's state has layout UNDEFINED, so that it has no contents; give the layout "
                          "in which the host leaves it");
      return;
    }
    findings_.error(
        code::kReadNeverWritten, pass, access,
        start +
            (access.readVersion == 0 ? ", which no pass has written; use the handle that its writer returns"
                                     : ", parts of which no pass has written; write all mip levels and layers") +
            (resource.lifetime == Lifetime::HistoryCurrent ? ", or the history's `previous`" : ""));
  }

  void checkWrite(const PassDecl& pass, const AccessDecl& access) {
    const VersionUses& made = topology_.uses(access.resource, access.writeVersion);
    if (made.write == &access) return;
    const PassDecl& other = graph_.passes[made.writer];
    if (&other == &pass) return;
    findings_.error(code::kTwoWriters, pass, access,
                    "passes '" + other.name + "' and '" + pass.name + "' both make version " +
                        std::to_string(access.writeVersion) + " of '" + graph_.resources[access.resource].name +
                        "'; pass the handle that one of them returns to the other, or use two textures");
  }

  void checkHistory(const HistoryDecl& history) {
    const ResourceDecl& previous = graph_.resources[history.previous];
    const ResourceDecl& current = graph_.resources[history.current];
    if (previous.desc != current.desc) {
      findings_.error(code::kHistoryMismatch, current,
                      "the two images of history '" + history.name + "' are described differently");
    }
    const bool read = !topology_.uses(history.previous, 0).readers.empty();
    const bool exported = std::ranges::any_of(
        graph_.exports, [&](const ExportDecl& other) { return other.resource.resource == history.previous; });
    if ((read || exported) && current.versions == 0) {
      findings_.error(
          code::kHistoryNeverWritten, previous,
          "history '" + history.name + "' is " + (read ? "read" : "exported") + ", but no pass writes its `current`");
    }
    if (current.versions > 1) {
      findings_.error(code::kHistoryWrittenTwice, current,
                      "history '" + history.name + "' is written " + std::to_string(current.versions) +
                          " times; write a transient first and the history's `current` once");
    }
    if (current.versions == 0) return;
    const AccessDecl* write = topology_.uses(history.current, 1).write;
    if (write != nullptr && !coversAll(current, write->range)) {
      findings_.error(code::kHistoryWrittenTwice, current,
                      "only a part of history '" + history.name + "' is written; write all mip levels and layers");
    }
  }

  void checkExport(std::size_t index) {
    const ExportDecl& exported = graph_.exports[index];
    const auto [resource, version] = exported.resource;
    if (resource >= graph_.resources.size() || version > graph_.resources[resource].versions) {
      findings_.error(code::kInvalidHandle, exported, "an export's handle is empty or belongs to another graph");
      return;
    }
    const ResourceDecl& decl = graph_.resources[resource];
    const std::string start = "export '" + decl.name + "' ";
    if (lacksContents(resource, version, {})) {
      findings_.error(code::kExportNeverWritten, exported,
                      start + "is not written, or only in part; export the handle that its writer returns");
    }
    if (version + 1 < topology_.versionCount(resource) && topology_.uses(resource, version + 1).writer != kNone) {
      const PassDecl& writer = graph_.passes[topology_.uses(resource, version + 1).writer];
      findings_.error(code::kExportOverwritten, exported,
                      start + "is overwritten by pass '" + writer.name + "'; export the last version");
    }
    const bool twice =
        std::any_of(graph_.exports.begin(), graph_.exports.begin() + static_cast<std::ptrdiff_t>(index),
                    [&](const ExportDecl& other) { return other.resource.resource == exported.resource.resource; });
    if (twice) findings_.error(code::kExportedTwice, exported, start + "is exported twice; export it once");
    if (std::holds_alternative<TextureDesc>(decl.desc) && exported.release.layout == VK_IMAGE_LAYOUT_UNDEFINED) {
      findings_.error(code::kExportWithoutLayout, exported,
                      start + "has release layout UNDEFINED; give the layout in which the host uses it next");
    }
  }

  const Topology& topology_;
  const GraphDesc& graph_;
  Findings& findings_;
};

}  // namespace

void checkVersions(const Topology& topology, Findings& findings) {
  VersionCheck(topology, findings).run();
}

}  // namespace fg
