#include <algorithm>
#include <map>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "framegraph/declare/access.h"
#include "framegraph/declare/format.h"
#include "framegraph/declare/topology.h"
#include "framegraph/inspect/inspect.h"
#include "framegraph/plan/memory_places.h"
#include "framegraph/plan/names.h"

namespace fg {
namespace {

using Json = nlohmann::ordered_json;

/// kNone as null.
Json indexOrNull(std::uint32_t index) {
  return index == kNone ? Json() : Json(index);
}

std::uint32_t noneOrIndex(const Json& json) {
  return json.is_null() ? kNone : json.get<std::uint32_t>();
}

class JsonWriter {
 public:
  JsonWriter(const GraphDesc& graph, const Plan& plan) : graph_(graph), plan_(plan), topology_(graph) {}

  std::string run() {
    Json json;
    json["passes"] = passes();
    json["textures"] = resources(true);
    json["buffers"] = resources(false);
    json["barriers"] = barriers();
    json["heaps"] = Json::array();
    for (const PlannedHeap& heap : plan_.heaps) {
      json["heaps"].push_back(
          {{"memory_type_bits", heap.memoryTypeBits}, {"bytes", heap.size}, {"swaps_with", indexOrNull(heap.partner)}});
    }
    json["histories"] = histories();
    json["culled"] = Json::array();
    for (const CulledPass& culled : plan_.culled) {
      json["culled"].push_back({{"pass", graph_.passes[culled.pass].name}, {"reason", culled.reason}});
    }
    const MemoryReport& memory = plan_.memory;
    json["memory"] = {{"persistent_bytes", memory.persistentBytes},
                      {"transient_unaliased_bytes", memory.transientUnaliasedBytes},
                      {"transient_peak_bytes", memory.transientPeakBytes},
                      {"transient_lower_bound_bytes", memory.transientLowerBoundBytes}};
    const TrafficReport& traffic = plan_.traffic;
    json["traffic"] = {{"bytes_read", traffic.bytesRead},
                       {"bytes_written", traffic.bytesWritten},
                       {"pixels", traffic.pixels},
                       {"bytes_per_pixel", traffic.bytesPerPixel()}};
    // Names may be anything that a host passes, also bytes that are not UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
  }

 private:
  [[nodiscard]] const std::string& nameOf(std::uint32_t resource) const { return graph_.resources[resource].name; }
  [[nodiscard]] Json namesOf(const std::vector<std::uint32_t>& resources) const {
    Json list = Json::array();
    for (const std::uint32_t resource : resources) list.push_back(nameOf(resource));
    return list;
  }

  [[nodiscard]] Json passes() const {
    Json list = Json::array();
    for (const PlannedPass& planned : plan_.passes) {
      const PassDecl& pass = graph_.passes[planned.pass];
      Json accesses = Json::array();
      for (const AccessDecl& access : pass.accesses) {
        accesses.push_back({{"resource", nameOf(access.resource)},
                            {"access", accessInfo(access.access).name},
                            {"binding", access.binding},
                            {"unread", access.unread},
                            {"reads_version", indexOrNull(access.readVersion)},
                            {"writes_version", indexOrNull(access.writeVersion)}});
      }
      const auto* work = std::get_if<ComputeDispatch>(&pass.work);
      list.push_back({{"name", pass.name},
                      {"batch", planned.batch},
                      {"shader", work != nullptr && work->shader != nullptr ? Json(work->shader->name) : Json()},
                      {"accesses", std::move(accesses)}});
    }
    return list;
  }

  [[nodiscard]] Json resources(bool textures) const {
    Json list = Json::array();
    for (const std::uint32_t i : topology_.resourcesByName()) {
      const ResourceDecl& decl = graph_.resources[i];
      const PlannedResource& planned = plan_.resources[i];
      const auto* texture = std::get_if<TextureDesc>(&decl.desc);
      if ((texture != nullptr) != textures) continue;
      Json json = {{"name", decl.name}, {"lifetime", lifetimeName(decl.lifetime)}};
      if (texture != nullptr) {
        json.update({{"format", formatInfo(texture->format).name},
                     {"width", texture->extent.width},
                     {"height", texture->extent.height},
                     {"mip_levels", texture->mipLevels},
                     {"array_layers", texture->arrayLayers}});
      }
      json.update({{"used", planned.used},
                   {"image_usage", planned.imageUsage},
                   {"buffer_usage", planned.bufferUsage},
                   {"first_use", indexOrNull(planned.firstUse)},
                   {"last_use", indexOrNull(planned.lastUse)},
                   {"heap", indexOrNull(planned.heap)},
                   {"offset", planned.offset},
                   {"aliases", namesOf(aliasedHistoryImages(graph_, plan_, i))},
                   {"bytes", planned.size},
                   {"alignment", planned.alignment},
                   {"memory_type_bits", planned.memoryTypeBits}});
      list.push_back(std::move(json));
    }
    return list;
  }

  [[nodiscard]] Json barriers() const {
    Json list = Json::array();
    for (const PlannedPass& planned : plan_.passes) {
      for (const PlannedBarrier& barrier : planned.barriers) {
        list.push_back(toJson(barrier, graph_.passes[planned.pass].name));
      }
    }
    for (const PlannedBarrier& barrier : plan_.releases) list.push_back(toJson(barrier, Json()));
    return list;
  }

  /// @param before name of the pass before which the barrier is recorded, null for those after the last one
  [[nodiscard]] Json toJson(const PlannedBarrier& barrier, Json before) const {
    return {
        {"before", std::move(before)},
        {"resource", nameOf(barrier.resource)},
        {"description", toText(graph_, barrier)},
        {"reason", barrier.reason},
        {"src_stage", barrier.srcStage},
        {"src_access", barrier.srcAccess},
        {"dst_stage", barrier.dstStage},
        {"dst_access", barrier.dstAccess},
        {"old_layout", barrier.oldLayout},
        {"new_layout", barrier.newLayout},
        {"range", {barrier.range.baseMip, barrier.range.mipCount, barrier.range.baseLayer, barrier.range.layerCount}},
        {"alias_of", barrier.aliasOf == kNone ? Json() : Json(nameOf(barrier.aliasOf))}};
  }

  [[nodiscard]] Json histories() const {
    std::map<std::string, Json> byName;
    for (std::size_t i = 0; i < plan_.histories.size(); ++i) {
      const PlannedHistory& history = plan_.histories[i];
      byName[graph_.histories[i].name] = {{"name", graph_.histories[i].name},
                                          {"used", history.used},
                                          {"carry_stage", history.carry.stage},
                                          {"carry_access", history.carry.access},
                                          {"carry_layout", history.carry.layout}};
    }
    Json list = Json::array();
    for (auto& [name, json] : byName) list.push_back(std::move(json));
    return list;
  }

  const GraphDesc& graph_;
  const Plan& plan_;
  Topology topology_;
};

class JsonReader {
 public:
  explicit JsonReader(const GraphDesc& graph) : graph_(graph) {}

  Plan run(const Json& json) const {
    Plan plan;
    plan.resources.resize(graph_.resources.size());
    plan.histories.resize(graph_.histories.size());
    for (const Json& pass : json.at("passes")) {
      plan.passes.push_back({find(graph_.passes, pass.at("name")), pass.at("batch"), {}});
    }
    for (const char* kind : {"textures", "buffers"}) {
      for (const Json& resource : json.at(kind)) readResource(resource, plan);
    }
    for (const Json& barrier : json.at("barriers")) readBarrier(barrier, plan);
    for (const Json& heap : json.at("heaps")) {
      plan.heaps.push_back({heap.at("memory_type_bits"), heap.at("bytes"), noneOrIndex(heap.at("swaps_with"))});
    }
    for (const Json& history : json.at("histories")) {
      plan.histories[find(graph_.histories, history.at("name"))] = {
          history.at("used"),
          {history.at("carry_stage"), history.at("carry_access"), history.at("carry_layout").get<VkImageLayout>()}};
    }
    for (const Json& culled : json.at("culled")) {
      plan.culled.push_back({find(graph_.passes, culled.at("pass")), culled.at("reason")});
    }
    const Json& memory = json.at("memory");
    plan.memory = {memory.at("persistent_bytes"), memory.at("transient_unaliased_bytes"),
                   memory.at("transient_peak_bytes"), memory.at("transient_lower_bound_bytes")};
    const Json& traffic = json.at("traffic");
    plan.traffic = {traffic.at("bytes_read"), traffic.at("bytes_written"), traffic.at("pixels")};
    return plan;
  }

 private:
  template <typename Decl>
  static std::uint32_t find(const std::vector<Decl>& decls, const std::string& name) {
    const auto found = std::ranges::find(decls, name, &Decl::name);
    if (found == decls.end()) throw std::invalid_argument("the graph declares no '" + name + "'");
    return static_cast<std::uint32_t>(found - decls.begin());
  }

  void readResource(const Json& json, Plan& plan) const {
    PlannedResource& planned = plan.resources[find(graph_.resources, json.at("name"))];
    planned.used = json.at("used");
    planned.imageUsage = json.at("image_usage");
    planned.bufferUsage = json.at("buffer_usage");
    planned.firstUse = noneOrIndex(json.at("first_use"));
    planned.lastUse = noneOrIndex(json.at("last_use"));
    planned.heap = noneOrIndex(json.at("heap"));
    planned.offset = json.at("offset");
    planned.size = json.at("bytes");
    planned.alignment = json.at("alignment");
    planned.memoryTypeBits = json.at("memory_type_bits");
  }

  void readBarrier(const Json& json, Plan& plan) const {
    PlannedBarrier barrier;
    barrier.resource = find(graph_.resources, json.at("resource"));
    barrier.reason = json.at("reason").get<BarrierReason>();
    barrier.srcStage = json.at("src_stage");
    barrier.srcAccess = json.at("src_access");
    barrier.dstStage = json.at("dst_stage");
    barrier.dstAccess = json.at("dst_access");
    barrier.oldLayout = json.at("old_layout").get<VkImageLayout>();
    barrier.newLayout = json.at("new_layout").get<VkImageLayout>();
    const Json& range = json.at("range");
    barrier.range = {range.at(0), range.at(1), range.at(2), range.at(3)};
    if (!json.at("alias_of").is_null()) barrier.aliasOf = find(graph_.resources, json.at("alias_of"));
    if (json.at("before").is_null()) {
      plan.releases.push_back(barrier);
      return;
    }
    const std::uint32_t pass = find(graph_.passes, json.at("before"));
    const auto planned = std::ranges::find(plan.passes, pass, &PlannedPass::pass);
    if (planned == plan.passes.end()) {
      throw std::invalid_argument("a barrier is recorded before '" + graph_.passes[pass].name +
                                  "', which is not executed");
    }
    planned->barriers.push_back(barrier);
  }

  const GraphDesc& graph_;
};

}  // namespace

std::string toJson(const GraphDesc& graph, const Plan& plan) {
  return JsonWriter(graph, plan).run();
}

Plan planFromJson(const GraphDesc& graph, std::string_view json) {
  try {
    return JsonReader(graph).run(Json::parse(json));
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument(std::string("not a plan as JSON: ") + error.what());
  }
}

}  // namespace fg
