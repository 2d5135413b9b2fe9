#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "samples/image/image.h"
#include "samples/sequence/frame.h"

namespace walr::test {

/// The channels of one file: full name to image of one component.
using Channels = std::map<std::string, Image>;
/// A change to a frame before it is written.
using Edit = std::function<void(Channels&)>;

/// A tiny sequence in Blender's layout: a still camera four units in front of a wall with noisy light, and a row of sky
/// at the top if there is more than one row.
class SyntheticSequence {
 public:
  SyntheticSequence(std::filesystem::path folder, int width, int height)
      : folder_(std::move(folder)), width_(width), height_(height) {}

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::filesystem::path frameFile(int number) const;

  /// Write `noisy_FFFF.exr`.
  void writeFrame(int number, const Edit& edit = {}) const;
  /// Write `ref_FFFF.exr`.
  void writeReference(int number, const Edit& edit = {}) const;
  /// Write `cameras.json` with the frames in range.
  void writeCameras(int first, int last) const;
  /// All of the above.
  void write(int first, int last) const;

 private:
  std::filesystem::path folder_;
  int width_;
  int height_;
};

/// The same wall as one frame in the project's own conventions.
Frame projectFrame(int number, int width, int height);

/// Write channels unchanged, all of them as 32-bit floats.
void writeChannels(const std::filesystem::path& file, const Channels& channels);

/// Replace a text file.
void writeText(const std::filesystem::path& file, const std::string& text);
std::string readText(const std::filesystem::path& file);

}  // namespace walr::test
