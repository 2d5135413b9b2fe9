#include "samples/host/window/interactive.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <deque>
#include <future>
#include <optional>
#include <utility>

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>

#include "framegraph/vulkan/frame_queue.h"
#include "samples/host/follow_session.h"
#include "samples/host/live_frame.h"
#include "samples/host/resolution_control.h"
#include "samples/host/scene_loader.h"
#include "samples/host/window/interface.h"
#include "samples/host/window/presenter.h"

namespace walr::host {
namespace {

constexpr std::uint32_t kFramesInFlight = 2;
// Interval at which the window is redrawn while no new frame has been traced.
constexpr std::chrono::milliseconds kRefresh(16);
// The same while none is being traced, either, and the user has done nothing for this time: the interface shows what it
// showed, but for what has no event of the window's, such as a shader that was saved.
constexpr std::chrono::milliseconds kRest(250);

volatile std::sig_atomic_t interrupted = 0;

void interrupt(int /*signal*/) {
  interrupted = 1;
}

/// Appends the time of a frame and drops the oldest one of more than a few seconds' worth.
void remember(std::deque<float>& times, double milliseconds) {
  constexpr std::size_t kFrames = 240;
  times.push_back(static_cast<float>(milliseconds));
  if (times.size() > kFrames) times.pop_front();
}

/// The main loop of a window: traces frames on another thread, denoises them and draws the window.
class Show {
 public:
  Show(Tracer& tracer, const GpuDevice& device, Session& session, Window& window, const Surface& surface,
       fg::Extent extent, const ReloadShaders& reload)
      : tracer_(tracer),
        device_(device),
        session_(session),
        reload_(reload),
        window_(window),
        surface_(surface),
        picture_(device, extent),
        live_(device, picture_, kFramesInFlight, tracer.light(), tracer.gpuScene(), tracer.specular()),
        control_(extent),
        loader_(tracer, session),
        queue_(device.device().context(), device.device().queue(), kFramesInFlight),
        interface_(device, window, kFramesInFlight) {
    facts_.deviceTraces = tracer.gpuScene() != nullptr;
    if (facts_.deviceTraces) facts_.sceneBytes = tracer.gpuScene()->bytes();
  }

  ~Show() {
    if (next_.valid()) {
      next_.wait();
    }
    queue_.waitAll();
  }
  Show(const Show&) = delete;
  Show& operator=(const Show&) = delete;

  void run() {
    startTracing();
    take(next_.get());
    makePresenter();
    interface_.prepare(presenter_->renderPass(), queue_);
    while (!window_.closed() && interrupted == 0) {
      glfwPollEvents();
      const fg::Extent size = window_.size();
      if (size == fg::Extent{}) {
        glfwWaitEventsTimeout(std::chrono::duration<double>(kRefresh).count());
        continue;
      }
      // Drivers need not tell that a swapchain no longer fits its window.
      if (size != presentedSize_) makePresenter();
      openDropped();
      step();
    }
  }

 private:
  /// Starts to trace the next frame, unless the session is frozen or another scene is about to be shown.
  void startTracing() {
    if (loader_.done()) return;
    control_.setTarget(session_.targetMilliseconds);
    session_.extent = control_.extent();
    const bool needed = again_ || (change_ != GraphChange::None && !frameFits());
    if (const std::optional<Tracer::Request> request = session_.nextRequest(needed)) {
      again_ = false;
      next_ = std::async(std::launch::async, [this, request] { return tracer_.hostFrame(*request); });
    }
  }

  /// Read a file that the user has dropped onto the window, and show its scene once it is read and the frame that is
  /// being traced is taken. Until the first frame of the scene is traced, the last one of the old scene is shown.
  void openDropped() {
    if (const std::optional<std::filesystem::path> file = window_.takeDroppedFile()) loader_.start(*file);
    if (next_.valid() || !loader_.done()) return;
    queue_.waitAll();
    if (!loader_.finish()) return;
    live_.changeScene(tracer_.gpuScene());
    if (facts_.deviceTraces) facts_.sceneBytes = tracer_.gpuScene()->bytes();
    HostFrame none;
    none.extent = frame_.extent;
    frame_ = std::move(none);
    traced_ = fresh_ = false;
    startTracing();
  }

  void take(HostFrame frame) {
    frame_ = std::move(frame);
    traced_ = true;
    constexpr double kMilliseconds = 1000.0;
    if (!facts_.deviceTraces) {
      facts_.traced = frame_.traced;
      remember(facts_.tracingHistory, kMilliseconds * frame_.traced.seconds);
    }
    fresh_ = true;
    startTracing();
  }

  void makePresenter() {
    queue_.waitAll();
    presenter_.reset();
    presentedSize_ = window_.size();
    presenter_.emplace(device_, surface_.handle(), presentedSize_, picture_, kFramesInFlight, Interface::draw);
  }

  void follow() {
    switch (followSession(live_, session_, change_, frame_.extent)) {
      case Followed::Waits:
        return;
      case Followed::Updated:
        again_ = session_.frozen;  // One more frame shows the new settings, with the existing history.
        break;
      case Followed::Declared:
        lastSlot_.reset();
        // Without a history, and with no other frame in a session that is frozen, the frame at hand is denoised again.
        fresh_ = fresh_ || (traced_ && (change_ == GraphChange::Method || session_.frozen));
        break;
      case Followed::Refused:
        break;
    }
    change_ = GraphChange::None;
  }

  /// A view with a reference can only show frames that have one.
  [[nodiscard]] bool frameFits() const {
    return !session_.view().needsReference() || !frame_.referenceIndirect.empty() || tracer_.gpuScene() != nullptr;
  }

  void waitForFrame() {
    if (!next_.valid()) {
      startTracing();
    }
    if (!next_.valid()) {
      using Clock = std::chrono::steady_clock;
      const Clock::time_point start = Clock::now();
      const std::chrono::duration<double> longest = start < lastInput_ + kRest ? kRefresh : kRest;
      glfwWaitEventsTimeout(longest.count());
      if (const Clock::time_point end = Clock::now(); end < start + longest) lastInput_ = end;
    } else if (next_.wait_for(kRefresh) == std::future_status::ready) {
      take(next_.get());
    }
  }

  void step() {
    // Every traced frame is denoised: a new one is taken only after the current one has been recorded.
    if (!fresh_) {
      waitForFrame();
    }
    change_ = std::max(change_, session_.takeGraphChange());
    if (fresh_ && frame_.extent != live_.extent()) change_ = std::max(change_, GraphChange::Settings);
    if (change_ != GraphChange::None && (frameFits() || !live_.declared())) {
      follow();
      facts_.graphBytes = live_.executor().allocatedBytes();
      facts_.memory = deviceMemory(device_);
    }
    // One more frame shows the new shaders in a session that is frozen.
    if (reload_ && reload_(live_.graph().desc(), live_.executor()) > 0) again_ = session_.frozen;
    interface_.update(session_, live_, facts_, place());
    const fg::vk::Frame recorded = queue_.begin();
    const std::optional<std::uint32_t> image = presenter_->swapchain().acquire(recorded.slot);
    if (!image) {
      makePresenter();
      return;
    }
    // The device has finished the last frame recorded with this slot.
    if (lastSlot_ && (fresh_ || recorded.slot == *lastSlot_)) noteTimes(recorded.slot);
    if (fresh_ && frame_.extent != live_.extent()) fresh_ = false;  // The view needs another frame, and waits for it.
    if (std::exchange(fresh_, false)) {
      lastSlot_ = recorded.slot;
      live_.record(recorded, frame_, session_.viewConstants);
    }
    presenter_->record(recorded, *image, place(), live_.shown());
    queue_.submit(recorded, {.wait = presenter_->swapchain().acquired(recorded.slot),
                             .waitStage = VK_PIPELINE_STAGE_TRANSFER_BIT,
                             .signal = presenter_->swapchain().rendered(*image)});
    if (!presenter_->swapchain().present(*image)) {
      makePresenter();
    }
  }

  /// Takes the times of the frame last recorded with a slot. Without times, those of the frame before stay on display:
  /// the slot is of an earlier graph, or the device does not measure any.
  void noteTimes(std::uint32_t slot) {
    const auto times = live_.passTimes(slot);
    double sum = 0.0;
    for (const fg::vk::PassTime& pass : times) sum += pass.milliseconds;
    if (!times.empty()) {
      facts_.passTimes.assign(times.begin(), times.end());
      if (fresh_) remember(facts_.deviceHistory, sum);
    }
    const double tracing = facts_.deviceTraces ? 0.0 : facts_.tracingHistory.back();
    if (fresh_ && std::max(sum, tracing) > 0.0) control_.frameTook(std::max(sum, tracing));
    if (const auto traced = live_.traced(slot)) facts_.traced = *traced;
    live_.lint(slot);
    facts_.findings = live_.findings();
  }

  [[nodiscard]] Rectangle place() {
    const fg::Extent size = presenter_->swapchain().desc().extent;
    return fitPicture(picture_.desc().extent, {0, 0, std::max(1, static_cast<int>(size.width) - Interface::kPanelWidth),
                                               static_cast<int>(size.height)});
  }

  Tracer& tracer_;
  const GpuDevice& device_;
  Session& session_;
  const ReloadShaders& reload_;
  Window& window_;
  const Surface& surface_;
  ShownPicture picture_;
  LiveFrame live_;
  ResolutionControl control_;
  SceneLoader loader_;
  fg::vk::FrameQueue queue_;
  Interface interface_;
  std::optional<Presenter> presenter_;
  fg::Extent presentedSize_;               // Of the window when `presenter_` was made for it.
  std::optional<std::uint32_t> lastSlot_;  // Slot of the last frame that `live_` recorded.
  std::future<HostFrame> next_;
  std::chrono::steady_clock::time_point lastInput_;
  HostFrame frame_;
  FrameFacts facts_;
  bool traced_ = false;                       // `frame_` is of the scene that is shown.
  bool fresh_ = false;                        // `frame_` has not been recorded yet.
  bool again_ = false;                        // Trace one more frame, even if the session is frozen.
  GraphChange change_ = GraphChange::Method;  // Change of the session that the graph does not contain yet.
};

}  // namespace

GpuDevice::Options withWindows(GpuDevice::Options options) {
  options.instanceExtensions = Window::instanceExtensions();
  options.deviceExtensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  return options;
}

void runWindow(Tracer& tracer, GpuDevice& device, Session& session, fg::Extent extent, const ReloadShaders& reload) {
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  constexpr std::uint32_t kLeastHeight = 720;
  Window window("walr-host", {extent.width + static_cast<std::uint32_t>(Interface::kPanelWidth),
                              std::max(extent.height, kLeastHeight)});
  const Surface surface(window, device.instance());
  Show(tracer, device, session, window, surface, extent, reload).run();
}

}  // namespace walr::host
