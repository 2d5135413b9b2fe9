#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "samples/sequence/frame.h"
#include "samples/sequence/layout.h"

namespace walr {

/// A range of frame numbers, both ends included.
struct FrameRange {
  static constexpr int kMost = 999'999'999;  ///< Largest number of a frame; file names have up to nine digits.

  int first = 0;
  int last = 0;
};

/// What to do with non-finite input values.
enum class NonFinitePolicy {
  Fail,     ///< Refuse the frame, naming file and channel.
  Replace,  ///< Accept the frame; the denoiser replaces such values before it averages anything.
};

struct SequenceOptions {
  std::optional<FrameRange> frames;  ///< Absent: all frames.
  LightWish light;                   ///< The light to read.
  std::string viewLayer;             ///< See `recognizeLayout`.
  std::string stereoView;            ///< See `ExrReader`.
  std::filesystem::path channelMap;  ///< See `readChannelMap`; empty: the layout is recognised.
  std::vector<int> cuts;             ///< Frames that follow a camera cut, in addition to those that the cameras show.
  NonFinitePolicy nonFinite = NonFinitePolicy::Fail;
  std::optional<InputConventions::MotionDepth> motionDepth;  ///< Absent: as the layout says.
  /// Of frames with a sample of indirect light at every pixel, keep those at the pixels of this pattern, other ones in
  /// each frame (`lightOffsetOfFrame`), to see what sparse light would cost. The other samples become 0.
  LightPattern keptLight;
  bool keepSomeDirect = false;  ///< The same of direct light, which is denoised, too.
};

/// A folder of frames. The constructor checks names, numbers, channels, sizes and cameras of all frames before any
/// pixel is read.
///
/// The images of all frames have the place of the smallest rectangle that holds the data windows of all frames,
/// whichever pixels a single file has. The cameras of the files belong to the display window, which is the same in all
/// frames.
class Sequence {
 public:
  /// One frame's files and camera.
  struct Entry {
    int number = 0;
    std::filesystem::path file;
    std::filesystem::path reference;  ///< Empty if there is none.
    std::filesystem::path specular;   ///< See `readSpecularFile`; empty unless wanted and there.
    Camera camera;                    ///< Of the images of `read`.
    PixelRect dataWindow;
    glm::ivec2 lightOffset{0};  ///< See `FrameDescription::lightOffset`; in the images of `read`.
    bool resetHistory = false;  ///< First frame, or a camera cut.
  };

  /// Scan a folder. Reads the header of every frame in range.
  /// @throws InputError
  Sequence(std::filesystem::path folder, SequenceOptions options);

  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  /// What the files hold.
  [[nodiscard]] const RecognizedLayout& layout() const { return layout_; }
  /// What a denoiser is told of the frames: the files' layout with `SequenceOptions::motionDepth`.
  [[nodiscard]] const Layout& denoiserLayout() const { return denoiserLayout_; }
  [[nodiscard]] fg::Extent extent() const {
    return {static_cast<std::uint32_t>(place_.size.x), static_cast<std::uint32_t>(place_.size.y)};
  }
  /// Where the images of all frames lie, and the picture.
  [[nodiscard]] const PixelRect& place() const { return place_; }
  [[nodiscard]] const PixelRect& displayWindow() const { return displayWindow_; }
  /// A frame without its images.
  [[nodiscard]] Frame describe(std::size_t index) const;
  [[nodiscard]] bool hasReferences() const;
  /// What is assumed because the files do not tell it, as a sentence for the user; empty if nothing is.
  [[nodiscard]] std::string assumption() const;
  /// See `ExrReader::lossy`; of the first frame.
  [[nodiscard]] bool lossy() const { return lossy_; }

  /// Read one frame with its reference. Several threads may read frames at the same time.
  /// @throws InputError
  [[nodiscard]] Frame read(std::size_t index) const;

 private:
  void scan();
  void checkHeaders();
  void chooseSpecularFiles();
  void checkDisplayWindow(const ExrReader& file) const;
  [[nodiscard]] RecognizedLayout layoutOf(const ExrReader& file) const;
  void placeImages();
  void readLight(const ExrReader& file, Entry& entry);
  void keepSomeLight();
  void markCuts();

  std::filesystem::path folder_;
  SequenceOptions options_;
  std::vector<Entry> entries_;
  RecognizedLayout layout_;
  Layout denoiserLayout_;
  bool lossy_ = false;
  PixelRect place_;
  PixelRect displayWindow_;
};

}  // namespace walr
