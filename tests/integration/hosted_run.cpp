#include "tests/integration/hosted_run.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <glm/gtc/type_ptr.hpp>

#include "tests/passes/texel_codec.h"

namespace walr::test {
namespace {

constexpr std::array kImages{"lighting",  "depth",      "normal",    "motion",          "albedo",
                             "object_id", "confidence", "roughness", "specular_motion", "denoised"};
constexpr std::size_t kAlbedo = 4;
constexpr std::size_t kFirstGuide = 1;
constexpr std::size_t kLastGuide = 4;
constexpr std::size_t kObjectIds = 5;
constexpr std::size_t kConfidence = 6;
constexpr std::size_t kRoughness = 7;
constexpr std::size_t kSpecularMotion = 8;
constexpr std::size_t kOutput = 9;

WalrImageState stateOf(const fg::ExternalState& state) {
  return {.stage = state.stage, .access = state.access, .layout = state.layout, .reserved = 0};
}

}  // namespace

void require(WalrResult result) {
  if (result == WALR_SUCCESS) return;
  throw std::runtime_error(std::string(walr_result_name(result)) + ": " + walr_last_error());
}

WalrCamera cameraOf(const glm::mat4& view, const glm::mat4& projection, glm::vec2 jitter) {
  WalrCamera camera{};
  std::memcpy(camera.view, glm::value_ptr(view), sizeof(camera.view));
  std::memcpy(camera.projection, glm::value_ptr(projection), sizeof(camera.projection));
  std::memcpy(camera.jitter, glm::value_ptr(jitter), sizeof(camera.jitter));
  return camera;
}

WalrDevice hostDevice(const fg::vk::Device& device) {
  const fg::vk::DeviceView& view = device.context().view;
  WalrDevice host{};
  host.struct_size = sizeof(host);
  host.queue_family = view.queueFamily;
  host.instance = view.instance;
  host.physical_device = view.physicalDevice;
  host.device = view.device;
  host.get_instance_proc_addr = view.getInstanceProcAddr;
  return host;
}

WalrDenoiserInfo denoiserInfo(const WalrDevice* device, glm::ivec2 size) {
  WalrDenoiserInfo info{};
  info.struct_size = sizeof(info);
  info.device = device;
  info.width = static_cast<std::uint32_t>(size.x);
  info.height = static_cast<std::uint32_t>(size.y);
  return info;
}

WalrResult createPasses(const WalrDenoiserInfo& info, WalrPasses& passes) {
  WalrPassesInfo listed{};
  listed.struct_size = sizeof(listed);
  listed.denoiser = &info;
  return walr_create_passes(&listed, &passes);
}

namespace {

/// A denoiser that never records a frame, and whose pipelines others share.
WalrDenoiser pipelineOwner(const fg::test::TestDevice& device) {
  std::shared_ptr<void>& owner = device.companion();
  if (!owner) {
    const WalrDevice host = hostDevice(device);
    WalrDenoiserInfo info = denoiserInfo(&host);
    info.method = "none";
    WalrDenoiser denoiser = nullptr;
    require(walr_create_denoiser(&info, &denoiser));
    owner.reset(denoiser, [](WalrDenoiser made) { walr_destroy_denoiser(made); });
  }
  return static_cast<WalrDenoiser>(owner.get());
}

WalrDenoiser sharedWith(const fg::test::TestDevice& device, const HostedRun::Options& options) {
  if (options.sharedWith != nullptr) return options.sharedWith;
  const bool asUsual = options.getInstanceProcAddr == nullptr && options.deviceMemory == nullptr &&
                       options.createInfo == nullptr && options.pipelineCache == VK_NULL_HANDLE;
  return asUsual && !options.alone ? pipelineOwner(device) : nullptr;
}

}  // namespace

HostedRun::HostedRun(const fg::test::TestDevice& device, const char* method, glm::ivec2 size, const Options& options)
    : device_(&device),
      hostSlots_(options.hostSlots != 0 ? options.hostSlots : options.framesInFlight),
      rememberedCamera_(options.rememberedCamera),
      objectIds_(options.objectIds),
      confidence_(options.confidenceFormat != VK_FORMAT_UNDEFINED),
      hasHistoryLength_(options.historyLength),
      specular_(options.specular),
      specularMotion_(options.specularMotion),
      guidesOf_(options.guidesOf),
      offset_(options.offset),
      margin_(options.margin),
      queue_(device.context(), device.queue(), hostSlots_) {
  WalrDevice host = hostDevice(device);
  if (options.getInstanceProcAddr != nullptr) host.get_instance_proc_addr = options.getInstanceProcAddr;
  host.device_memory = options.deviceMemory;
  host.create_info = options.createInfo;
  WalrConventions conventions = options.conventions;
  conventions.struct_size = sizeof(conventions);
  conventions.rectangle = margin_ != glm::ivec2(0) ? VK_TRUE : VK_FALSE;
  WalrDenoiserInfo info = denoiserInfo(&host, size);
  info.frames_in_flight = options.framesInFlight;
  info.method = method;
  info.conventions = &conventions;
  info.lighting_format = options.formats[0];
  info.depth_format = options.formats[1];
  info.normal_format = options.formats[2];
  info.motion_format = options.formats[3];
  (specular_ ? info.specular_albedo_format : info.albedo_format) = options.formats[4];
  info.denoised_format = options.denoisedFormat;
  if (objectIds_) info.object_id_format = VK_FORMAT_R32_UINT;
  info.confidence_format = options.confidenceFormat;
  info.history_length = options.historyLength ? VK_TRUE : VK_FALSE;
  if (specularMotion_) info.specular_motion_format = VK_FORMAT_R16G16B16A16_SFLOAT;
  info.light_kind = specular_ ? WALR_LIGHT_SPECULAR : WALR_LIGHT_DIFFUSE;
  info.counters = options.counters ? VK_TRUE : VK_FALSE;
  info.lint = options.lint ? VK_TRUE : VK_FALSE;
  info.timestamps = options.timestamps ? VK_TRUE : VK_FALSE;
  info.log = options.log;
  info.log_user = options.logUser;
  info.pipeline_cache = options.pipelineCache;
  info.shared_with = sharedWith(device, options);
  require(walr_create_denoiser(&info, &denoiser_));
  makeImages(size);
}

HostedRun::~HostedRun() {
  queue_.waitAll();
  walr_destroy_denoiser(denoiser_);
}

void HostedRun::makeImages(glm::ivec2 size) {
  needs_.clear();
  for (const char* name : kImages) {
    if (!isGiven(images_.size()) || isBorrowed(images_.size())) {
      images_.push_back(nullptr);
      needs_.emplace_back();
      continue;
    }
    WalrImageRequirements needs{};
    needs.struct_size = sizeof(needs);
    const bool ofLobe = specular_ && images_.size() == kAlbedo;
    require(walr_get_image_requirements(denoiser_, ofLobe ? "specular_albedo" : name, &needs));
    // Sparse light has a texel for a group of pixels.
    const bool sparse = name == kImages.front() && glm::all(glm::lessThan(glm::ivec2(needs.width, needs.height), size));
    if (!sparse && glm::ivec2(needs.width, needs.height) != size)
      throw std::logic_error("requirements of another size");
    needs.width += static_cast<std::uint32_t>(margin_.x);
    needs.height += static_cast<std::uint32_t>(margin_.y);
    // An image that the denoiser does not use may be anything. It is given anyway.
    if (needs.usage == 0) needs.usage = VK_IMAGE_USAGE_SAMPLED_BIT;
    const bool output = images_.size() == kOutput;
    images_.push_back(std::make_unique<fg::vk::StagedImage>(
        device_->context(), fg::TextureDesc{.format = needs.format, .extent = {needs.width, needs.height}}, needs.usage,
        output ? fg::vk::StagedImage::Direction::Readback : fg::vk::StagedImage::Direction::Upload, hostSlots_, name));
    needs_.push_back(needs);
  }
  firstIdentity_ = nextIdentity_;
  nextIdentity_ += kImages.size();
  if (hasHistoryLength_) historyLength_ = makeOutput("history_length");
}

HostedRun::FurtherOutput HostedRun::makeOutput(const char* name) {
  FurtherOutput output;
  output.needs.struct_size = sizeof(output.needs);
  require(walr_get_image_requirements(denoiser_, name, &output.needs));
  output.image = std::make_unique<fg::vk::StagedImage>(
      device_->context(),
      fg::TextureDesc{.format = output.needs.format, .extent = {output.needs.width, output.needs.height}},
      output.needs.usage, fg::vk::StagedImage::Direction::Readback, hostSlots_, name);
  output.identity = nextIdentity_++;
  return output;
}

void HostedRun::forget(std::optional<FurtherOutput>& output) {
  if (output) require(walr_forget_image(denoiser_, output->image->external().image, output->identity));
  output.reset();
}

bool HostedRun::isGiven(std::size_t index) const {
  return (index != kObjectIds || objectIds_) && (index != kConfidence || confidence_) &&
         (index != kRoughness || specular_) && (index != kSpecularMotion || specularMotion_);
}

bool HostedRun::isBorrowed(std::size_t index) const {
  return guidesOf_ != nullptr && index >= kFirstGuide && index <= kLastGuide;
}

std::vector<std::uint16_t> HostedRun::historyLength() const {
  const auto bytes = historyLength_->image->staging(lastSlot_);
  std::vector<std::uint16_t> texels(bytes.size() / sizeof(std::uint16_t));
  std::memcpy(texels.data(), bytes.data(), bytes.size());
  return texels;
}

void HostedRun::chooseView(const char* name) {
  queue_.waitAll();
  forget(view_);
  require(walr_set_view(denoiser_, name));
  if (name == nullptr) return;
  view_ = makeOutput("view");
}

std::vector<glm::vec4> HostedRun::view() const {
  const auto bytes = view_->image->staging(lastSlot_);
  std::vector<glm::vec4> texels(bytes.size() / sizeof(glm::vec4));
  std::memcpy(texels.data(), bytes.data(), bytes.size());
  return texels;
}

void HostedRun::resize(glm::ivec2 size) {
  queue_.waitAll();
  for (std::size_t i = 0; i < images_.size(); ++i) {
    if (!images_[i]) continue;
    require(walr_forget_image(denoiser_, images_[i]->external().image, firstIdentity_ + i));
  }
  images_.clear();
  forget(historyLength_);
  require(walr_resize(denoiser_, static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y)));
  makeImages(size);
}

void HostedRun::moveRectangle(glm::ivec2 size, glm::ivec2 offset) {
  offset_ = offset;
  require(walr_resize(denoiser_, static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y)));
}

void HostedRun::fill(const std::string& image, std::vector<std::byte> texels) {
  const auto index = static_cast<std::size_t>(std::ranges::find(kImages, image) - kImages.begin());
  texels_.at(index) = std::move(texels);
}

void HostedRun::fill(const reference::HostFrame& frame) {
  fill("lighting", texelBytes(specular_ ? encodeLighting(frame) : encodeHalves(frame.lighting)));
  if (specular_) fill("roughness", texelBytes(encodeRoughness(frame)));
  if (specularMotion_) fill("specular_motion", texelBytes(encodeHalves(frame.specularMotion)));
  fill("depth", texelBytes(encodeFloats(frame.depth)));
  fill("normal", texelBytes(encodeHalves(frame.normal)));
  fill("motion", texelBytes(encodeHalves(frame.motion)));
  fill("albedo", texelBytes(encodeHalves(frame.albedo)));
}

WalrImage HostedRun::describe(std::size_t index) const {
  const WalrImageRequirements& needs = needs_[index];
  WalrImage image{};
  image.struct_size = sizeof(image);
  image.queue_family = VK_QUEUE_FAMILY_IGNORED;
  image.image = images_[index]->external().image;
  image.identity = firstIdentity_ + index;
  image.format = needs.format;
  image.usage = needs.usage;
  image.width = needs.width;
  image.height = needs.height;
  image.acquire = stateOf(index == kOutput ? fg::vk::kOverwritable : fg::vk::kUploaded);
  image.release = index == kOutput ? stateOf(fg::vk::kReadable)
                                   : WalrImageState{.stage = VK_PIPELINE_STAGE_2_COPY_BIT,
                                                    .access = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                                    .layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                                    .reserved = 0};
  return image;
}

WalrImage HostedRun::describe(const FurtherOutput& output) const {
  WalrImage image = describe(kOutput);
  image.image = output.image->external().image;
  image.identity = output.identity;
  image.format = output.needs.format;
  image.usage = output.needs.usage;
  image.width = output.needs.width;
  image.height = output.needs.height;
  return image;
}

std::uint32_t HostedRun::submit(const FrameDescription& camera, std::uint32_t flags, float preExposure,
                                const fg::vk::FrameSemaphores& semaphores) {
  const fg::vk::Frame recorded = queue_.begin();
  record(recorded, camera, flags, preExposure, semaphores.finished);
  queue_.submit(recorded, semaphores);
  return recorded.slot;
}

void HostedRun::record(const fg::vk::Frame& recorded, const FrameDescription& camera, std::uint32_t flags,
                       float preExposure, const fg::vk::TimelinePoint& finished) {
  for (std::size_t i = 0; i < texels_.size(); ++i) {
    if (!images_[i]) continue;
    std::ranges::copy(texels_[i], images_[i]->staging(recorded.slot).begin());
    images_[i]->recordUpload(recorded.commandBuffer, recorded.slot);
  }
  std::array<WalrImage, kImages.size()> images{};
  for (std::size_t i = 0; i < images.size(); ++i) {
    // Another one's guides are in the state in which its denoiser left them, which is the one before it.
    if (isBorrowed(i)) images[i] = guidesOf_->describe(i);
    if (images_[i]) images[i] = describe(i);
  }
  const WalrCamera now = cameraOf(camera.view, camera.projection, camera.jitter);
  const WalrCamera before = cameraOf(camera.previousView, camera.previousProjection, camera.previousJitter);
  WalrFrame frame{};
  frame.struct_size = sizeof(frame);
  frame.flags = flags;
  frame.pre_exposure = preExposure;
  for (int axis = 0; axis < 2; ++axis) frame.offset[axis] = static_cast<std::uint32_t>(offset_[axis]);
  frame.lighting = &images[0];
  frame.depth = &images[1];
  frame.normal = &images[2];
  frame.motion = &images[3];
  (specular_ ? frame.specular_albedo : frame.albedo) = &images[kAlbedo];
  frame.roughness = specular_ ? &images[kRoughness] : nullptr;
  frame.specular_motion = specularMotion_ ? &images[kSpecularMotion] : nullptr;
  frame.object_id = objectIds_ ? &images[kObjectIds] : nullptr;
  frame.confidence = confidence_ ? &images[kConfidence] : nullptr;
  frame.denoised = &images[kOutput];
  const WalrImage view = view_ ? describe(*view_) : WalrImage{};
  frame.view = view_ ? &view : nullptr;
  const WalrImage historyLength = historyLength_ ? describe(*historyLength_) : WalrImage{};
  frame.history_length = historyLength_ ? &historyLength : nullptr;
  frame.camera = &now;
  for (int axis = 0; axis < 3; ++axis) {
    frame.origin[axis] = camera.origin[axis];
    frame.previous_origin[axis] = camera.previousOrigin[axis];
  }
  frame.previous_camera = rememberedCamera_ ? nullptr : &before;
  frame.finished = finished.semaphore;
  frame.finished_value = finished.value;
  require(walr_record(denoiser_, recorded.commandBuffer, &frame));
  if (view_) view_->image->recordReadback(recorded.commandBuffer, recorded.slot);
  if (historyLength_) historyLength_->image->recordReadback(recorded.commandBuffer, recorded.slot);
  output().recordReadback(recorded.commandBuffer, recorded.slot);
}

std::vector<std::byte> HostedRun::resultOf(std::uint32_t slot) const {
  const auto bytes = output().staging(slot);
  return {bytes.begin(), bytes.end()};
}

std::vector<std::byte> HostedRun::frameBytes(const FrameDescription& camera, std::uint32_t flags, float preExposure) {
  lastSlot_ = submit(camera, flags, preExposure);
  queue_.wait(lastSlot_);
  return resultOf(lastSlot_);
}

std::vector<std::uint16_t> HostedRun::frame(const FrameDescription& camera, std::uint32_t flags, float preExposure) {
  const std::vector<std::byte> bytes = frameBytes(camera, flags, preExposure);
  std::vector<std::uint16_t> texels(bytes.size() / sizeof(std::uint16_t));
  std::memcpy(texels.data(), bytes.data(), bytes.size());
  return texels;
}

void ignoreChangesOfLight(WalrDenoiser denoiser) {
  require(walr_set_setting(denoiser, "accumulation.antilag-high", "100"));
  require(walr_set_setting(denoiser, "accumulation.antilag-low", "99"));
}

std::vector<std::string> findingsOf(WalrDenoiser denoiser) {
  std::vector<std::string> names;
  for (const WalrFinding& finding : listed(walr_get_findings, denoiser)) {
    EXPECT_GT(std::strlen(finding.what) * std::strlen(finding.cause) * std::strlen(finding.way_out), 0U);
    names.emplace_back(finding.name);
  }
  return names;
}

}  // namespace walr::test
