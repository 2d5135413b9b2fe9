#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "samples/metrics/display.h"

namespace walr {

/// An ffmpeg whose filter libvmaf computes VMAF (Li et al., "Toward a practical perceptual video quality metric",
/// 2016). It hardly sees fine noise, so that it is no judge of that.
class VmafTool {
 public:
  /// @param ffmpeg  the program, looked for along PATH
  /// @param model   a model's file; empty for the one that libvmaf brings
  /// @param whyNot  receives, in words, why there is none, and the way out
  static std::optional<VmafTool> find(const std::string& ffmpeg, const std::filesystem::path& model,
                                      std::string& whyNot);

  /// Program and model, for reports.
  [[nodiscard]] const std::string& description() const { return description_; }

  /// VMAF of each frame of a clip, 0 to 100. Identical frames have a little less than 100, and the first, which has no
  /// motion yet, less than the others.
  /// @param test, reference  files of a `Clip`
  /// @throws OutputError where ffmpeg fails
  [[nodiscard]] std::vector<double> scores(const std::filesystem::path& test, const std::filesystem::path& reference,
                                           fg::Extent extent) const;

 private:
  std::string ffmpeg_;
  std::string filter_;  ///< As a filter graph takes it, without the log's path.
  std::string description_;
};

/// Pictures as a display shows them, uncompressed in a file: 3 bytes a pixel, sRGB. The file is removed with
/// the clip.
class Clip {
 public:
  /// @throws OutputError
  explicit Clip(std::filesystem::path file);
  ~Clip();
  Clip(const Clip&) = delete;
  Clip& operator=(const Clip&) = delete;

  /// @param picture  3 components, linear in 0..1, as of `DisplayedPair`
  /// @throws OutputError
  void append(const Image& picture);
  /// The file with all pictures so far.
  /// @throws OutputError
  const std::filesystem::path& finished();

 private:
  void requireGood() const;

  std::filesystem::path file_;
  std::ofstream stream_;
};

}  // namespace walr
