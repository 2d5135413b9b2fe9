#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "passes/methods/denoiser.h"
#include "samples/host/camera_control.h"
#include "samples/host/host_graph.h"
#include "samples/host/setting_values.h"
#include "samples/host/shaders/view_constants.h"
#include "samples/host/tracer.h"
#include "samples/sequence/sequence.h"

namespace walr::host {

/// How the graph must change after a choice of the user.
enum class GraphChange {
  None,
  Settings,  ///< Settings of the method, or the view: the next frame continues from the existing histories.
  Method,    ///< Another method or preset: the next frame starts without history, so that methods can be compared.
};

/// What moves the camera: the scene's animation, or the user in one of two ways.
enum class CameraMode { Scene, Orbit, Fly };

/// The choices of a window's user. Independent of the window itself.
class Session {
 public:
  /// @param once  stop after the last frame; otherwise the animation starts again
  Session(Tracer& tracer, std::string methodName, std::unique_ptr<Denoiser> method, const HostView& view,
          const ViewConstants& viewConstants, const FrameRange& frames, bool once);
  ~Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// What to trace next; nullopt while the session is frozen. Advances the animation unless it is paused or frozen.
  /// @param evenFrozen  request a frame although the session is frozen
  std::optional<Tracer::Request> nextRequest(bool evenFrozen = false);

  void chooseMethod(const std::string& name);
  void choosePreset(const std::string& name);
  /// @param view  `HostView::compared` is set to the method of `compareWith`, and `HostView::lint` as by `chooseLint`
  void chooseView(HostView view);
  /// Choose whether the inputs are checked, in all views.
  void chooseLint(bool lint);
  /// Choose the method on the right of a comparison. At first it is `none`: the noisy light.
  void compareWith(const std::string& name, std::unique_ptr<Denoiser> method);
  void chooseCamera(CameraMode mode);
  /// Move the free camera.
  void moveCamera(const CameraInput& input);
  /// In the split view or a comparison, take hold of the edge that is nearest to a column of the picture.
  /// @param column  in pixels of the picture
  /// @param reach   largest distance from the edge, in the same unit
  /// @returns whether an edge is held
  bool grabEdge(float column, float reach);
  /// Move the held edge to a column. The edges stay in the picture and do not pass each other. Without a held edge this
  /// has no effect.
  void moveEdge(float column);
  void releaseEdge() { heldEdge_ = nullptr; }
  [[nodiscard]] bool holdsEdge() const { return heldEdge_ != nullptr; }
  /// To be called after settings of the method may have changed.
  void settingsChanged();
  /// Jump ahead by half the animation or, with a free camera, to the pose of the scene's camera.
  void cutCamera();
  void resetHistory() { reset_ = true; }
  /// To be called after the tracer has opened another scene: plays all of its animation, seen by its camera.
  void sceneChanged();

  /// The largest change since the last call.
  GraphChange takeGraphChange();
  /// To be called when a graph runs with the choices: methods, their settings and the view.
  void accept();
  /// Go back to the choices last accepted, because those made since then are refused.
  /// @returns false, without any effect, if none were accepted, or none made since then
  bool refuse(const std::string& reason);
  /// Why the last choice was refused, for the user; empty once another was accepted.
  [[nodiscard]] const std::string& refusal() const { return refusal_; }

  [[nodiscard]] const Tracer& tracer() const { return tracer_; }
  [[nodiscard]] const std::string& methodName() const { return choices_.methodName; }
  [[nodiscard]] Denoiser& method() { return *choices_.method; }
  /// See `presetInUse`.
  [[nodiscard]] const std::optional<std::string>& preset() const { return preset_; }
  [[nodiscard]] const std::string& comparedName() const { return choices_.comparedName; }
  [[nodiscard]] const HostView& view() const { return choices_.view; }
  /// Speed of the flying camera in scene units per second.
  [[nodiscard]] float flySpeed() const;
  [[nodiscard]] CameraMode cameraMode() const { return cameraMode_; }
  [[nodiscard]] int animationFrame() const { return animationFrame_; }
  [[nodiscard]] const FrameRange& frames() const { return frames_; }

  ViewConstants viewConstants;
  /// Whether a new scene gets the exposure that suits it.
  bool autoExposure = true;
  /// Size of the pictures; nullopt: the tracer's.
  std::optional<fg::Extent> extent;
  /// Whether indirect light is resampled from earlier frames; only if the tracer can (`Tracer::whyNotResampled`).
  bool resample = false;
  std::uint32_t resampledFrames = 20;  ///< From how many; engines take 20 to 30.
  double targetMilliseconds = 0.0;     ///< See `ResolutionControl::setTarget`.
  std::string message;                 ///< What the user should know of the scene; may be empty.
  /// Objects and lights move with the animation; otherwise they stand still, and only the camera moves.
  bool objectsMove = true;
  bool paused = false;  ///< The animation stands still; tracing continues.
  bool frozen = false;  ///< Nothing is traced.
  /// The user is dragging a slider. Changes that need a new graph wait until the slider is released.
  bool dragging = false;

 private:
  /// What a graph is made of.
  struct Choices {
    std::string methodName;
    std::shared_ptr<Denoiser> method;
    std::string comparedName = "none";
    std::shared_ptr<Denoiser> compared = makeDenoiser("none");
    HostView view = {};
  };
  struct Accepted {
    Choices choices;
    SettingValues settings;  ///< Of the method.
  };

  /// To be called after every choice.
  void note(GraphChange change);

  Tracer& tracer_;
  Choices choices_;
  std::optional<Accepted> accepted_;
  bool chosen_ = false;  // A choice was made that was neither accepted nor refused.
  std::string refusal_;
  std::optional<std::string> preset_;
  FrameRange frames_;
  bool once_;
  CameraMode cameraMode_ = CameraMode::Scene;
  std::optional<FreeCamera> camera_;
  int animationFrame_;
  int objectFrame_;  // Frame of the animation that objects and lights are in.
  int number_;
  bool started_ = false;
  bool cut_ = false;
  bool reset_ = false;
  GraphChange graphChange_ = GraphChange::None;
  int* heldEdge_ = nullptr;  // One of the edges in `viewConstants`; null: the user drags none.
};

}  // namespace walr::host
