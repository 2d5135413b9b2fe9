#include "framegraph/vulkan/executor.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "framegraph/declare/same_topology.h"
#include "framegraph/vulkan/barriers.h"
#include "framegraph/vulkan/completions.h"
#include "framegraph/vulkan/error.h"
#include "framegraph/vulkan/inherited_histories.h"
#include "framegraph/vulkan/memory_barrier.h"
#include "framegraph/vulkan/pass_recorder.h"
#include "framegraph/vulkan/uploads.h"

namespace fg::vk {
namespace {

std::uint32_t checkedSlots(const ExecutorOptions& options) {
  if (options.framesInFlight == 0) throw std::invalid_argument("ExecutorOptions::framesInFlight must be at least 1");
  return options.framesInFlight;
}

std::optional<Timestamps> makeTimestamps(const DeviceContext& device, const GraphDesc& graph, const Plan& plan,
                                         const ExecutorOptions& options) {
  if (!options.timestamps) return std::nullopt;
  return Timestamps(device, graph, plan, options.framesInFlight);
}

std::shared_ptr<Pipelines> makePipelines(const DeviceContext& device, const ExecutorOptions& options,
                                         const std::shared_ptr<Pipelines>& before) {
  const std::shared_ptr<SharedObjects>& shared = options.shared.objects;
  if (shared != nullptr) return {shared, &shared->pipelines()};
  if (before != nullptr) return before;
  return options.pipelines != nullptr ? options.pipelines : std::make_shared<Pipelines>(device, options.pipelineCache);
}

/// A host's image or buffer that is bound to an import.
struct Bound {
  std::uint64_t handle = 0;
  std::uint64_t identity = 0;
  friend bool operator==(const Bound&, const Bound&) = default;
};

Bound boundImage(const ExternalImage& image) {
  const auto handle = reinterpret_cast<std::uint64_t>(image.image);
  return {handle, image.identity != 0 ? image.identity : handle};
}

}  // namespace

struct Executor::State {
  /// @param before the predecessor, or null
  State(const DeviceContext& contextOfDevice, GraphDesc&& declared, Plan&& compiled, const ExecutorOptions& options,
        const State* before)
      : device(contextOfDevice),
        graph(std::move(declared)),
        plan(std::move(compiled)),
        slots(checkedSlots(options)),
        resources(device, graph, plan, slots, options.poison, options.shared),
        uploads(graph, plan, slots),
        views(device, graph, resources),
        pipelines(makePipelines(device, options, before != nullptr ? before->pipelines : nullptr)),
        passes(device, graph, plan, resources, views, *pipelines, slots,
               {.poison = options.poison, .inheritsHistories = before != nullptr && options.inheritHistories}),
        histories(graph, plan),
        releases(graph, plan.releases),
        timestamps(makeTimestamps(device, graph, plan, options)),
        completions(device, slots),
        bound(graph.resources.size()) {
    if (before != nullptr && options.inheritHistories) inheritHistories(*before);
  }

  /// Let the first frame read the histories that the last frame of `before` wrote.
  void inheritHistories(const State& before) {
    if (before.frames == 0) return;
    std::vector<InheritedHistory> taken = inheritedHistories(graph, plan, before.graph, before.plan);
    std::erase_if(taken, [&](const InheritedHistory& each) { return !before.histories.status(each.before).valid; });
    for (const InheritedHistory& each : taken) {
      const std::uint32_t previous = graph.histories[each.history].previous;
      const VkImage image = before.resources.image(before.graph.histories[each.before].current, before.frame);
      inherited.push_back({previous, resources.exchange(previous, nextParity, image)});
      views.replace(previous, nextParity, image);
      histories.inherit(each.history, before.histories.status(each.before).age);
    }
    takeOver = BarrierBatch(graph, takeOverBarriers(graph, plan, before.plan, taken));
  }

  /// Bind this executor's own images again. Call it after the first frame, which reads the inherited ones, is recorded.
  void dropInherited() {
    if (inherited.empty()) return;
    for (const Inherited& history : inherited) {
      resources.exchange(history.previous, frame.parity, history.own);
      views.restore(history.previous, frame.parity);
    }
    inherited.clear();
    passes.invalidateImages();
  }

  /// The frames before, of other executors, may have used the memory of this one's transients. Each transient starts
  /// from UNDEFINED, so that only their writes must be over.
  void recordMemoryHandOver(VkCommandBuffer commandBuffer) const {
    recordMemoryBarrier(
        device, commandBuffer, {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT},
        {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT});
  }

  void requireDeclared(ResourceVersion handle, const char* call) const {
    if (handle.resource < graph.resources.size()) return;
    throw std::invalid_argument(std::string(call) + ": the executor's graph declares no such resource");
  }

  void requireDeclared(const History& history, const char* call) const {
    if (history.index < graph.histories.size()) return;
    throw std::invalid_argument(std::string(call) + ": the executor's graph declares no such history");
  }

  void requireSlot(std::uint32_t slot) const {
    if (slot < slots) return;
    throw std::out_of_range("frame slot " + std::to_string(slot) + " of " + std::to_string(slots));
  }

  void requireImport(ResourceVersion handle) const {
    if (handle.resource < graph.resources.size() && graph.resources[handle.resource].lifetime == Lifetime::Imported) {
      return;
    }
    throw std::invalid_argument("bind: the resource was not declared with Graph::import");
  }

  /// @throws std::invalid_argument if nothing or this cannot be bound
  void requireBindable(ResourceVersion handle, const Bound& now) const {
    requireImport(handle);
    if (now.handle == 0) {
      throw std::invalid_argument("bind: a null handle for '" + graph.resources[handle.resource].name + "'");
    }
  }

  void noteBound(ResourceVersion handle, const Bound& now) {
    bound[handle.resource] = now;
    passes.invalidateImages();
  }

  void requireBound() const {
    for (std::size_t i = 0; i < bound.size(); ++i) {
      const ResourceDecl& decl = graph.resources[i];
      if (decl.lifetime != Lifetime::Imported || !plan.resources[i].used || bound[i].handle != 0) continue;
      throw Error("nothing is bound to import '" + decl.name + "': call Executor::bind before recording");
    }
  }

  const DeviceContext& device;
  GraphDesc graph;
  const Plan plan;
  const std::uint32_t slots;
  FrameIndex frame;  ///< The frame recorded last.
  std::uint32_t nextParity = 0;
  std::uint64_t frames = 0;  ///< Recorded so far.
  Resources resources;
  Uploads uploads;
  Views views;
  std::shared_ptr<Pipelines> pipelines;
  PassRecorder passes;
  HistoryStates histories;
  BarrierBatch releases;
  std::optional<Timestamps> timestamps;
  Completions completions;
  std::vector<Bound> bound;  ///< By resource.
  struct Inherited {
    std::uint32_t previous = kNone;
    VkImage own = VK_NULL_HANDLE;  ///< Replaced by the inherited one for one frame.
  };
  std::vector<Inherited> inherited;  ///< Empty after the first frame.
  BarrierBatch takeOver;             ///< For inherited images, before the first frame.
};

Executor::Executor(const DeviceContext& device, GraphDesc graph, Plan plan, const ExecutorOptions& options) {
  const State* const before = options.predecessor != nullptr ? options.predecessor->state_.get() : nullptr;
  state_ = std::make_unique<State>(device, std::move(graph), std::move(plan), options, before);
}
Executor::~Executor() = default;
Executor::Executor(Executor&&) noexcept = default;
Executor& Executor::operator=(Executor&&) noexcept = default;

void Executor::upload(Buffer buffer, std::span<const std::byte> bytes) {
  state_->uploads.set(buffer.resource, bytes);
}

void Executor::bind(Texture texture, const ExternalImage& image) {
  const Bound now = boundImage(image);
  state_->requireBindable(texture, now);
  if (state_->bound[texture.resource] == now) return;
  state_->views.import(texture.resource, image.image, now.identity);  // First: nothing has changed if it throws.
  state_->resources.import(texture.resource, image.image);
  state_->noteBound(texture, now);
}

void Executor::bind(Buffer buffer, VkBuffer handle) {
  const Bound now{reinterpret_cast<std::uint64_t>(handle), 0};
  // Also if the handle is the same: it may be that of a new buffer in the place of one that was destroyed.
  state_->requireBindable(buffer, now);
  state_->resources.import(buffer.resource, handle);
  state_->noteBound(buffer, now);
}

void Executor::forget(const ExternalImage& image) {
  const Bound gone = boundImage(image);
  state_->views.forget(gone.identity);
  std::ranges::replace(state_->bound, gone, Bound{});
}

VkImageUsageFlags Executor::usage(Texture texture) const {
  state_->requireDeclared(texture, "usage");
  return state_->plan.resources[texture.resource].imageUsage;
}

VkBufferUsageFlags Executor::usage(Buffer buffer) const {
  state_->requireDeclared(buffer, "usage");
  return state_->plan.resources[buffer.resource].bufferUsage;
}

void Executor::update(const GraphDesc& graph) {
  if (!sameTopology(state_->graph, graph)) {
    throw std::invalid_argument(
        "update: the graph has other passes, resources or accesses than the executor was made for; compile it and make "
        "an executor for it");
  }
  state_->passes.update(graph);
  for (std::size_t i = 0; i < graph.passes.size(); ++i) state_->graph.passes[i].work = graph.passes[i].work;
}

void Executor::replaceCode(const Shader& shader, std::vector<std::uint32_t> code) {
  state_->pipelines->replaceCode(shader, std::move(code));
  state_->passes.update(state_->graph);
}

void Executor::record(VkCommandBuffer commandBuffer, std::uint32_t slot, const TimelinePoint& finished) {
  State& state = *state_;
  state.requireSlot(slot);
  state.requireBound();
  state.completions.require(slot, state.frames, finished);
  const bool first = state.frames == 0;
  if (!first) state.dropInherited();
  state.frame = {slot, state.nextParity};
  state.uploads.copyTo(state.resources, slot);
  if (state.timestamps) state.timestamps->begin(commandBuffer, slot);
  if (first) state.takeOver.record(state.device, commandBuffer, state.resources, state.frame);
  if (state.resources.sharedBytes() > 0) state.recordMemoryHandOver(commandBuffer);
  state.histories.recordClears(state.device, commandBuffer, state.resources, state.frame);
  state.passes.record(commandBuffer, state.frame, state.histories, state.timestamps ? &*state.timestamps : nullptr);
  state.releases.record(state.device, commandBuffer, state.resources, state.frame);
  state.histories.advance();
  state.nextParity = 1 - state.nextParity;
  state.completions.note(slot, state.frames, finished);
  ++state.frames;
}

void Executor::resetHistory(const History& history) {
  state_->requireDeclared(history, "resetHistory");
  state_->histories.reset(history.index);
}

void Executor::resetAllHistory() {
  state_->histories.resetAll();
}

HistoryStatus Executor::historyStatus(const History& history) const {
  state_->requireDeclared(history, "historyStatus");
  return state_->histories.status(history.index);
}

VkImage Executor::image(Texture texture) const {
  state_->requireDeclared(texture, "image");
  return state_->resources.image(texture.resource, state_->frame);
}

VkBuffer Executor::buffer(Buffer buffer) const {
  state_->requireDeclared(buffer, "buffer");
  return state_->resources.buffer(buffer.resource, state_->frame);
}

std::span<const PassTime> Executor::passTimes(std::uint32_t slot) {
  state_->requireSlot(slot);
  if (!state_->timestamps) return {};
  return state_->timestamps->read(slot);
}

std::uint64_t Executor::allocatedBytes() const {
  return state_->resources.allocatedBytes();
}

std::uint64_t Executor::sharedBytes() const {
  return state_->resources.sharedBytes();
}

}  // namespace fg::vk
