#include "integration/c_api/pass_list.h"

#include <algorithm>

#include "framegraph/declare/access.h"
#include "integration/c_api/error.h"

namespace walr::api {
namespace {

static_assert(WALR_NONE == fg::kNone);

WalrResourceKind kindOf(fg::Lifetime lifetime) {
  switch (lifetime) {
    case fg::Lifetime::Transient:
      return WALR_RESOURCE_TRANSIENT;
    case fg::Lifetime::HistoryPrevious:
      return WALR_RESOURCE_HISTORY_PREVIOUS;
    case fg::Lifetime::HistoryCurrent:
      return WALR_RESOURCE_HISTORY_CURRENT;
    case fg::Lifetime::Upload:
      return WALR_RESOURCE_UPLOAD;
    case fg::Lifetime::Imported:
      break;
  }
  return WALR_RESOURCE_HOST;
}

std::uint32_t partnerOf(const fg::GraphDesc& graph, std::uint32_t index) {
  const std::uint32_t history = graph.resources[index].history;
  if (history == fg::kNone) return WALR_NONE;
  const fg::HistoryDecl& decl = graph.histories[history];
  return decl.previous == index ? decl.current : decl.previous;
}

/// The state of a resource, which has one mip level and layer as all of walr's have; zero if it is not used.
WalrImageState onlyState(const std::vector<fg::ExternalState>& states) {
  if (states.empty()) return {};
  if (states.size() > 1) throw Error(WALR_ERROR_INTERNAL, "a resource of a pass list has several mip levels or layers");
  return {states.front().stage, states.front().access, states.front().layout, 0};
}

}  // namespace

PassList::PassList(const fg::GraphDesc& graph, const fg::Plan& plan, std::span<const StagePort> ports,
                   const Options& options)
    : options_(options) {
  const std::vector<fg::FrameBorder> borders = fg::frameBorders(graph, plan);
  for (std::uint32_t i = 0; i < graph.resources.size(); ++i) addResource(graph, plan, borders[i], i);
  for (const fg::PlannedPass& planned : plan.passes) addPass(graph, planned);
  if (options_.heaps) {
    for (const fg::PlannedHeap& heap : plan.heaps) heaps_.push_back({heap.size, heap.memoryTypeBits, 0});
  }
  for (const WalrResource& resource : resources_) resourceList_.push_back(&resource);
  for (const WalrDispatch& dispatch : dispatches_) dispatchList_.push_back(&dispatch);
  list_.struct_size = sizeof(list_);
  list_.resource_count = static_cast<std::uint32_t>(resourceList_.size());
  list_.resources = resourceList_.data();
  list_.passes = dispatchList_.data();
  list_.pass_count = static_cast<std::uint32_t>(dispatchList_.size());
  const std::span<const WalrBarrier> releases = addBarriers(plan.releases);
  list_.releases = releases.data();
  list_.release_count = static_cast<std::uint32_t>(releases.size());
  list_.heaps = heaps_.data();
  list_.heap_count = static_cast<std::uint32_t>(heaps_.size());
  for (const StagePort& port : ports) {
    ports_.push_back({port.name.c_str(), port.resource, port.output ? VK_TRUE : VK_FALSE});
  }
  list_.ports = ports_.data();
  list_.port_count = static_cast<std::uint32_t>(ports_.size());
}

bool PassList::ofLibrary(std::uint32_t resource) const {
  return std::ranges::find(options_.libraryBuffers, resource) != options_.libraryBuffers.end();
}

void PassList::addResource(const fg::GraphDesc& graph, const fg::Plan& plan, const fg::FrameBorder& border,
                           std::uint32_t index) {
  const fg::ResourceDecl& decl = graph.resources[index];
  const fg::PlannedResource& planned = plan.resources[index];
  WalrResource& resource = resources_.emplace_back();
  resource.struct_size = sizeof(resource);
  resource.kind = ofLibrary(index) ? WALR_RESOURCE_LIBRARY : kindOf(decl.lifetime);
  resource.name = decl.name.c_str();
  resource.used = planned.used ? VK_TRUE : VK_FALSE;
  if (const auto* texture = std::get_if<fg::TextureDesc>(&decl.desc)) {
    resource.format = texture->format;
    resource.width = texture->extent.width;
    resource.height = texture->extent.height;
    resource.image_usage = planned.imageUsage;
  } else {
    resource.buffer = VK_TRUE;
    resource.buffer_usage = planned.bufferUsage;
    resource.buffer_size = std::get<fg::BufferDesc>(decl.desc).size;
  }
  resource.partner = partnerOf(graph, index);
  resource.memory_size = planned.size;
  resource.heap = options_.heaps ? planned.heap : WALR_NONE;
  resource.heap_offset = options_.heaps ? planned.offset : 0;
  if (resource.kind == WALR_RESOURCE_LIBRARY) return;
  resource.entry = onlyState(border.entry);
  resource.exit = onlyState(border.exit);
}

std::span<const WalrBarrier> PassList::addBarriers(const std::vector<fg::PlannedBarrier>& planned) {
  auto& barriers = barriers_.emplace_back();
  for (const fg::PlannedBarrier& barrier : planned) {
    if (ofLibrary(barrier.resource)) continue;
    barriers.push_back({.resource = barrier.resource,
                        .alias_of = options_.heaps ? barrier.aliasOf : WALR_NONE,
                        .src_stage = barrier.srcStage,
                        .src_access = barrier.srcAccess,
                        .dst_stage = barrier.dstStage,
                        .dst_access = barrier.dstAccess,
                        .old_layout = barrier.oldLayout,
                        .new_layout = barrier.newLayout});
  }
  return barriers;
}

const WalrBinding* const* PassList::addBindings(const fg::PassDecl& pass, const fg::Shader& shader) {
  auto& list = bindingLists_.emplace_back();
  const fg::Buffer indirect = std::get<fg::ComputeDispatch>(pass.work).indirect;
  for (const fg::ShaderBinding& variable : shader.bindings) {
    const auto access = std::ranges::find(pass.accesses, variable.name, &fg::AccessDecl::binding);
    if (access == pass.accesses.end()) {
      throw Error(WALR_ERROR_INTERNAL,
                  "pass '" + pass.name + "' binds nothing to '" + std::string(variable.name) + "'");
    }
    const fg::AccessInfo& info = fg::accessInfo(access->access);
    WalrBinding& binding = bindings_.emplace_back();
    binding.struct_size = sizeof(binding);
    binding.binding = variable.binding;
    binding.name = texts_.emplace_back(variable.name).c_str();
    binding.type = variable.type;
    binding.resource = access->resource;
    binding.stage = info.stage;
    binding.access = info.mask();
    binding.layout = info.layout;
    binding.filter = access->filter;
    // With this, hosts that derive barriers from bindings need no special case for indirect dispatches.
    if (indirect.valid() && indirect.resource == access->resource) {
      const fg::AccessInfo& arguments = fg::accessInfo(fg::Access::IndirectRead);
      binding.stage |= arguments.stage;
      binding.access |= arguments.mask();
    }
    list.push_back(&binding);
  }
  return list.data();
}

void PassList::addPass(const fg::GraphDesc& graph, const fg::PlannedPass& planned) {
  const fg::PassDecl& pass = graph.passes[planned.pass];
  const auto* work = std::get_if<fg::ComputeDispatch>(&pass.work);
  if (work == nullptr) throw Error(WALR_ERROR_INTERNAL, "pass '" + pass.name + "' is not a compute dispatch");
  const fg::Shader& shader = *work->shader;

  auto& specializations = specializations_.emplace_back();
  for (std::size_t i = 0; i < shader.constants.size(); ++i) {
    specializations.push_back({shader.constants[i].id, work->specialization[i]});
  }
  auto& ages = historyAges_.emplace_back();
  for (const fg::HistoryAgeConstant& age : work->historyAges) {
    ages.push_back({graph.histories[age.history].previous, age.offset});
  }

  const WalrBinding* const* bindings = addBindings(pass, shader);
  WalrDispatch& dispatch = dispatches_.emplace_back();
  dispatch.struct_size = sizeof(dispatch);
  dispatch.binding_count = static_cast<std::uint32_t>(shader.bindings.size());
  dispatch.name = pass.name.c_str();
  dispatch.shader = texts_.emplace_back(shader.name).c_str();
  dispatch.spirv = shader.code.data();
  dispatch.spirv_size = shader.code.size_bytes();
  dispatch.bindings = bindings;
  dispatch.specializations = specializations.data();
  dispatch.specialization_count = static_cast<std::uint32_t>(specializations.size());
  dispatch.push_constants = work->constants.data();
  dispatch.push_constant_size = static_cast<std::uint32_t>(work->constants.size());
  dispatch.history_ages = ages.data();
  dispatch.history_age_count = static_cast<std::uint32_t>(ages.size());
  const std::span<const WalrBarrier> barriers = addBarriers(planned.barriers);
  dispatch.barriers = barriers.data();
  dispatch.barrier_count = static_cast<std::uint32_t>(barriers.size());
  std::ranges::copy(work->groups, dispatch.group_count);
  dispatch.indirect = work->indirect.resource;
  dispatch.indirect_offset = work->indirectOffset;
}

}  // namespace walr::api
