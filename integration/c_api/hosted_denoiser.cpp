#include "integration/c_api/hosted_denoiser.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/gtc/type_ptr.hpp>

#include "framegraph/compile.h"
#include "framegraph/vulkan/driver_memory_model.h"
#include "framegraph/vulkan/physical_device.h"
#include "integration/c_api/structs.h"
#include "integration/setting_info.h"

namespace walr::api {
namespace {

constexpr std::uint32_t kLargestPicture = 16384;
constexpr std::uint32_t kMostFramesInFlight = 16;
constexpr std::uint32_t kUsualFramesInFlight = 2;

WalrConventions checkedConventions(const WalrConventions* given) {
  WalrConventions conventions = readOptional(given, "WalrConventions");
  checkedEnum(conventions.normal_space, WALR_SPACE_WORLD, "WalrConventions::normal_space");
  checkedEnum(conventions.motion_unit, WALR_MOTION_PICTURES, "WalrConventions::motion_unit");
  checkedEnum(conventions.motion_depth, WALR_MOTION_DEPTH_STATIC_SCENE, "WalrConventions::motion_depth");
  for (float& scale : conventions.motion_scale) {
    if (!std::isfinite(scale)) {
      throw Error(WALR_ERROR_INVALID_ARGUMENT, "WalrConventions::motion_scale is not finite");
    }
    if (scale == 0.0F) scale = 1.0F;
  }
  return conventions;
}

InputConventions inputConventions(const WalrConventions& conventions) {
  return {.normal = conventions.normal_space == WALR_SPACE_WORLD ? InputConventions::Space::World
                                                                 : InputConventions::Space::View,
          .motionDepth = conventions.motion_depth == WALR_MOTION_DEPTH_STATIC_SCENE
                             ? InputConventions::MotionDepth::StaticScene
                             : InputConventions::MotionDepth::Given};
}

fg::Extent checkedExtent(std::uint32_t width, std::uint32_t height) {
  if (width == 0 || height == 0 || width > kLargestPicture || height > kLargestPicture) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT, "a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                                                 " pixels: both must be 1 to " + std::to_string(kLargestPicture));
  }
  return {width, height};
}

std::uint32_t checkedSlots(std::uint32_t framesInFlight) {
  if (framesInFlight <= kMostFramesInFlight) return framesInFlight == 0 ? kUsualFramesInFlight : framesInFlight;
  throw Error(WALR_ERROR_INVALID_ARGUMENT, "WalrDenoiserInfo::frames_in_flight is " + std::to_string(framesInFlight) +
                                               ": it must be at most " + std::to_string(kMostFramesInFlight));
}

VkFormat formatOr(VkFormat format, std::size_t input) {
  const HostInput& host = kHostInputs.at(input);
  if (format == VK_FORMAT_UNDEFINED) return host.format;
  requireInputFormat(host, format);
  return format;
}

fg::Plan compilePlan(const fg::Graph& graph, const fg::MemoryModel& memory) {
  fg::CompileResult result = fg::compile(graph.desc(), memory);
  if (!result.ok()) throw Error(WALR_ERROR_INTERNAL, "the method's frame graph does not compile:\n" + result.text());
  return std::move(result.plan);
}

void requireFinite(std::span<const float> values, const char* what) {
  if (std::ranges::all_of(values, [](float value) { return std::isfinite(value); })) return;
  throw Error(WALR_ERROR_INVALID_ARGUMENT, std::string(what) + " is not finite");
}

const WalrCamera& checkedCamera(const WalrCamera& camera) {
  requireFinite(camera.view, "WalrCamera::view");
  requireFinite(camera.projection, "WalrCamera::projection");
  requireFinite(camera.jitter, "WalrCamera::jitter");
  return camera;
}

}  // namespace

HostedDenoiser::HostedDenoiser(const WalrDenoiserInfo& info)
    : device_(info.device),
      method_(makeDenoiser(info.method == nullptr ? "walr" : info.method)),
      methodName_(info.method == nullptr ? "walr" : info.method),
      extent_(checkedExtent(info.width, info.height)),
      conventions_(checkedConventions(info.conventions)),
      formats_{formatOr(info.lighting_format, 0), formatOr(info.depth_format, 1), formatOr(info.normal_format, 2),
               formatOr(info.motion_format, 3), formatOr(info.albedo_format, 4)},
      slots_(checkedSlots(info.frames_in_flight)),
      timestamps_(info.timestamps == VK_TRUE && device_.context().timestampBits > 0),
      log_(info.log),
      logUser_(info.log_user) {
  if (info.preset != nullptr) method_->usePreset(info.preset);
  if (info.timestamps == VK_TRUE && !timestamps_) log(WALR_LOG_WARNING, "the queue family has no timestamps");
}

void HostedDenoiser::log(WalrLogLevel level, const std::string& text) const {
  if (log_ != nullptr) log_(logUser_, level, text.c_str());
}

void HostedDenoiser::declarationChanged() {
  declared_.reset();
}

void HostedDenoiser::resize(std::uint32_t width, std::uint32_t height) {
  const fg::Extent extent = checkedExtent(width, height);
  if (extent == extent_) return;
  extent_ = extent;
  declarationChanged();
}

void HostedDenoiser::set(std::string_view name, std::string_view value) {
  method_->set(name, value);
  declarationChanged();
}

void HostedDenoiser::usePreset(std::string_view name) {
  method_->usePreset(name);
  declarationChanged();
}

std::string HostedDenoiser::setting(std::string_view name) {
  for (SettingDescription& setting : describeSettings(*method_)) {
    if (setting.name == name) return std::move(setting.value);
  }
  throw Error(WALR_ERROR_INVALID_ARGUMENT, "method '" + methodName_ + "' has no setting \"" + std::string(name) + "\"");
}

const HostedDenoiser::Declared& HostedDenoiser::declare() {
  if (declared_) return *declared_;
  Declared declared;
  declared.graph = declareDenoiseGraph(*method_, extent_, inputConventions(conventions_), kInnerStates, formats_);
  // What the device lacks is said for every format at once, before the driver is asked for memory.
  const fg::Plan portable = compilePlan(declared.graph.graph, fg::TableMemoryModel());
  fg::vk::require(device_.physical(), fg::vk::formatUses(declared.graph.graph.desc(), portable));
  declared.plan = compilePlan(declared.graph.graph, fg::vk::DriverMemoryModel(device_.context()));

  for (std::size_t i = 0; i < kHostInputs.size(); ++i) {
    declared.images[i] = declared.graph.inputs.*kHostInputs[i].texture;
  }
  declared.images[kOutputImage] = declared.graph.output;
  for (std::size_t i = 0; i < kImageCount; ++i) {
    const fg::PlannedResource& planned = declared.plan.resources[declared.images[i].resource];
    declared.needs[i] = {.used = planned.used,
                         .format = declared.graph.graph.textureDesc(declared.images[i]).format,
                         .usage = planned.imageUsage,
                         .extent = extent_};
  }
  retire();
  declared_ = std::move(declared);
  return *declared_;
}

void HostedDenoiser::build() {
  const Declared& declared = declare();
  if (built_) return;
  built_ = Built{.executor = std::make_unique<fg::vk::Executor>(
                     device_.context(), declared.graph.graph.desc(), declared.plan,
                     fg::vk::ExecutorOptions{.framesInFlight = slots_, .timestamps = timestamps_}),
                 .memory = declared.plan.memory,
                 .lastFrame = std::nullopt};
  log(WALR_LOG_INFO, methodName_ + " at " + std::to_string(extent_.width) + " x " + std::to_string(extent_.height) +
                         ": " + std::to_string(declared.plan.passes.size()) + " passes, " +
                         std::to_string(built_->executor->allocatedBytes()) + " bytes of device memory");
}

void HostedDenoiser::prepare() {
  build();
}

/// Frames in flight may still use what was built.
void HostedDenoiser::retire() {
  if (built_ && built_->lastFrame) retired_.push_back(std::move(*built_));
  built_.reset();
}

/// The host has waited for the frame that was recorded `slots_` frames before the one it is about to record.
void HostedDenoiser::dropFinished() {
  std::erase_if(retired_, [&](const Built& built) { return *built.lastFrame + slots_ <= frames_; });
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
  const std::array<const WalrImage*, kImageCount> given{frame.lighting, frame.depth,  frame.normal,
                                                        frame.motion,   frame.albedo, frame.denoised};
  FrameImages images{};
  for (std::size_t i = 0; i < kImageCount; ++i) {
    images[i] = checkedImage(i, given[i], declared_->needs[i], device_.context().view.queueFamily);
  }
  for (std::size_t i = 0; i < kOutputImage; ++i) {
    if (images[i].given && images[i].image.image == images[kOutputImage].image.image) {
      throw Error(WALR_ERROR_INVALID_ARGUMENT,
                  "image '" + std::string(imageName(i)) + "' is also the output: make an image of its own for that");
    }
  }
  return images;
}

FrameConstants HostedDenoiser::constantsOf(const WalrFrame& frame, const WalrCamera& camera) const {
  const WalrCamera& previous = frame.previous_camera != nullptr ? checkedCamera(*frame.previous_camera)
                               : lastCamera_                    ? *lastCamera_
                                                                : camera;
  glm::vec2 scale(conventions_.motion_scale[0], conventions_.motion_scale[1]);
  if (conventions_.motion_unit == WALR_MOTION_PICTURES) scale *= glm::vec2(extent_.width, extent_.height);
  FrameDescription description{.view = glm::make_mat4(camera.view),
                               .previousView = glm::make_mat4(previous.view),
                               .projection = glm::make_mat4(camera.projection),
                               .previousProjection = glm::make_mat4(previous.projection),
                               .jitter = glm::make_vec2(camera.jitter),
                               .previousJitter = glm::make_vec2(previous.jitter),
                               .motionScale = scale,
                               .frameIndex = static_cast<std::uint32_t>(frames_)};
  if (!(frame.sky_depth >= 0.0F)) throw Error(WALR_ERROR_INVALID_ARGUMENT, "WalrFrame::sky_depth is negative or NaN");
  if (frame.sky_depth > 0.0F) description.skyDepth = frame.sky_depth;
  return frameConstants(description, extent_);
}

void HostedDenoiser::bind(const FrameImages& images) {
  for (std::size_t i = 0; i < kImageCount; ++i) {
    if (!images[i].given) continue;
    built_->executor->bind(declared_->images[i], {images[i].image.image, images[i].image.identity});
  }
}

void HostedDenoiser::record(VkCommandBuffer commandBuffer, const WalrFrame& frame) {
  if (commandBuffer == VK_NULL_HANDLE) throw Error(WALR_ERROR_INVALID_ARGUMENT, "the command buffer is null");
  if ((frame.flags & ~static_cast<std::uint32_t>(WALR_FRAME_RESET_HISTORY)) != 0) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT, "WalrFrame::flags has unknown bits: " + std::to_string(frame.flags));
  }
  if (frame.camera == nullptr) throw Error(WALR_ERROR_INVALID_ARGUMENT, "WalrFrame::camera is null");
  const WalrCamera camera = checkedCamera(*frame.camera);
  declare();
  const FrameImages images = checkedImages(frame);
  const FrameConstants constants = constantsOf(frame, camera);
  dropFinished();
  build();
  bind(images);

  if (declared_->plan.resources[declared_->graph.inputs.frame.resource].used) {
    built_->executor->upload(declared_->graph.inputs.frame, constants);
  }
  if (resetRequested_ || (frame.flags & WALR_FRAME_RESET_HISTORY) != 0) built_->executor->resetAllHistory();
  recordAcquire(device_.context(), commandBuffer, images);
  built_->executor->record(commandBuffer, static_cast<std::uint32_t>(frames_ % slots_));
  recordRelease(device_.context(), commandBuffer, images);

  resetRequested_ = false;
  lastCamera_ = camera;
  lastImages_ = images;
  built_->lastFrame = frames_++;
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

WalrMemory HostedDenoiser::memory() const {
  if (!built_) throw Error(WALR_ERROR_WRONG_ORDER, "nothing is made yet: call walr_prepare before");
  WalrMemory memory{};
  memory.allocated = built_->executor->allocatedBytes();
  memory.persistent = built_->memory.persistentBytes;
  memory.transient = built_->memory.transientPeakBytes;
  memory.transient_unaliased = built_->memory.transientUnaliasedBytes;
  memory.transient_least = built_->memory.transientLowerBoundBytes;
  for (const Built& built : retired_) memory.retired += built.executor->allocatedBytes();
  return memory;
}

std::span<const fg::vk::PassTime> HostedDenoiser::timings() {
  if (!timestamps_ || !built_ || !built_->lastFrame) return {};
  const std::uint64_t recorded = std::min<std::uint64_t>(*built_->lastFrame + 1, slots_);
  for (std::uint64_t back = 0; back < recorded; ++back) {
    const auto times = built_->executor->passTimes(static_cast<std::uint32_t>((*built_->lastFrame - back) % slots_));
    if (!times.empty()) return times;
  }
  return {};
}

}  // namespace walr::api
