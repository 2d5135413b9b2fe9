#pragma once

#include "passes/settings/settings.h"

namespace walr {

/// What a scene can contain and what its host does. Passes, textures and shader branches that a description makes
/// unnecessary are left out of the graph.
struct SceneDescription {
  bool cameraMotion = true;       ///< The camera moves.
  bool objectMotion = true;       ///< Something but the camera moves. If not, the host's motion texture is not read.
  bool jitter = true;             ///< Sample positions differ from pixel centres, and from frame to frame.
  bool sky = true;                ///< Some pixels show no surface, at `FrameDescription::skyDepth` and beyond.
  bool hostAntialiasing = false;  ///< The host has a temporal anti-aliasing of its own.
  bool resizing = false;          ///< Frames may change their size and keep their history.

  /// Every pixel shows the same surface in every frame until the history is reset: nothing has to be reprojected.
  [[nodiscard]] bool still() const { return !cameraMotion && !objectMotion && !jitter && !resizing; }

  friend bool operator==(const SceneDescription&, const SceneDescription&) = default;

  void visit(SettingVisitor& v) {
    v.visit({"scene.camera-motion", "The camera moves", "", 0, 1, "scene"}, cameraMotion);
    v.visit({"scene.object-motion", "Anything but the camera moves; off leaves the motion texture unread", "", 0, 1,
             "scene"},
            objectMotion);
    v.visit(
        {"scene.jitter", "Pixels are sampled off their centres, differently from frame to frame", "", 0, 1, "scene"},
        jitter);
    v.visit({"scene.sky", "Some pixels show no surface", "", 0, 1, "scene"}, sky);
    v.visit({"scene.host-antialiasing", "The host has a temporal anti-aliasing of its own", "", 0, 1, "host"},
            hostAntialiasing);
  }
};

}  // namespace walr
