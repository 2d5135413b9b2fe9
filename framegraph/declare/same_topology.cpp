#include "framegraph/declare/same_topology.h"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace fg {
namespace {

/// The parts of a declaration that a plan, its diagnostics or an executor's objects depend on.
auto essence(const ResourceDecl& resource) {
  return std::tuple_cat(
      std::tie(resource.name, resource.desc, resource.lifetime, resource.acquire, resource.history, resource.versions),
      std::tuple(resource.contents.data(), resource.contents.size()));
}
auto essence(const AccessDecl& access) {
  return std::tie(access.resource, access.readVersion, access.writeVersion, access.replacesVersion, access.access,
                  access.range, access.binding, access.filter, access.unread);
}
auto essence(const HistoryAgeConstant& age) {
  return std::tie(age.history, age.offset);
}
auto essence(const HistoryDecl& history) {
  return std::tie(history.name, history.previous, history.current);
}
auto essence(const ExportDecl& exported) {
  return std::tie(exported.resource, exported.release);
}

template <typename Decl>
bool same(const std::vector<Decl>& a, const std::vector<Decl>& b) {
  return std::ranges::equal(a, b, [](const Decl& x, const Decl& y) { return essence(x) == essence(y); });
}

bool dispatches(const ComputeDispatch& work) {
  return std::ranges::find(work.groups, 0U) == std::end(work.groups);
}

bool same(const ComputeDispatch& a, const ComputeDispatch& b) {
  return a.shader == b.shader && a.specialized == b.specialized && a.unknownConstants == b.unknownConstants &&
         a.constants.size() == b.constants.size() && same(a.historyAges, b.historyAges) && a.indirect == b.indirect &&
         a.indirectOffset == b.indirectOffset && dispatches(a) == dispatches(b);
}

bool same(const PassDecl& a, const PassDecl& b) {
  if (a.name != b.name || a.extent != b.extent || a.sideEffects != b.sideEffects) return false;
  if (!same(a.accesses, b.accesses)) return false;
  const auto* work = std::get_if<ComputeDispatch>(&a.work);
  const auto* other = std::get_if<ComputeDispatch>(&b.work);
  return work != nullptr && other != nullptr ? same(*work, *other) : work == other;
}

}  // namespace

bool sameTopology(const GraphDesc& a, const GraphDesc& b) {
  return same(a.resources, b.resources) && same(a.histories, b.histories) && same(a.exports, b.exports) &&
         std::ranges::equal(a.passes, b.passes, [](const PassDecl& x, const PassDecl& y) { return same(x, y); });
}

}  // namespace fg
