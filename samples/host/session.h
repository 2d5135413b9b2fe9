#pragma once

#include <memory>
#include <optional>
#include <string>

#include "passes/denoiser.h"
#include "samples/host/camera_control.h"
#include "samples/host/host_graph.h"
#include "samples/host/shaders/view_constants.h"
#include "samples/host/tracer.h"
#include "samples/sequence/sequence.h"

namespace walr::host {

/// What of the graph must follow what the user has chosen.
enum class GraphChange {
  None,
  Settings,  ///< Of the method, or the view: the next frame goes on from the histories there are.
  Method,    ///< Another method or preset: the next frame starts anew, so that methods can be compared.
};

/// Who moves the camera.
enum class CameraMode { Scene, Orbit, Fly };

/// All that the user of a window has chosen, without the window.
class Session {
 public:
  /// @param once  stop after the last frame; otherwise the animation starts again
  Session(const Tracer& tracer, std::string methodName, std::unique_ptr<Denoiser> method, const HostView& view,
          const ViewConstants& viewConstants, const FrameRange& frames, bool once);

  /// What to trace next; nothing while the session is frozen. Moves the animation on, unless it is paused or frozen.
  /// @param evenFrozen  the frame is needed all the same
  std::optional<Tracer::Request> nextRequest(bool evenFrozen = false);

  void chooseMethod(const std::string& name);
  void choosePreset(const std::string& name);
  void chooseView(const HostView& view);
  void chooseCamera(CameraMode mode);
  /// Move the free camera.
  void moveCamera(const CameraInput& input);
  /// A setting of the method has changed.
  void settingsChanged();
  /// Jump half the animation ahead, or, with a free camera, to where the scene's camera stands.
  void cutCamera();
  void resetHistory() { reset_ = true; }

  /// What has changed since the last call.
  GraphChange takeGraphChange();

  [[nodiscard]] const std::string& methodName() const { return methodName_; }
  [[nodiscard]] Denoiser& method() { return *method_; }
  /// See `presetInUse`.
  [[nodiscard]] const std::optional<std::string>& preset() const { return preset_; }
  [[nodiscard]] const HostView& view() const { return view_; }
  /// Of the flying camera, scene units a second.
  [[nodiscard]] float flySpeed() const;
  [[nodiscard]] CameraMode cameraMode() const { return cameraMode_; }
  [[nodiscard]] int animationFrame() const { return animationFrame_; }
  [[nodiscard]] const FrameRange& frames() const { return frames_; }

  ViewConstants viewConstants;
  bool paused = false;  ///< The animation stands still; tracing goes on.
  bool frozen = false;  ///< Nothing is traced.
  /// The user is dragging a setting: what takes time to make waits until it is let go.
  bool dragging = false;

 private:
  const Tracer& tracer_;
  std::string methodName_;
  std::unique_ptr<Denoiser> method_;
  std::optional<std::string> preset_;
  HostView view_;
  FrameRange frames_;
  bool once_;
  CameraMode cameraMode_ = CameraMode::Scene;
  std::optional<FreeCamera> camera_;
  int animationFrame_;
  int number_;
  bool started_ = false;
  bool cut_ = false;
  bool reset_ = false;
  GraphChange graphChange_ = GraphChange::None;
};

}  // namespace walr::host
