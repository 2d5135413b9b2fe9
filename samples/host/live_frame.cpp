#include "samples/host/live_frame.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "framegraph/declare/same_topology.h"
#include "framegraph/vulkan/image.h"
#include "samples/host/renderer.h"

namespace walr::host {
namespace {

/// @param extent  of the picture
HostTargets shownTarget(fg::Extent extent) {
  constexpr fg::ExternalState kShownBefore{kShown.stage, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_UNDEFINED};
  HostTargets targets;
  targets.display = {kShownBefore, kShown};
  targets.displayExtent = extent;
  return targets;
}

/// What was read back of the frame last recorded with a slot.
std::vector<std::uint32_t> wordsOf(const fg::vk::StagedBuffer& buffer, std::uint32_t slot) {
  const std::span<const std::byte> bytes = buffer.staging(slot);
  std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
  std::ranges::copy(bytes, std::as_writable_bytes(std::span(words)).begin());
  return words;
}

}  // namespace

ShownPicture::ShownPicture(const GpuDevice& device, fg::Extent extent)
    : desc_{.format = VK_FORMAT_R8G8B8A8_UNORM, .extent = extent},
      image_(fg::vk::createImage(device.device().context(), desc_,
                                 VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, "shown picture")),
      memory_(device.device().context(), VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, "shown picture") {
  memory_.add(image_.get());
  memory_.allocate();
}

LiveFrame::LiveFrame(const GpuDevice& device, const ShownPicture& picture, std::uint32_t framesInFlight,
                     const LightPattern& light, const gpu_render::GpuScene* scene, bool specular)
    : device_(device),
      picture_(picture),
      framesInFlight_(framesInFlight),
      light_(light),
      scene_(scene),
      specular_(specular),
      extent_(picture.desc().extent),
      shown_(extent_) {}

HostGraph LiveFrame::declareHost(Denoiser& method, const HostView& view) const {
  return declareHostGraph(device_.device().context(), method, extent_, view, shownTarget(picture_.desc().extent),
                          light_, {}, scene_, specular_);
}

bool LiveFrame::update(Denoiser& method, const HostView& view) {
  if (!declared()) return false;
  HostGraph host = declareHost(method, view);
  if (!fg::sameTopology(running_->host.graph.desc(), host.graph.desc())) return false;
  running_->device.executor().update(host.graph.desc());
  running_->host = std::move(host);
  return true;
}

std::optional<fg::vk::StagedBuffer> LiveFrame::readBack(DeviceGraph& device, const HostGraph& host,
                                                        const std::optional<fg::Buffer>& buffer) const {
  if (!buffer) return std::nullopt;
  const fg::ResourceDecl& declared = host.graph.desc().resources[buffer->resource];
  fg::vk::StagedBuffer made(device_.device().context(), std::get<fg::BufferDesc>(declared.desc),
                            device.executor().usage(*buffer), framesInFlight_, declared.name);
  device.executor().bind(*buffer, made.handle());
  return made;
}

void LiveFrame::declare(Denoiser& method, const HostView& view, Start start) {
  // A graph that has recorded no frame has no histories of its own: the new graph takes over those of its predecessor.
  const bool recorded = declared() && running_->frames > 0;
  Running* const before = recorded ? running_.get() : predecessor_.get();
  HostGraph host = declareHost(method, view);
  DeviceGraph device(device_, host.graph, framesInFlight_,
                     start == Start::FromHistory && before != nullptr ? &before->device : nullptr);
  device.executor().bind(host.display, picture_.external());
  std::optional<fg::vk::StagedBuffer> rays = readBack(device, host, host.rays);
  std::optional<fg::vk::StagedBuffer> counts = readBack(device, host, host.lint);
  if (recorded) predecessor_ = std::move(running_);
  running_ = std::make_unique<Running>(Running{.host = std::move(host),
                                               .device = std::move(device),
                                               .rays = std::move(rays),
                                               .counts = std::move(counts),
                                               .linter = InputLinter({.light = light_})});
}

void LiveFrame::changeScene(const gpu_render::GpuScene* scene) {
  running_.reset();
  predecessor_.reset();
  retired_.clear();
  scene_ = scene;
}

void LiveFrame::record(const fg::vk::Frame& recorded, const HostFrame& frame, const ViewConstants& view) {
  // The caller has waited for the last frame recorded with this slot, and so for all frames up to that one.
  std::erase_if(retired_, [&](const Retired& retired) { return retired.until <= frames_; });
  ViewConstants constants = view;
  for (int* const edge : {&constants.leftEdge, &constants.rightEdge, &constants.middleEdge}) {
    *edge = static_cast<int>(std::int64_t{*edge} * extent_.width / picture_.desc().extent.width);
  }
  lint(recorded.slot);
  uploadFrame(running_->device.executor(), running_->host, frame, constants);
  running_->device.executor().record(recorded.commandBuffer, recorded.slot);
  for (const auto* const buffer : {&running_->rays, &running_->counts}) {
    if (*buffer) (*buffer)->recordReadback(recorded.commandBuffer, recorded.slot);
  }
  if (running_->counts) {
    const Frame& inputs = frame.inputs.frame;
    running_->unchecked.push_back(
        {recorded.slot, frameDescriptionOf(inputs, glm::vec2(1.0F)), extent_, !inputs.resetHistory});
  }
  // The first frame of a graph reads the histories of its predecessor.
  if (predecessor_ != nullptr) retired_.push_back({std::move(predecessor_), frames_ + framesInFlight_});
  ++running_->frames;
  ++frames_;
  shown_ = extent_;
}

std::optional<TracedRays> LiveFrame::traced(std::uint32_t slot) {
  const std::span<const fg::vk::PassTime> times = passTimes(slot);
  if (!running_->rays || times.empty()) return std::nullopt;
  return tracedByDevice(wordsOf(*running_->rays, slot), times);
}

void LiveFrame::lint(std::uint32_t slot) {
  std::deque<Unchecked>& unchecked = running_->unchecked;
  while (std::ranges::find(unchecked, slot, &Unchecked::slot) != unchecked.end()) {
    const Unchecked& frame = unchecked.front();
    running_->linter.add(wordsOf(*running_->counts, frame.slot), frame.camera, frame.extent, frame.continues);
    unchecked.pop_front();
  }
}

std::vector<LintFinding> LiveFrame::findings() const {
  return running_->linter.findings();
}

std::vector<fg::vk::HistoryStatus> LiveFrame::histories() {
  std::vector<fg::vk::HistoryStatus> statuses;
  for (std::uint32_t i = 0; i < graph().desc().histories.size(); ++i) {
    statuses.push_back(running_->device.executor().historyStatus({{}, {}, i}));
  }
  return statuses;
}

}  // namespace walr::host
