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
/// 2016). VMAF is insensitive to fine noise, so do not judge noise by it.
class VmafTool {
 public:
  /// Find and test the program.
  /// @param ffmpeg  the program, which is searched along PATH
  /// @param model   model file; empty: libvmaf's own model
  /// @param whyNot  receives, if there is none, the reason and the remedy as text
  static std::optional<VmafTool> find(const std::string& ffmpeg, const std::filesystem::path& model,
                                      std::string& whyNot);

  /// Names of program and model, for reports.
  [[nodiscard]] const std::string& description() const { return description_; }

  /// VMAF of each frame of a clip, 0 to 100. Identical frames have a little less than 100. The first frame has less
  /// than the others, because it has no motion.
  /// @param test, reference  files written by `Clip`
  /// @throws OutputError if ffmpeg fails
  [[nodiscard]] std::vector<double> scores(const std::filesystem::path& test, const std::filesystem::path& reference,
                                           fg::Extent extent) const;

 private:
  std::string ffmpeg_;
  std::string filter_;  ///< Filter with its options for a filter graph, without the path of the log.
  std::string description_;
};

/// A file of uncompressed images in display values: sRGB, 3 bytes per pixel. The destructor removes the file.
class Clip {
 public:
  /// @throws OutputError
  explicit Clip(std::filesystem::path file);
  ~Clip();
  Clip(const Clip&) = delete;
  Clip& operator=(const Clip&) = delete;

  /// @param picture  3 components, linear in 0..1, as in `DisplayedPair`
  /// @throws OutputError
  void append(const Image& picture);
  /// The file with all images so far.
  /// @throws OutputError
  const std::filesystem::path& finished();

 private:
  void requireGood() const;

  std::filesystem::path file_;
  std::ofstream stream_;
};

}  // namespace walr
