#include "integration/c_api/hosted_passes.h"

#include <string>

#include <glm/gtc/type_ptr.hpp>

#include "framegraph/vulkan/driver_memory_model.h"
#include "framegraph/vulkan/inherited_histories.h"
#include "integration/c_api/structs.h"

namespace walr::api {

HostedPasses::HostedPasses(const WalrDenoiserInfo& info, std::span<const WalrSettingValue> settings,
                           std::span<const WalrPortFormat> ports)
    : description_(info, Description::Of::MethodsAndStages) {
  for (const WalrSettingValue& setting : settings) {
    description_.settings().set(requireText(setting.name, "WalrSettingValue::name"),
                                requireText(setting.value, "WalrSettingValue::value"));
  }
  if (info.device != nullptr) device_ = std::make_unique<HostDevice>(info.device);
  graph_ = description_.list(ports);
  // A host creates one image for each resource and swaps only those of histories, so transients cannot alias histories.
  constexpr fg::CompileOptions kOneImageEach = {.aliasHistories = false};
  plan_ = compilePlan(graph_.graph, fg::TableMemoryModel(), kOneImageEach);
  if (device_) {
    fg::vk::require(device_->physical(), fg::vk::formatUses(graph_.graph.desc(), plan_));
    plan_ = compilePlan(graph_.graph, fg::vk::DriverMemoryModel(device_->context()), kOneImageEach);
  }
  list_.emplace(graph_.graph.desc(), plan_, graph_.ports);
  if (device_) {
    recording_.emplace(device_->context(), graph_.graph.desc(), plan_, list_->list(), description_.slots(),
                       info.pipeline_cache);
  }
}

void HostedPasses::continueFrom(const HostedPasses& last) {
  if (description_.methodName() != last.description_.methodName()) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT, "the passes to continue from are those of method '" +
                                                 last.description_.methodName() +
                                                 "': create both with the same method and conventions");
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
  constants_ = description_.constants({.camera = frame.camera,
                                       .previousCamera = frame.previous_camera,
                                       .skyDepth = frame.sky_depth,
                                       .preExposure = frame.pre_exposure,
                                       .offset = glm::make_vec2(frame.offset)});
  if (recording_) {
    recording_->begin(description_.frames());
    for (const std::uint32_t resource : recording_->uploads()) recording_->upload(resource, frameConstants(resource));
  }
  description_.advance(*frame.camera);
}

std::span<const std::byte> HostedPasses::frameConstants(std::uint32_t resource) const {
  if (!constants_) throw Error(WALR_ERROR_WRONG_ORDER, "there is no frame yet: call walr_begin_frame before");
  if (graph_.frame.valid() && resource == graph_.frame.resource) return std::as_bytes(std::span(&constants_->frame, 1));
  if (graph_.host.valid() && resource == graph_.host.resource) return std::as_bytes(std::span(&constants_->host, 1));
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
  recording_->record(pass, commandBuffer, resources);
}

void HostedPasses::forget(VkImage image, std::uint64_t identity) {
  if (image == VK_NULL_HANDLE) throw Error(WALR_ERROR_INVALID_ARGUMENT, "the image is null");
  if (recording_) recording_->forget(identity != 0 ? identity : reinterpret_cast<std::uint64_t>(image));
}

}  // namespace walr::api
