#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "samples/sequence/layout.h"

namespace walr {

/// A layout that a user has described: which channel of the files holds which channel of walr's own layout.
struct ChannelMap {
  std::map<std::string, std::string> channels;  ///< Names in the files, by walr's names, such as "Albedo.R".
  std::vector<Plane> planes;
  std::vector<Plane> specular;
  std::vector<AddedLight> added;
  Layout layout;                  ///< Refers to the three above.
  bool depthIsDistance = false;   ///< Depth is the distance from the camera instead of the depth along its axis.
  bool lightTimesAlbedo = false;  ///< The lights are multiplied by the albedo.

  ChannelMap() = default;
  ChannelMap(const ChannelMap&) = delete;
  ChannelMap& operator=(const ChannelMap&) = delete;
};

/// Read a map of channels, a JSON object (samples/docs/sequences.md).
/// @throws InputError naming the file and the member
void readChannelMap(const std::filesystem::path& path, ChannelMap& map);

/// Convert what was read by a map: depth along the axis, and lights without albedo.
void convertByMap(const ChannelMap& map, Frame& frame);

/// Divide a light by its albedo; 0 where there is none. Both may be empty.
void divideByAlbedo(Image& light, const Image& albedo);

}  // namespace walr
