#pragma once

#include <filesystem>
#include <map>

#include "samples/image/exr.h"
#include "samples/sequence/frame.h"

namespace walr {

/// Names of the header attributes that hold a camera in the project's own layout.
inline constexpr const char* kViewAttribute = "worldToCamera";
inline constexpr const char* kPreviousViewAttribute = "previousWorldToCamera";
inline constexpr const char* kProjectionAttribute = "cameraToClip";
inline constexpr const char* kJitterAttribute = "jitter";
inline constexpr const char* kCutAttribute = "cameraCut";

/// Names of the header attributes that describe sparse light in the project's own layout.
inline constexpr const char* kLightGroupAttribute = "lightGroup";
inline constexpr const char* kLightOffsetAttribute = "lightOffset";

/// Read a `cameras.json`: an array `frames` of objects with `frame`, `view`, `prev_view` and `projection` (16 numbers
/// each, column-major), and optionally `jitter` (2 numbers, pixels, y down) and `cut` (true after a camera cut).
/// @returns cameras by frame number
/// @throws InputError naming file, frame and entry
std::map<int, Camera> readCameraFile(const std::filesystem::path& path);

/// Read a camera from the header attributes of a frame in the project's own layout. Jitter and cut are optional:
/// without them the jitter is zero and the frame follows no cut.
/// @throws InputError naming file and attribute
Camera readCameraAttributes(const ExrReader& file);

/// Which pixels of a frame have a sample of light.
struct SparseLight {
  LightPattern pattern;
  glm::ivec2 offset{0};  ///< See `FrameDescription::lightOffset`.
};

/// Read the sparse light of a frame in the project's own layout: all pixels have a sample without the attribute
/// `kLightGroupAttribute`.
/// @throws InputError naming file and attribute
SparseLight readLightAttributes(const ExrReader& file);

}  // namespace walr
