#include "samples/host/session.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "samples/command_line/method_options.h"

namespace walr::host {

Session::Session(Tracer& tracer, std::string methodName, std::unique_ptr<Denoiser> method, const HostView& view,
                 const ViewConstants& constants, const FrameRange& frames, bool once)
    : viewConstants(constants),
      tracer_(tracer),
      choices_{.methodName = std::move(methodName), .method = std::move(method)},
      preset_(presetInUse(choices_.methodName, *choices_.method)),
      frames_(frames),
      once_(once),
      animationFrame_(frames.first),
      objectFrame_(frames.first),
      number_(frames.first) {
  chooseView(view);
  graphChange_ = GraphChange::None;
  chosen_ = false;
}

std::optional<Tracer::Request> Session::nextRequest(bool evenFrozen) {
  const bool ended = once_ && started_ && animationFrame_ == frames_.last;
  if (ended && !paused) {
    frozen = true;
    once_ = false;  // If the user resumes, the animation plays again.
  }
  if (frozen && !evenFrozen) {
    return std::nullopt;
  }
  if (started_ && !paused && !frozen) {
    if (animationFrame_ < frames_.last) {
      ++animationFrame_;
    } else if (frames_.first < frames_.last) {
      animationFrame_ = frames_.first;
      cut_ = true;
    }
  }
  Tracer::Request request;
  request.number = started_ ? ++number_ : number_;
  if (objectsMove) objectFrame_ = animationFrame_;
  request.animationFrame = objectFrame_;
  request.extent = extent;
  request.cut = std::exchange(cut_, false);
  request.resetHistory = std::exchange(reset_, false);
  request.reference = view().needsReference();
  request.resampledFrames = resample ? resampledFrames : 0;
  if (camera_) {
    request.view = camera_->view();
  } else if (!objectsMove) {
    request.view = tracer_.sceneCamera(animationFrame_);
  }
  started_ = true;
  return request;
}

void Session::note(GraphChange change) {
  preset_ = presetInUse(choices_.methodName, *choices_.method);
  graphChange_ = std::max(graphChange_, change);
  chosen_ = true;
}

void Session::chooseMethod(const std::string& name) {
  choices_.method = makeDenoiser(name);
  choices_.methodName = name;
  note(GraphChange::Method);
}

void Session::choosePreset(const std::string& name) {
  choices_.method->usePreset(name);
  note(GraphChange::Method);
}

void Session::settingsChanged() {
  // A slider tells of a change again when it is released, also after its value was refused.
  if (accepted_ && !chosen_ && SettingValues(*choices_.method) == accepted_->settings) return;
  note(GraphChange::Settings);
}

void Session::compareWith(const std::string& name, std::unique_ptr<Denoiser> method) {
  choices_.compared = std::move(method);
  choices_.comparedName = name;
  if (view().kind != HostView::Kind::Compare) return;
  choices_.view.compared = choices_.compared.get();
  note(GraphChange::Method);
}

void Session::chooseView(HostView view) {
  view.compared = view.kind == HostView::Kind::Compare ? choices_.compared.get() : nullptr;
  view.lint = choices_.view.lint;
  if (view == choices_.view) return;
  choices_.view = view;
  note(GraphChange::Settings);
}

void Session::chooseLint(bool lint) {
  if (lint == choices_.view.lint) return;
  choices_.view.lint = lint;
  note(GraphChange::Settings);
}

void Session::accept() {
  if (accepted_ && !chosen_) return;
  accepted_ = {choices_, SettingValues(*choices_.method)};
  chosen_ = false;
  refusal_.clear();
}

bool Session::refuse(const std::string& reason) {
  if (!accepted_ || !chosen_) return false;
  choices_ = accepted_->choices;
  accepted_->settings.restore(*choices_.method);
  preset_ = presetInUse(choices_.methodName, *choices_.method);
  chosen_ = false;
  refusal_ = "Not changed: " + reason;
  return true;
}

void Session::chooseCamera(CameraMode mode) {
  cameraMode_ = mode;
  if (mode == CameraMode::Scene) {
    camera_.reset();
  } else if (!camera_) {
    const glm::mat4 view = tracer_.sceneCamera(animationFrame_);
    const glm::vec4 bounds = tracer_.bounds();
    // Orbit around the point ahead at the depth of the scene's centre, or around a near one if the centre is behind.
    const float ahead = -(view * glm::vec4(glm::vec3(bounds), 1.0F)).z;
    camera_.emplace(view, glm::max(ahead, 0.1F * bounds.w));
  }
}

void Session::moveCamera(const CameraInput& input) {
  if (cameraMode_ == CameraMode::Orbit) {
    camera_->orbit(input);
  } else if (cameraMode_ == CameraMode::Fly) {
    camera_->fly(input);
  }
}

bool Session::grabEdge(float column, float reach) {
  heldEdge_ = nullptr;
  std::vector<int*> edges;
  if (view().kind == HostView::Kind::Split) edges = {&viewConstants.leftEdge, &viewConstants.rightEdge};
  if (view().kind == HostView::Kind::Compare) edges = {&viewConstants.middleEdge};
  for (int* const edge : edges) {
    const float distance = std::abs(column - static_cast<float>(*edge));
    if (distance > reach) continue;
    reach = distance;
    heldEdge_ = edge;
  }
  return heldEdge_ != nullptr;
}

void Session::moveEdge(float column) {
  if (heldEdge_ == nullptr) return;
  const int least = heldEdge_ == &viewConstants.rightEdge ? viewConstants.leftEdge : 0;
  const int most =
      heldEdge_ == &viewConstants.leftEdge ? viewConstants.rightEdge : static_cast<int>(tracer_.extent().width);
  const float whole = std::round(column);
  *heldEdge_ = whole > static_cast<float>(least) ? static_cast<int>(std::min(whole, static_cast<float>(most))) : least;
}

float Session::flySpeed() const {
  constexpr float kRadiiASecond = 0.3F;
  return kRadiiASecond * tracer_.bounds().w;
}

void Session::cutCamera() {
  cut_ = true;
  if (cameraMode_ != CameraMode::Scene) {
    const CameraMode mode = cameraMode_;
    camera_.reset();
    chooseCamera(mode);
    return;
  }
  const int count = frames_.last - frames_.first + 1;
  animationFrame_ = frames_.first + (animationFrame_ - frames_.first + count / 2) % count;
}

void Session::sceneChanged() {
  frames_ = {0, tracer_.lastAnimationFrame()};
  animationFrame_ = objectFrame_ = frames_.first;
  cameraMode_ = CameraMode::Scene;
  camera_.reset();
  frozen = false;
  once_ = false;
  started_ = false;
  graphChange_ = GraphChange::Method;
  refusal_.clear();
  if (autoExposure) viewConstants.stops = tracer_.exposure(frames_.first);
}

GraphChange Session::takeGraphChange() {
  return std::exchange(graphChange_, GraphChange::None);
}

}  // namespace walr::host
