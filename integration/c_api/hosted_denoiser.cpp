#include "integration/c_api/hosted_denoiser.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <glm/gtc/type_ptr.hpp>

#include "framegraph/declare/same_topology.h"
#include "framegraph/vulkan/driver_memory_model.h"
#include "framegraph/vulkan/physical_device.h"
#include "framegraph/vulkan/resources.h"
#include "integration/c_api/structs.h"

namespace walr::api {
namespace {

WalrMemory memoryOf(const fg::MemoryReport& report, std::uint64_t allocated) {
  return {.struct_size = 0,
          .reserved = 0,
          .allocated = allocated,
          .persistent = report.persistentBytes,
          .transient = report.transientPeakBytes,
          .transient_unaliased = report.transientUnaliasedBytes,
          .transient_least = report.transientLowerBoundBytes,
          .retired = 0,
          .shared = 0};
}

}  // namespace

std::shared_ptr<HostedDenoiser::Shared> HostedDenoiser::sharedObjects(const WalrDenoiserInfo& info,
                                                                      const HostedDenoiser* sharedWith) {
  if (sharedWith == nullptr) return std::make_shared<Shared>(info.device, info.pipeline_cache);
  const WalrDevice given = readStruct(info.device, "WalrDevice");
  const fg::vk::DeviceView& view = sharedWith->device().context().view;
  if (given.device != view.device || given.queue_family != view.queueFamily) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT,
                "WalrDenoiserInfo::shared_with has another device or queue family: denoisers share objects on one "
                "device only");
  }
  return sharedWith->shared_;
}

HostedDenoiser::HostedDenoiser(const WalrDenoiserInfo& info, const HostedDenoiser* sharedWith)
    : shared_(sharedObjects(info, sharedWith)),
      member_(shared_->objects.addMember()),
      description_(info),
      completions_(device().context(), description_.slots()),
      timestamps_(measuresTimes(info, device())),
      lint_(info.lint == VK_TRUE),
      counters_(info.counters == VK_TRUE),
      log_(info.log),
      logUser_(info.log_user) {
  device().requireResultFormat(description_.resultFormat());
  // An output or a light that the method does not have is refused here and not in the first frame.
  if (info.history_length == VK_TRUE || info.light_direction == VK_TRUE || info.expected_error == VK_TRUE ||
      description_.hasSpecularLight()) {
    (void)declareGraph(std::nullopt);
  }
}

void HostedDenoiser::log(WalrLogLevel level, const std::string& text) const {
  if (log_ != nullptr) log_(logUser_, level, text.c_str());
}

void HostedDenoiser::resize(std::uint32_t width, std::uint32_t height) {
  description_.resize(width, height);
  stale_ = true;
}

void HostedDenoiser::set(std::string_view name, std::string_view value) {
  description_.set(name, value);
  stale_ = true;
}

void HostedDenoiser::usePreset(std::string_view name) {
  description_.usePreset(name);
  stale_ = true;
}

void HostedDenoiser::setView(std::optional<std::string> name) {
  if (name) (void)declareGraph(name);
  view_ = std::move(name);
  stale_ = true;
}

DenoiseGraph HostedDenoiser::declareGraph(const std::optional<std::string>& view) const {
  const std::span views = view ? std::span(&*view, 1) : std::span<const std::string>();
  return description_.declare({.views = views, .counters = counters_, .lint = lint_});
}

const HostedDenoiser::Declared& HostedDenoiser::declare() {
  if (!stale_) return *declared_;
  DenoiseGraph graph = declareGraph(view_);
  const auto has = [&](const std::shared_ptr<Declared>& other) {
    return other && fg::sameTopology(other->graph.graph.desc(), graph.graph.desc());
  };
  // The host may go back to what is built, where there was no memory for something else.
  if (!has(declared_) && built_ && has(built_->declared)) declared_ = built_->declared;
  if (has(declared_)) {
    declared_->graph = std::move(graph);
    updates_ = true;
  } else {
    declared_ = std::make_shared<Declared>(compile(std::move(graph)));
  }
  stale_ = false;
  return *declared_;
}

HostedDenoiser::Declared HostedDenoiser::compile(DenoiseGraph graph) const {
  Declared declared;
  declared.graph = std::move(graph);
  // Report all formats that the device lacks at once, before memory requirements are queried.
  const fg::Plan portable = compilePlan(declared.graph.graph, fg::TableMemoryModel());
  fg::vk::require(device().physical(), fg::vk::formatUses(declared.graph.graph.desc(), portable));
  declared.plan = compilePlan(declared.graph.graph, fg::vk::DriverMemoryModel(device().context()));

  for (std::size_t i = 0; i < kImageCount; ++i) {
    declared.images[i] = imageSlots().at(i).textureOf(declared.graph);
    if (!declared.images[i].valid()) continue;  // The host has none.
    const fg::PlannedResource& planned = declared.plan.resources[declared.images[i].resource];
    declared.needs[i] = {.used = planned.used,
                         .format = declared.graph.graph.textureDesc(declared.images[i]).format,
                         .usage = planned.imageUsage,
                         .extent = declared.graph.graph.textureDesc(declared.images[i]).extent};
  }
  return declared;
}

void HostedDenoiser::build() {
  declare();
  if (!built_ || built_->declared != declared_) {
    makeExecutor();
  } else if (updates_) {
    built_->executor->update(declared_->graph.graph.desc());
  }
  updates_ = false;
}

/// Replace what is built, which stays if there is no memory for another one.
void HostedDenoiser::makeExecutor() {
  if (built_ && !built_->lastFrame) {  // It is in no frame, so that its memory can be had. The one before comes back.
    built_.reset();
    if (!retired_.empty()) {
      built_ = std::move(retired_.back());
      retired_.pop_back();
    }
  }
  const fg::Extent extent = description_.extent();
  const Built* const before = built_ ? &*built_ : nullptr;
  const bool inherits = before != nullptr && (description_.rectangle() || before->extent == extent);
  const fg::vk::ExecutorOptions options{
      .framesInFlight = description_.slots(),
      .timestamps = timestamps_,
      .shared = {std::shared_ptr<fg::vk::SharedObjects>(shared_, &shared_->objects), member_},
      .predecessor = before != nullptr ? before->executor.get() : nullptr,
      .inheritHistories = inherits};
  Built made{.declared = declared_,
             .executor = std::make_unique<fg::vk::Executor>(device().context(), declared_->graph.graph.desc(),
                                                            declared_->plan, options),
             .counters = nullptr,
             .lint = nullptr,
             .memory = declared_->plan.memory,
             .extent = extent,
             .inherits = inherits,
             .lastFrame = std::nullopt,
             .times = {}};
  if (lint_) {
    const fg::Buffer counters = declared_->graph.lint;
    made.lint = inherits ? before->lint
                         : std::make_shared<HostedLint>(device().context(), made.executor->usage(counters),
                                                        description_.inputConventions(), description_.slots());
    made.executor->bind(counters, made.lint->buffer().handle());
  }
  if (const Inspection& inspection = declared_->graph.inspection; !inspection.counters().empty()) {
    const fg::Buffer buffer = inspection.counterBuffer();
    made.counters = std::make_unique<HostedCounters>(device().context(), made.executor->usage(buffer),
                                                     inspection.counters(), description_.slots());
    made.executor->bind(buffer, made.counters->buffer().handle());
  }
  // Frames in flight may use it, and the next frame its histories.
  if (built_) retired_.push_back(std::move(*built_));
  built_ = std::move(made);
  log(WALR_LOG_INFO, description_.methodName() + " at " + std::to_string(extent.width) + " x " +
                         std::to_string(extent.height) + ": " + std::to_string(declared_->plan.passes.size()) +
                         " passes, " + std::to_string(built_->allocatedBytes()) + " bytes of device memory");
}

void HostedDenoiser::prepare() {
  build();
}

/// The `Built` that recorded the last frame, if the next frame reads its histories.
HostedDenoiser::Built* HostedDenoiser::predecessor() {
  const bool needed = built_ && built_->inherits && !built_->lastFrame;
  return needed && !retired_.empty() ? &retired_.back() : nullptr;
}

/// Destroy what finished frames used: the host has waited for the frame that is `frames_in_flight` before the next one.
void HostedDenoiser::dropFinished() {
  const auto end = predecessor() != nullptr ? std::prev(retired_.end()) : retired_.end();
  const auto finished = [&](const Built& built) {
    return *built.lastFrame + description_.slots() <= description_.frames();
  };
  retired_.erase(std::remove_if(retired_.begin(), end, finished), end);
}

WalrImageRequirements HostedDenoiser::requirements(std::string_view image) {
  const ImageNeeds& needs = declare().needs[imageIndex(image)];
  return {.struct_size = 0,
          .required = needs.used ? VK_TRUE : VK_FALSE,
          .format = needs.format,
          .usage = needs.usage,
          .width = needs.extent.width,
          .height = needs.extent.height};
}

FrameImages HostedDenoiser::checkedImages(const WalrFrame& frame) const {
  FrameImages images{};
  for (std::size_t i = 0; i < kImageCount; ++i) {
    const ImageSlot& slot = imageSlots().at(i);
    const WalrImage* const given = frame.*slot.given;
    const bool required = slot.ofLight == &LightImages::lighting || slot.ofLight == &LightImages::output;
    if (given != nullptr && required && slot.light >= description_.lightCount()) {
      throw Error(WALR_ERROR_INVALID_ARGUMENT,
                  "WalrFrame has the image '" + slot.name() + "', but the denoiser is for " +
                      std::to_string(description_.lightCount()) + " light: create it with " +
                      "WalrDenoiserInfo::light_count of " + std::to_string(slot.light + 1));
    }
    if (given != nullptr && i < kHostInputs.size() && kHostInputs.at(i).of == HostInput::Of::SpecularLight &&
        !description_.hasSpecularLight()) {
      throw Error(WALR_ERROR_INVALID_ARGUMENT, "WalrFrame has the image '" + slot.name() +
                                                   "', but no light is specular: create the denoiser with " +
                                                   "WalrDenoiserInfo::light_kind of WALR_LIGHT_SPECULAR");
    }
    ImageNeeds needs = declared_->needs[i];
    if (given != nullptr && !needs.used && slot.role == ImageRole::Inspection) {
      throw Error(WALR_ERROR_INVALID_ARGUMENT,
                  "WalrFrame has the image '" + slot.name() +
                      "', which the denoiser does not write: ask for it in WalrDenoiserInfo, or for a view with "
                      "walr_set_view, or give null");
    }
    if (description_.rectangle() && slot.role != ImageRole::Inspection)
      needs.offset = {frame.offset[0], frame.offset[1]};
    images[i] = checkedImage(i, given, needs, device().context().view.queueFamily);
  }
  markRepeated(images);
  return images;
}

void HostedDenoiser::bind(const FrameImages& images) {
  for (std::size_t i = 0; i < kImageCount; ++i) {
    if (!images[i].given) continue;
    built_->executor->bind(declared_->images[i], {images[i].image.image, images[i].image.identity});
  }
}

void HostedDenoiser::uploadIfUsed(fg::Buffer buffer, std::span<const std::byte> bytes) {
  if (buffer.valid() && declared_->plan.resources[buffer.resource].used) built_->executor->upload(buffer, bytes);
}

void HostedDenoiser::record(VkCommandBuffer commandBuffer, const WalrFrame& frame) {
  if (commandBuffer == VK_NULL_HANDLE) throw Error(WALR_ERROR_INVALID_ARGUMENT, "the command buffer is null");
  checkFlags(frame.flags, WALR_FRAME_RESET_HISTORY | WALR_FRAME_INDEX_GIVEN, "WalrFrame::flags");
  const FrameStatement statement = statementOf(frame);
  const Constants constants = description_.constants(statement);
  declare();
  const FrameImages images = checkedImages(frame);
  const fg::vk::TimelinePoint finished = device().finishedPoint(frame.finished, frame.finished_value);
  completions_.require(description_.slot(), description_.frames(), finished);
  dropFinished();
  build();
  bind(images);

  uploadIfUsed(declared_->graph.inputs.frame, std::as_bytes(std::span(&constants.frame, 1)));
  uploadIfUsed(declared_->graph.host, std::as_bytes(std::span(&constants.host, 1)));
  const bool reset = resetRequested_ || (frame.flags & WALR_FRAME_RESET_HISTORY) != 0;
  if (reset) built_->executor->resetAllHistory();
  evaluateFinishedFrame();
  recordAcquire(device().context(), commandBuffer, images);
  recordGraph(commandBuffer, constants.camera, reset);
  recordRelease(device().context(), commandBuffer, images);

  if (Built* const before = predecessor()) before->lastFrame = description_.frames();
  resetRequested_ = false;
  lastImages_ = images;
  built_->lastFrame = description_.frames();
  completions_.note(description_.slot(), description_.frames(), finished);
  description_.advance(statement);
}

void HostedDenoiser::recordGraph(VkCommandBuffer commandBuffer, const FrameDescription& camera, bool reset) {
  const std::uint32_t slot = description_.slot();
  if (built_->counters) built_->counters->buffer().recordBefore(commandBuffer);
  if (lint_) built_->lint->buffer().recordBefore(commandBuffer);
  built_->executor->record(commandBuffer, slot);
  if (built_->counters) built_->counters->recordAfter(commandBuffer, slot);
  if (!lint_) return;
  const bool continues = !reset && (built_->lastFrame || built_->inherits);
  built_->lint->recordAfter(commandBuffer, slot, {camera, description_.extent(), continues});
}

/// Read times and counts of the frame that used the slot of the next one: the host has waited for it.
void HostedDenoiser::evaluateFinishedFrame() {
  if (const auto times = built_->executor->passTimes(description_.slot()); !times.empty()) built_->times = times;
  if (built_->counters) built_->counters->collect(description_.slot());
  if (!lint_) return;
  for (const LintFinding& finding : built_->lint->collect(description_.slot())) {
    log(WALR_LOG_WARNING, finding.text());
  }
}

std::span<const LintFinding> HostedDenoiser::findings() const {
  if (!lint_) {
    throw Error(WALR_ERROR_WRONG_ORDER, "inputs are not checked: create the denoiser with WalrDenoiserInfo::lint");
  }
  return built_ ? std::span(built_->lint->findings()) : std::span<const LintFinding>();
}

std::vector<WalrCounter> HostedDenoiser::counters() const {
  if (!counters_ && !lint_) {
    throw Error(WALR_ERROR_WRONG_ORDER,
                "nothing is counted: create the denoiser with WalrDenoiserInfo::counters or WalrDenoiserInfo::lint");
  }
  std::vector<WalrCounter> counters;
  if (built_ && built_->counters) counters = built_->counters->values();
  if (built_ && lint_) counters.insert(counters.end(), built_->lint->counts().begin(), built_->lint->counts().end());
  return counters;
}

void HostedDenoiser::forget(VkImage image, std::uint64_t identity) {
  if (image == VK_NULL_HANDLE) throw Error(WALR_ERROR_INVALID_ARGUMENT, "the image is null");
  if (built_) built_->executor->forget({image, identity});
  for (const Built& built : retired_) built.executor->forget({image, identity});
}

WalrImageState HostedDenoiser::releaseState(std::string_view image) const {
  const FrameImage& last = lastImages_[imageIndex(image)];
  if (last.given) return last.image.release;
  throw Error(WALR_ERROR_WRONG_ORDER, "no frame has used image '" + std::string(image) + "' yet");
}

std::uint64_t HostedDenoiser::Built::allocatedBytes(bool withLint) const {
  return executor->allocatedBytes() + (counters != nullptr ? counters->buffer().allocatedBytes() : 0) +
         (withLint && lint != nullptr ? lint->buffer().allocatedBytes() : 0);
}

WalrMemory HostedDenoiser::memory() const {
  if (!built_) throw Error(WALR_ERROR_WRONG_ORDER, "no memory is allocated yet: call walr_prepare before");
  WalrMemory memory = memoryOf(built_->memory, built_->allocatedBytes());
  memory.shared = built_->executor->sharedBytes();
  for (const Built& built : retired_) memory.retired += built.allocatedBytes(built.lint != built_->lint);
  return memory;
}

WalrMemory HostedDenoiser::requiredMemory() {
  const Declared& declared = declare();
  const fg::GraphDesc& graph = declared.graph.graph.desc();
  std::uint64_t bytes = fg::vk::requiredBytes(device().context(), graph, declared.plan, description_.slots());
  const auto addCounts = [&](fg::Buffer counts, std::uint64_t size) {
    const fg::PlannedResource& planned = declared.plan.resources[counts.resource];
    bytes += CountBuffer::requiredBytes(device().context(), size, planned.bufferUsage, description_.slots());
  };
  if (lint_) addCounts(declared.graph.lint, kLintBytes);
  if (!declared.graph.inspection.counters().empty()) {
    addCounts(declared.graph.inspection.counterBuffer(), kCounterBytes);
  }
  return memoryOf(declared.plan.memory, bytes);
}

std::span<const fg::vk::PassTime> HostedDenoiser::timings() const {
  return built_ ? built_->times : std::span<const fg::vk::PassTime>();
}

}  // namespace walr::api
