#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "passes/conventions/inputs.h"
#include "passes/lint/lint_finding.h"
#include "samples/sequence/frame.h"
#include "shaders/conventions/frame.h"

namespace walr {

/// Finds errors in what frames say of the things that mirrors show: their distance and their motion.
///
/// A mirror's pixel and its distance give a point. Where the picture shows that place, it must show a surface there:
/// else the point floats in the air, and the distance is another one. Where the picture shows the point itself, the
/// point's motion must be that surface's. So findings need mirrors, up to a roughness of .05, and things that are seen
/// both ways.
class ReflectionLinter {
 public:
  explicit ReflectionLinter(const InputConventions& conventions) : conventions_(conventions) {}

  /// Add a frame; one without the distance of what is reflected is passed over.
  void add(const Frame& frame, const FrameConstants& constants);

  /// What was found in all frames.
  [[nodiscard]] std::vector<LintFinding> findings() const;

 private:
  /// Points on a surface that the picture shows, and points in the air before one.
  struct Points {
    std::uint64_t seen = 0;
    std::uint64_t inAir = 0;
  };
  void addMirror(const Frame& frame, const FrameConstants& constants, glm::ivec2 pixel, float distance);
  /// @returns the pixel that shows the point, if one does
  std::optional<glm::ivec2> addPoint(const Frame& frame, const FrameConstants& constants, glm::vec3 point,
                                     Points& points);
  /// @param told as the frame holds it
  /// @param at   the pixel that shows the same point
  void addMotion(const Frame& frame, const FrameConstants& constants, glm::vec3 told, glm::ivec2 at);

  InputConventions conventions_;
  Points given_;                            ///< By the distance as it is given.
  Points fromEye_;                          ///< By what is left of it if it was measured from the eye.
  std::array<std::uint64_t, 4> motions_{};  ///< Points whose motion is as told, opposite, told in view space, not told.
};

}  // namespace walr
