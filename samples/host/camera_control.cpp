#include "samples/host/camera_control.h"

#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace walr::host {

FreeCamera::FreeCamera(const glm::mat4& view, float targetDistance) : distance_(targetDistance) {
  const glm::mat4 worldFromView = glm::inverse(view);
  const glm::vec3 forward(-worldFromView[2]);
  position_ = glm::vec3(worldFromView[3]);
  yaw_ = std::atan2(-forward.x, -forward.z);
  turn({0.0F, -std::asin(glm::clamp(forward.y, -1.0F, 1.0F))});
}

void FreeCamera::turn(const glm::vec2& angles) {
  // A camera that looks straight up or down has no defined right direction.
  constexpr float kSteepest = 0.499F * std::numbers::pi_v<float>;
  yaw_ -= angles.x;
  pitch_ = glm::clamp(pitch_ - angles.y, -kSteepest, kSteepest);
}

glm::mat3 FreeCamera::axes() const {
  const glm::vec3 back(std::sin(yaw_) * std::cos(pitch_), -std::sin(pitch_), std::cos(yaw_) * std::cos(pitch_));
  const glm::vec3 right(std::cos(yaw_), 0.0F, -std::sin(yaw_));
  return {right, glm::cross(back, right), back};
}

glm::vec3 FreeCamera::target() const {
  return position_ - axes()[2] * distance_;
}

void FreeCamera::orbit(const CameraInput& input) {
  const glm::vec3 pivot = target() - (axes()[0] * input.pan.x - axes()[1] * input.pan.y) * distance_;
  turn(input.turn);
  constexpr float kStep = 7.0F / 8.0F;
  distance_ *= std::pow(kStep, input.zoom);
  position_ = pivot + axes()[2] * distance_;
}

void FreeCamera::fly(const CameraInput& input) {
  turn(input.turn);
  position_ += axes() * (input.move * glm::vec3(1.0F, 1.0F, -1.0F));
}

glm::mat4 FreeCamera::view() const {
  glm::mat4 worldFromView(axes());
  worldFromView[3] = glm::vec4(position_, 1.0F);
  return glm::inverse(worldFromView);
}

}  // namespace walr::host
