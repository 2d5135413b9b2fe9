#include <sstream>

#include "framegraph/declare/access.h"
#include "framegraph/declare/format.h"
#include "framegraph/declare/topology.h"
#include "framegraph/inspect/inspect.h"
#include "framegraph/plan/memory_places.h"
#include "framegraph/plan/names.h"

namespace fg {
namespace {

class TextWriter {
 public:
  TextWriter(const GraphDesc& graph, const Plan& plan) : graph_(graph), plan_(plan), topology_(graph) {}

  std::string run() {
    if (plan_.resources.size() != graph_.resources.size()) return "no plan\n";
    writeMemory();
    for (const std::uint32_t resource : topology_.resourcesByName()) writeResource(resource);
    for (std::uint32_t position = 0; position < plan_.passes.size(); ++position) writePass(position);
    if (!plan_.releases.empty()) out_ << "release\n";
    for (const PlannedBarrier& barrier : plan_.releases) writeBarrier(barrier);
    for (const CulledPass& culled : plan_.culled) {
      out_ << "culled " << graph_.passes[culled.pass].name << ": " << culled.reason << "\n";
    }
    return out_.str();
  }

 private:
  void writeMemory() {
    const MemoryReport& memory = plan_.memory;
    out_ << "memory: persistent " << memory.persistentBytes << ", transient " << memory.transientUnaliasedBytes
         << " unaliased, " << memory.transientPeakBytes << " aliased, at least " << memory.transientLowerBoundBytes
         << ", together " << memory.persistentBytes + memory.transientPeakBytes << "\n";
    const TrafficReport& traffic = plan_.traffic;
    out_ << "traffic: read " << traffic.bytesRead << ", written " << traffic.bytesWritten << ", "
         << traffic.bytesPerPixel() << " bytes a pixel\n";
    for (std::size_t i = 0; i < plan_.heaps.size(); ++i) {
      out_ << "heap " << i << ": " << plan_.heaps[i].size << " bytes";
      if (plan_.heaps[i].partner != kNone) out_ << ", swaps with heap " << plan_.heaps[i].partner << " every frame";
      out_ << "\n";
    }
  }

  void writeResource(std::uint32_t index) {
    const ResourceDecl& resource = graph_.resources[index];
    const PlannedResource& planned = plan_.resources[index];
    out_ << lifetimeName(resource.lifetime) << " " << resource.name << ": ";
    if (const auto* texture = std::get_if<TextureDesc>(&resource.desc)) {
      out_ << formatInfo(texture->format).name << " " << texture->extent.width << "x" << texture->extent.height;
      if (texture->mipLevels != 1) out_ << ", " << texture->mipLevels << " mips";
      if (texture->arrayLayers != 1) out_ << ", " << texture->arrayLayers << " layers";
    } else {
      out_ << std::get<BufferDesc>(resource.desc).size << " bytes";
    }
    if (!planned.used) {
      out_ << ", unused\n";
      return;
    }
    if (planned.firstUse != kNone) out_ << ", passes " << planned.firstUse << ".." << planned.lastUse;
    if (planned.heap != kNone) out_ << ", " << placeText(graph_, plan_, index);
    out_ << "\n";
  }

  void writePass(std::uint32_t position) {
    const PlannedPass& planned = plan_.passes[position];
    const PassDecl& pass = graph_.passes[planned.pass];
    if (position == 0 || planned.batch != plan_.passes[position - 1].batch) out_ << "batch " << planned.batch << "\n";
    for (const PlannedBarrier& barrier : planned.barriers) writeBarrier(barrier);
    out_ << "pass " << position << " " << pass.name << "\n";
    for (const AccessDecl& access : pass.accesses) {
      out_ << "  " << accessInfo(access.access).name << " " << graph_.resources[access.resource].name;
      if (access.readVersion != kNone) out_ << " v" << access.readVersion;
      if (access.writeVersion != kNone) out_ << " -> v" << access.writeVersion;
      if (access.unread) out_ << ", unread, for " << access.binding;
      out_ << "\n";
    }
  }

  void writeBarrier(const PlannedBarrier& barrier) {
    out_ << "  barrier " << graph_.resources[barrier.resource].name;
    if (barrier.range != SubresourceRange{}) {
      out_ << " mips " << barrier.range.baseMip << "+" << barrier.range.mipCount << " layers "
           << barrier.range.baseLayer << "+" << barrier.range.layerCount;
    }
    out_ << ": " << toText(graph_, barrier) << "\n";
  }

  const GraphDesc& graph_;
  const Plan& plan_;
  Topology topology_;
  std::ostringstream out_;
};

}  // namespace

std::string toText(const GraphDesc& graph, const PlannedBarrier& barrier) {
  std::string text(reasonName(barrier.reason));
  if (barrier.aliasOf != kNone) text += " of " + graph.resources[barrier.aliasOf].name;
  text += ", " + stageNames(barrier.srcStage) + " " + accessNames(barrier.srcAccess) + " -> " +
          stageNames(barrier.dstStage) + " " + accessNames(barrier.dstAccess);
  if (std::holds_alternative<TextureDesc>(graph.resources[barrier.resource].desc)) {
    text += ", " + layoutName(barrier.oldLayout) + " -> " + layoutName(barrier.newLayout);
  }
  return text;
}

std::string toText(const GraphDesc& graph, const Plan& plan) {
  return TextWriter(graph, plan).run();
}

}  // namespace fg
