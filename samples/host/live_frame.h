#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "framegraph/vulkan/frame_queue.h"
#include "framegraph/vulkan/memory.h"
#include "framegraph/vulkan/staged_buffer.h"
#include "passes/lint/input_linter.h"
#include "samples/denoise/device_graph.h"
#include "samples/denoise/gpu_device.h"
#include "samples/host/host_frame.h"
#include "samples/host/host_graph.h"
#include "samples/host/shaders/view_constants.h"

namespace walr::host {

/// State of `ShownPicture` between the frames that write it.
inline constexpr fg::ExternalState kShown{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                                          VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};

/// The image in the window. Each traced frame writes it; the window reads it each time it is drawn.
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

/// The host's frame for a window: a graph that writes a `ShownPicture`, and that may change between frames.
class LiveFrame {
 public:
  /// Where the next frame's histories come from.
  enum class Start { FromHistory, Anew };

  /// @param device, picture  must outlive this
  /// @param scene, specular  see `declareHostGraph`; the scene must outlive this
  /// @param framesInFlight   frames recorded with the same slot must be this many frames apart
  /// @param light            pixels of the frames that have a sample of light
  LiveFrame(const GpuDevice& device, const ShownPicture& picture, std::uint32_t framesInFlight,
            const LightPattern& light = {}, const gpu_render::GpuScene* scene = nullptr, bool specular = false);
  /// The device must have finished all frames.
  ~LiveFrame() = default;
  LiveFrame(const LiveFrame&) = delete;
  LiveFrame& operator=(const LiveFrame&) = delete;

  /// Apply new values of the method's settings to the next frame and keep all histories. This works if only constants
  /// have changed since `declare`. On the device it creates at most pipelines for new specialization constants.
  /// @returns false, without any effect, if more than constants has changed
  bool update(Denoiser& method, const HostView& view);

  /// Size of the frames of graphs that are declared from now on, at most that of the picture, at first the same. They
  /// fill the first columns and rows of the picture.
  void setExtent(fg::Extent extent) { extent_ = extent; }
  [[nodiscard]] fg::Extent extent() const { return extent_; }
  /// Size of the frame that the picture shows.
  [[nodiscard]] fg::Extent shown() const { return shown_; }

  /// Declare the graph of a method and a view, and create its device objects. Frames of the previous graph may still be
  /// in flight.
  /// @param start  `FromHistory` takes over the histories of the previous graph where they fit
  /// @throws see `declareHostGraph` and `DeviceGraph`; the previous graph then stays in use
  void declare(Denoiser& method, const HostView& view, Start start);
  [[nodiscard]] bool declared() const { return running_ != nullptr; }
  /// Declare the graph of a method and a view without any effect.
  /// @throws see `declareHostGraph`
  void check(Denoiser& method, const HostView& view) const { (void)declareHost(method, view); }
  /// Drop all graphs, and trace another scene in those that are declared from now on. The device must have finished all
  /// frames.
  void changeScene(const gpu_render::GpuScene* scene);

  /// @param view  its edges are in pixels of the picture
  void record(const fg::vk::Frame& recorded, const HostFrame& frame, const ViewConstants& view);

  [[nodiscard]] fg::vk::Executor& executor() { return running_->device.executor(); }
  [[nodiscard]] const fg::Graph& graph() const { return running_->host.graph; }
  [[nodiscard]] const fg::Plan& plan() const { return running_->device.plan(); }
  /// State of the method's histories before the next frame, in the order of `fg::GraphDesc::histories`.
  [[nodiscard]] std::vector<fg::vk::HistoryStatus> histories();
  /// Times of the frame last recorded with a slot, which the device must have finished. Empty if a previous graph
  /// recorded that frame.
  std::span<const fg::vk::PassTime> passTimes(std::uint32_t slot) {
    return running_->device.executor().passTimes(slot);
  }

  /// Check the inputs of the same frame and of those before it, if the view asks for it (`HostView::lint`).
  void lint(std::uint32_t slot);
  /// What looks wrong in the frames that were checked since the graph was declared.
  [[nodiscard]] std::vector<LintFinding> findings() const;

  /// The rays that the device traced in the same frame; nothing if it does not trace or has no times of that frame.
  std::optional<TracedRays> traced(std::uint32_t slot);

 private:
  struct Unchecked {
    std::uint32_t slot;
    FrameDescription camera;
    fg::Extent extent;
    bool continues;
  };
  struct Running {
    HostGraph host;
    DeviceGraph device;
    std::optional<fg::vk::StagedBuffer> rays;    ///< Of `HostGraph::rays`.
    std::optional<fg::vk::StagedBuffer> counts;  ///< Of `HostGraph::lint`.
    InputLinter linter;
    std::deque<Unchecked> unchecked = {};  ///< Frames that the linter has not seen yet, earliest first.
    std::uint32_t frames = 0;              ///< Number of recorded frames.
  };
  struct Retired {
    std::unique_ptr<Running> graph;
    std::uint64_t until;  ///< Once this many frames are recorded, the device no longer uses the graph.
  };

  /// A buffer that receives a buffer of the graph.
  std::optional<fg::vk::StagedBuffer> readBack(DeviceGraph& device, const HostGraph& host,
                                               const std::optional<fg::Buffer>& buffer) const;
  [[nodiscard]] HostGraph declareHost(Denoiser& method, const HostView& view) const;

  const GpuDevice& device_;
  const ShownPicture& picture_;
  std::uint32_t framesInFlight_;
  LightPattern light_;
  const gpu_render::GpuScene* scene_;
  bool specular_;
  fg::Extent extent_;
  fg::Extent shown_;
  std::uint64_t frames_ = 0;  // Number of recorded frames, of all graphs.
  std::unique_ptr<Running> running_;
  std::unique_ptr<Running> predecessor_;  // Kept until `running_` has recorded a frame.
  std::vector<Retired> retired_;
};

}  // namespace walr::host
