#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace walr::host {

/// Camera movement that mouse and keyboard request in one step.
struct CameraInput {
  glm::vec2 turn{0.0F};  ///< Radians: x turns to the right, y down.
  glm::vec2 pan{0.0F};   ///< In image heights: x to the right, y down. Orbit only.
  float zoom = 0.0F;     ///< In steps; each moves an eighth of the way to the target. Orbit only.
  glm::vec3 move{0.0F};  ///< Scene units: right, up, forward. Fly only.
};

/// A camera without roll, +Y up, that turns around a point or flies.
class FreeCamera {
 public:
  /// Start at the pose of another camera, without its roll.
  /// @param view            world to view space, rigid
  /// @param targetDistance  distance to the point ahead that `orbit` turns around; scene units, above 0
  FreeCamera(const glm::mat4& view, float targetDistance);

  void orbit(const CameraInput& input);
  void fly(const CameraInput& input);

  /// World to view space.
  [[nodiscard]] glm::mat4 view() const;
  [[nodiscard]] const glm::vec3& position() const { return position_; }
  [[nodiscard]] glm::vec3 target() const;

 private:
  void turn(const glm::vec2& angles);
  [[nodiscard]] glm::mat3 axes() const;  // Columns: right, up, back.

  glm::vec3 position_;
  float yaw_ = 0.0F;    // Radians about +Y; 0 looks along -Z.
  float pitch_ = 0.0F;  // Radians; up is positive.
  float distance_;
};

}  // namespace walr::host
