#include "integration/c_api/hosted_passes.h"

#include <algorithm>
#include <string>
#include <utility>

#include <glm/gtc/type_ptr.hpp>

#include "framegraph/vulkan/driver_memory_model.h"
#include "framegraph/vulkan/inherited_histories.h"
#include "integration/c_api/structs.h"

namespace walr::api {

HostedPasses::HostedPasses(const WalrDenoiserInfo& info, std::span<const WalrSettingValue> settings,
                           std::span<const WalrPortFormat> ports)
    : description_(info, Description::Of::MethodsAndStages) {
  if (info.shared_with != nullptr) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT,
                "WalrDenoiserInfo::shared_with is for walr_create_denoiser: pass by pass, share memory and a pipeline "
                "cache yourself");
  }
  for (const WalrSettingValue& setting : settings) {
    description_.set(requireText(setting.name, "WalrSettingValue::name"),
                     requireText(setting.value, "WalrSettingValue::value"));
  }
  if (info.device != nullptr) device_ = std::make_unique<HostDevice>(info.device);
  graph_ = description_.list(ports, {.counters = info.counters == VK_TRUE, .lint = info.lint == VK_TRUE});
  // A host creates one image for each resource and swaps only those of histories, so transients cannot alias histories.
  constexpr fg::CompileOptions kOneImageEach = {.aliasHistories = false};
  plan_ = compilePlan(graph_.graph, fg::TableMemoryModel(), kOneImageEach);
  if (device_) {
    device_->requireResultFormat(description_.resultFormat());
    fg::vk::require(device_->physical(), fg::vk::formatUses(graph_.graph.desc(), plan_));
    plan_ = compilePlan(graph_.graph, fg::vk::DriverMemoryModel(device_->context()), kOneImageEach);
  }
  PassList::Options options{.heaps = device_ != nullptr};
  for (const fg::Buffer counts : {graph_.lint, graph_.inspection.counterBuffer()}) {
    if (counts.valid()) options.libraryBuffers.push_back(counts.resource);
  }
  list_.emplace(graph_.graph.desc(), plan_, graph_.ports, options);
  if (!device_) return;
  recording_.emplace(device_->context(), graph_.graph.desc(), plan_, list_->list(), description_.slots(),
                     info.pipeline_cache);
  completions_.emplace(device_->context(), description_.slots());
  if (measuresTimes(info, *device_)) timestamps_.emplace(device_->context(), list_->list(), description_.slots());
  makeCounts();
}

void HostedPasses::makeCounts() {
  const auto usage = [&](fg::Buffer counts) { return plan_.resources[counts.resource].bufferUsage; };
  if (const fg::Buffer counts = graph_.lint; counts.valid()) {
    lint_.emplace(device_->context(), usage(counts), description_.inputConventions(), description_.slots());
    recording_->bindLibraryBuffer(counts.resource, lint_->buffer().handle());
  }
  if (const fg::Buffer counts = graph_.inspection.counterBuffer(); !graph_.inspection.counters().empty()) {
    counters_.emplace(device_->context(), usage(counts), graph_.inspection.counters(), description_.slots());
    recording_->bindLibraryBuffer(counts.resource, counters_->buffer().handle());
  }
}

void HostedPasses::continueFrom(const HostedPasses& last) {
  if (description_.methodName() != last.description_.methodName()) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT, "the passes to continue from are those of method '" +
                                                 last.description_.methodName() +
                                                 "': create both with the same method and conventions");
  }
  if (description_.inputConventions().light != last.description_.inputConventions().light ||
      description_.orthographic() != last.description_.orthographic()) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT,
                "the passes to continue from have other pixels with samples, or another kind of camera: create both "
                "with the same WalrConventions::light_group, light_masked, light_counted and orthographic");
  }
  const std::vector<WalrLightKind>& kinds = description_.lightKinds();
  const std::vector<WalrLightKind>& before = last.description_.lightKinds();
  if (!std::equal(kinds.begin(), kinds.begin() + std::ptrdiff_t(std::min(kinds.size(), before.size())),
                  before.begin())) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT,
                "the passes to continue from are of another kind of light: create both with the same "
                "WalrDenoiserInfo::light_kind and second_light_kind");
  }
  const bool resizes = description_.rectangle() && last.description_.rectangle();
  if (!resizes && description_.extent() != last.description_.extent()) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT,
                "the passes have different sizes: create both with WalrConventions::rectangle");
  }
  if (last.description_.frames() == 0) {
    throw Error(WALR_ERROR_WRONG_ORDER, "the passes to continue from have had no frame: call walr_begin_frame on them");
  }
  description_.continueFrom(last.description_);
  if (recording_ && last.recording_) {
    const auto inherited = fg::vk::inheritedHistories(graph_.graph.desc(), plan_, last.graph_.graph.desc(), last.plan_);
    recording_->continueFrom(*last.recording_, inherited);
  }
  constants_.reset();
}

void HostedPasses::beginFrame(const WalrPassFrame& frame) {
  if ((frame.flags & WALR_FRAME_RESET_HISTORY) != 0) {
    throw Error(
        WALR_ERROR_INVALID_ARGUMENT,
        "WalrPassFrame::flags has WALR_FRAME_RESET_HISTORY, but the histories are the host's: give no image for "
        "the previous ones");
  }
  checkFlags(frame.flags, WALR_FRAME_INDEX_GIVEN, "WalrPassFrame::flags");
  const FrameStatement statement = statementOf(frame);
  const Constants constants = description_.constants(statement);
  if (recording_) {
    const fg::vk::TimelinePoint finished = device_->finishedPoint(frame.finished, frame.finished_value);
    completions_->require(description_.slot(), description_.frames(), finished);
    completions_->note(description_.slot(), description_.frames(), finished);
  }
  constants_ = constants;
  if (recording_) {
    recording_->begin(description_.frames());
    if (timestamps_) {
      if (auto times = timestamps_->read(recording_->slot()); !times.empty()) times_ = std::move(times);
      timestamps_->beginFrame(recording_->slot());
    }
    if (lint_) lint_->collect(recording_->slot());
    if (counters_) counters_->collect(recording_->slot());
    for (const std::uint32_t resource : recording_->frameUploads())
      recording_->upload(resource, frameConstants(resource));
  }
  description_.advance(statement);
}

std::span<const std::byte> HostedPasses::frameConstants(std::uint32_t resource) const {
  if (!constants_) throw Error(WALR_ERROR_WRONG_ORDER, "there is no frame yet: call walr_begin_frame before");
  if (graph_.frame.valid() && resource == graph_.frame.resource) return std::as_bytes(std::span(&constants_->frame, 1));
  if (graph_.host.valid() && resource == graph_.host.resource) return std::as_bytes(std::span(&constants_->host, 1));
  const std::vector<fg::ResourceDecl>& resources = graph_.graph.desc().resources;
  if (resource < resources.size() && !resources[resource].contents.empty()) return resources[resource].contents;
  throw Error(WALR_ERROR_INVALID_ARGUMENT, "resource " + std::to_string(resource) + " is not an upload");
}

void HostedPasses::record(std::uint32_t pass, VkCommandBuffer commandBuffer,
                          std::span<const WalrPassResource> resources) {
  if (!recording_) {
    throw Error(WALR_ERROR_WRONG_ORDER, "these passes were created without a device: they can only be listed");
  }
  if (!constants_) throw Error(WALR_ERROR_WRONG_ORDER, "there is no frame yet: call walr_begin_frame before");
  if (commandBuffer == VK_NULL_HANDLE) throw Error(WALR_ERROR_INVALID_ARGUMENT, "the command buffer is null");
  if (pass >= list().pass_count) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT,
                "there is no pass " + std::to_string(pass) + ", there are " + std::to_string(list().pass_count));
  }
  recording_->requireRecordable(pass, resources);
  const CountUse ofLint = lint_ ? useOf(pass, graph_.lint) : CountUse::None;
  const CountUse ofCounters = counters_ ? useOf(pass, graph_.inspection.counterBuffer()) : CountUse::None;
  const auto recordBarrier = [&](const CountBuffer& buffer, CountUse use) {
    if (use == CountUse::Clear) {
      buffer.recordBefore(commandBuffer);
    } else {
      buffer.recordBetween(commandBuffer);
    }
  };
  if (ofLint != CountUse::None) recordBarrier(lint_->buffer(), ofLint);
  if (ofCounters != CountUse::None) recordBarrier(counters_->buffer(), ofCounters);
  if (timestamps_) timestamps_->beginPass(commandBuffer, recording_->slot(), pass);
  recording_->record(pass, commandBuffer, resources);
  if (timestamps_) timestamps_->endPass(commandBuffer, recording_->slot(), pass);
  if (ofCounters == CountUse::CountLast) counters_->recordAfter(commandBuffer, recording_->slot());
  if (ofLint == CountUse::CountLast) {
    const std::uint64_t frame = description_.frames() - 1;  // The next one is counted already.
    const bool continues = lastLinted_ && *lastLinted_ + 1 == frame;
    lint_->recordAfter(commandBuffer, recording_->slot(), {constants_->camera, description_.extent(), continues});
    lastLinted_ = frame;
  }
}

/// The binding of a buffer of counts in a pass; null if it has none.
const WalrBinding* HostedPasses::bindingOf(std::uint32_t pass, fg::Buffer counts) const {
  const std::span bindings(list().passes[pass]->bindings, list().passes[pass]->binding_count);
  const auto found = std::ranges::find(bindings, counts.resource, &WalrBinding::resource);
  return found == bindings.end() ? nullptr : *found;
}

HostedPasses::CountUse HostedPasses::useOf(std::uint32_t pass, fg::Buffer counts) const {
  const WalrBinding* binding = bindingOf(pass, counts);
  if (binding == nullptr) return CountUse::None;
  if ((binding->access & VK_ACCESS_2_SHADER_STORAGE_READ_BIT) == 0) return CountUse::Clear;
  for (std::uint32_t later = pass + 1; later < list().pass_count; ++later) {
    if (bindingOf(later, counts) != nullptr) return CountUse::Count;
  }
  return CountUse::CountLast;
}

std::span<const LintFinding> HostedPasses::findings() const {
  if (lint_) return lint_->findings();
  throw Error(WALR_ERROR_WRONG_ORDER,
              "inputs are not checked: create the passes with WalrDenoiserInfo::lint and a device");
}

std::vector<WalrCounter> HostedPasses::counters() const {
  if (!recording_ || !(graph_.lint.valid() || graph_.inspection.counterBuffer().valid())) {
    throw Error(WALR_ERROR_WRONG_ORDER,
                "nothing is counted: create the passes with WalrDenoiserInfo::counters or WalrDenoiserInfo::lint, and "
                "a device");
  }
  std::vector<WalrCounter> counters;
  if (counters_) counters = counters_->values();
  if (lint_) counters.insert(counters.end(), lint_->counts().begin(), lint_->counts().end());
  return counters;
}

void HostedPasses::forget(VkImage image, std::uint64_t identity) {
  if (image == VK_NULL_HANDLE) throw Error(WALR_ERROR_INVALID_ARGUMENT, "the image is null");
  if (recording_) recording_->forget(identity != 0 ? identity : reinterpret_cast<std::uint64_t>(image));
}

}  // namespace walr::api
