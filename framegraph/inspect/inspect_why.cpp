#include <algorithm>
#include <span>

#include "framegraph/compile/access_history.h"
#include "framegraph/compile/alias.h"
#include "framegraph/inspect/inspect.h"
#include "framegraph/plan/memory_places.h"
#include "framegraph/plan/names.h"

namespace fg {
namespace {

std::string place(const SourceLocation& where) {
  return std::string(where.file_name()) + ":" + std::to_string(where.line());
}

template <typename Decl>
std::uint32_t indexOf(const std::vector<Decl>& decls, std::string_view name) {
  const auto found = std::ranges::find(decls, name, &Decl::name);
  return found == decls.end() ? kNone : static_cast<std::uint32_t>(found - decls.begin());
}

std::string unknown(std::string_view name) {
  return "the graph declares no '" + std::string(name) + "'";
}

/// The reason why a resource does not share its bytes; empty if it may share them.
std::string whyAlone(const GraphDesc& graph, const Plan& plan, std::uint32_t index) {
  const ResourceDecl& decl = graph.resources[index];
  const std::string start = "'" + decl.name + "' (" + place(decl.where) + ") ";
  if (!plan.resources[index].used) return start + "is not used";
  if (plan.resources[index].heap != kNone) return {};
  if (decl.lifetime == Lifetime::Transient) return start + "is exported, and the host may use it after the frame";
  if (decl.history == kNone) {
    return start + "is " + std::string(lifetimeName(decl.lifetime)) +
           ", and only transients and histories share memory";
  }
  return start +
         "belongs to a history that transients may not alias: it is exported, no pass reads it, or aliasing of "
         "histories is off";
}

/// The batches during which a resource holds its bytes.
class Held {
 public:
  Held(const GraphDesc& graph, const Plan& plan, std::uint32_t index) {
    const PassSpan passes = occupied(graph, plan, index);
    first_ = plan.passes[passes.first].batch;
    lastUse_ = plan.passes[passes.last].batch;
    last_ = lastUse_;
    if (graph.resources[index].lifetime == Lifetime::Transient) {
      last_ = heldUntil(AccessHistory(graph, plan), plan, index);
    }
  }

  [[nodiscard]] bool meets(const Held& other) const { return first_ <= other.last_ && other.first_ <= last_; }
  [[nodiscard]] std::string text() const {
    return "batches " + std::to_string(first_) + " to " + std::to_string(last_) +
           (last_ == lastUse_ ? ""
                              : " (nobody reads the last write, so that a barrier before batch " +
                                    std::to_string(last_) + " makes it available)");
  }

 private:
  std::uint32_t first_;
  std::uint32_t lastUse_;
  std::uint32_t last_;
};

bool uses(const PassDecl& pass, std::uint32_t resource) {
  return std::ranges::find(pass.accesses, resource, &AccessDecl::resource) != pass.accesses.end();
}

}  // namespace

std::string whyCulled(const GraphDesc& graph, const Plan& plan, std::string_view pass) {
  const std::uint32_t index = indexOf(graph.passes, pass);
  if (index == kNone) return unknown(pass);
  const auto culled = std::ranges::find(plan.culled, index, &CulledPass::pass);
  const std::string start = "'" + std::string(pass) + "' (" + place(graph.passes[index].where) + ") ";
  if (culled == plan.culled.end()) return start + "is executed";
  return start + "is culled: " + culled->reason;
}

std::string whyBarriers(const GraphDesc& graph, const Plan& plan, std::string_view pass) {
  const std::uint32_t index = indexOf(graph.passes, pass);
  if (index == kNone) return unknown(pass);
  const auto planned = std::ranges::find(plan.passes, index, &PlannedPass::pass);
  if (planned == plan.passes.end()) return whyCulled(graph, plan, pass);
  // The barriers that concern a pass are recorded before its batch. Those that concern no pass of the batch count as
  // the first one's.
  const auto first = std::ranges::lower_bound(plan.passes, planned->batch, {}, &PlannedPass::batch);
  const auto end = std::ranges::upper_bound(plan.passes, planned->batch, {}, &PlannedPass::batch);
  const std::span batch(first, end);
  const auto concerns = [&](const PlannedBarrier& barrier) {
    if (uses(graph.passes[index], barrier.resource)) return true;
    return planned == first && std::ranges::none_of(batch, [&](const PlannedPass& other) {
             return uses(graph.passes[other.pass], barrier.resource);
           });
  };
  std::string text;
  for (const PlannedBarrier& barrier : batch.front().barriers) {
    if (!concerns(barrier)) continue;
    text += "'" + graph.resources[barrier.resource].name + "': " + toText(graph, barrier);
    for (const AccessDecl& access : graph.passes[index].accesses) {
      if (access.resource == barrier.resource) text += "; declared at " + place(access.where);
    }
    text += "\n";
  }
  if (text.empty()) return "'" + std::string(pass) + "' needs no barrier\n";
  if (planned == first) return text;
  return "recorded before '" + graph.passes[batch.front().pass].name + "', the first pass of batch " +
         std::to_string(planned->batch) + ":\n" + text;
}

std::string whyNotAliased(const GraphDesc& graph, const Plan& plan, std::string_view first, std::string_view second) {
  const std::uint32_t a = indexOf(graph.resources, first);
  const std::uint32_t b = indexOf(graph.resources, second);
  if (a == kNone || b == kNone) return unknown(a == kNone ? first : second);
  for (const std::uint32_t index : {a, b}) {
    if (const std::string why = whyAlone(graph, plan, index); !why.empty()) return why;
  }
  const PlannedResource& x = plan.resources[a];
  const PlannedResource& y = plan.resources[b];
  const std::string both = "'" + std::string(first) + "' and '" + std::string(second) + "' ";
  if (x.memoryTypeBits != y.memoryTypeBits) return both + "need different kinds of memory";
  const auto isHistory = [&](std::uint32_t index) { return graph.resources[index].history != kNone; };
  if (isHistory(a) && isHistory(b)) return both + "are images of histories, whose memory only transients alias";
  const Held held(graph, plan, a);
  const Held otherHeld(graph, plan, b);
  if (held.meets(otherHeld)) {
    return both + "are alive at the same time: " + held.text() + " and " + otherHeld.text();
  }
  const bool overlap = x.heap == y.heap && x.offset < y.offset + y.size && y.offset < x.offset + x.size;
  return both + (overlap ? "share memory" : "could share memory, but are placed apart");
}

}  // namespace fg
