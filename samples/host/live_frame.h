#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "framegraph/vulkan/frame_queue.h"
#include "framegraph/vulkan/memory.h"
#include "samples/denoise/device_graph.h"
#include "samples/denoise/gpu_device.h"
#include "samples/host/host_frame.h"
#include "samples/host/host_graph.h"
#include "samples/host/shaders/view_constants.h"

namespace walr::host {

/// State of `ShownPicture` while it is shown.
inline constexpr fg::ExternalState kShown{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                                          VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};

/// The picture in the window: frames write it when they are traced, the window reads it as often as it is drawn.
class ShownPicture {
 public:
  ShownPicture(const GpuDevice& device, fg::Extent extent);

  [[nodiscard]] fg::vk::ExternalImage external() const { return {image_.get(), 0}; }
  [[nodiscard]] const fg::TextureDesc& desc() const { return desc_; }

 private:
  fg::TextureDesc desc_;
  fg::vk::Owned<VkImage> image_;
  fg::vk::MemoryArena memory_;
};

/// The host's frame for a window: a graph that ends in the shown picture, and that may change between frames.
class LiveFrame {
 public:
  /// Where the next frame's histories come from.
  enum class Start { FromHistory, Anew };

  /// @param device, picture  must outlive this
  /// @param framesInFlight   frames recorded with one slot must be this many frames apart
  LiveFrame(const GpuDevice& device, const ShownPicture& picture, std::uint32_t framesInFlight);
  /// The device must have finished.
  ~LiveFrame() = default;
  LiveFrame(const LiveFrame&) = delete;
  LiveFrame& operator=(const LiveFrame&) = delete;

  /// Take over new values of the method's settings where nothing but constants has changed since `declare`: for the
  /// next frame, with all histories, and without making anything on the device but a pipeline for new specialization
  /// constants.
  /// @returns whether that was so; otherwise nothing has happened
  bool update(Denoiser& method, const HostView& view);

  /// Declare the graph of a method and a view, and make what it needs, while frames of the graph before may be in
  /// flight.
  /// @param start  `FromHistory` goes on from the histories of the graph before, where these fit
  /// @throws see `declareHostGraph` and `DeviceGraph`; the graph before stays
  void declare(Denoiser& method, const HostView& view, Start start);
  [[nodiscard]] bool declared() const { return running_ != nullptr; }

  void record(const fg::vk::Frame& recorded, const HostFrame& frame, const ViewConstants& view);

  [[nodiscard]] const fg::Graph& graph() const { return running_->host.graph; }
  [[nodiscard]] const fg::Plan& plan() const { return running_->device.plan(); }
  /// What the next frame will find of the method's histories, in the order of the graph's.
  [[nodiscard]] std::vector<fg::vk::HistoryStatus> histories();
  /// Times of the frame last recorded with a slot, which the device must have finished; none where another graph
  /// recorded it.
  std::span<const fg::vk::PassTime> passTimes(std::uint32_t slot) {
    return running_->device.executor().passTimes(slot);
  }

 private:
  struct Running {
    HostGraph host;
    DeviceGraph device;
    std::uint32_t frames = 0;  ///< Recorded.
  };
  struct Retired {
    std::unique_ptr<Running> graph;
    std::uint64_t until;  ///< Number of the frame before whose recording the device has finished with it.
  };

  [[nodiscard]] HostGraph declareHost(Denoiser& method, const HostView& view) const;

  const GpuDevice& device_;
  const ShownPicture& picture_;
  std::uint32_t framesInFlight_;
  std::uint64_t frames_ = 0;  // Recorded, of all graphs.
  std::unique_ptr<Running> running_;
  std::unique_ptr<Running> predecessor_;  // Until `running_` has recorded a frame.
  std::vector<Retired> retired_;
};

}  // namespace walr::host
