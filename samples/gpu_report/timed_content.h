#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "framegraph/declare/graph.h"
#include "samples/denoise/packed_frame.h"
#include "samples/render/scene.h"
#include "samples/render/view.h"
#include "samples/render/world.h"
#include "samples/sequence/sequence.h"

namespace walr {

/// Frames that are timed in alternation.
inline constexpr std::size_t kTimedFrames = 2;

/// Consecutive frames that a method is timed on, in alternation.
struct TimedContent {
  std::string name;         ///< "synthetic", "scene" or "sequence".
  std::string description;  ///< Where the frames come from.
  fg::Extent extent;
  const Layout* layout = nullptr;
  std::array<PackedFrame, kTimedFrames> frames;
};

/// A wall and a slab that moves before it (`slabFrame`).
TimedContent syntheticContent(fg::Extent extent);
/// @throws InputError naming a sequence of less than two frames
void requireTwoFrames(const Sequence& sequence, const std::string& name);
/// Two frames from the middle of a sequence, at its own size.
/// @throws InputError naming a sequence of less than two frames, or a file that cannot be read
TimedContent sequenceContent(const Sequence& sequence, const std::string& name);

/// The path tracer with the built-in scene `turntable`, which the program holds embedded: objects that turn and slide.
/// It renders pictures of one sample per pixel, like those of a game, at any size.
class BuiltInScene {
 public:
  /// @param folder receives the scene's file
  /// @throws OutputError if the file cannot be written
  explicit BuiltInScene(const std::filesystem::path& folder);

  /// Trace a frame of the animation.
  [[nodiscard]] PackedFrame frame(fg::Extent extent, int number);
  /// The indirect light of this frame with many samples per pixel.
  [[nodiscard]] Image truth(fg::Extent extent, int number, std::uint32_t samples);
  [[nodiscard]] TimedContent content(fg::Extent extent);

 private:
  /// The camera of a frame, for which the scene's time is set.
  [[nodiscard]] render::View viewAt(fg::Extent extent, int number);

  render::Scene scene_;
  std::uint32_t camera_;
  render::World world_;
};

}  // namespace walr
