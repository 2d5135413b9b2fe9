#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "samples/image/exr.h"
#include "tests/samples/exr_files.h"
#include "tests/samples/process.h"
#include "tests/samples/synthetic_sequence.h"
#include "tests/samples/temporary_directory.h"

namespace walr {

inline Image readPlane(const std::filesystem::path& file, const std::string& plane = "Indirect") {
  ExrReader reader(file);
  Image image(reader.width(), reader.height(), 3);
  const std::string prefix = plane.empty() ? "" : plane + ".";
  reader.read(
      std::vector<ExrReader::Target>{{prefix + "R", &image, 0}, {prefix + "G", &image, 1}, {prefix + "B", &image, 2}});
  return image;
}

inline void expectFinite(const Image& image) {
  EXPECT_TRUE(std::ranges::all_of(image.values(), [](float value) { return std::isfinite(value); }));
}

/// A file with the channels of Cycles' layout that are always read.
inline void writeCycles(const std::filesystem::path& file, test::ExrPart part, const Imath::Box2i& display) {
  part.channels = {"Depth.Z",   "DiffCol.B", "DiffCol.G", "DiffCol.R", "DiffInd.B", "DiffInd.G",
                   "DiffInd.R", "Normal.X",  "Normal.Y",  "Normal.Z",  "Vector.X",  "Vector.Y"};
  std::ofstream(file, std::ios::binary) << test::exrBytes({.parts = {part}, .display = display});
}

/// The program as users call it: exit codes, messages, files.
class ProgramTest : public testing::Test {
 protected:
  ProgramTest() { std::filesystem::create_directory(input); }

  static test::ProcessResult walr(std::vector<std::string> arguments, const test::ProcessOptions& options = {}) {
    arguments.insert(arguments.begin(), WALR_PROGRAM);
    return test::runProcess(arguments, options);
  }
  /// `walr denoise` from the input to the output folder, under the validation layer.
  [[nodiscard]] test::ProcessResult denoise(std::vector<std::string> more = {},
                                            const test::ProcessOptions& options = {}) const {
    std::vector<std::string> arguments = {"denoise", input.string(), "--output", output.string(), "--validate"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return walr(arguments, options);
  }
  [[nodiscard]] std::vector<std::string> outputFiles() const { return test::namesIn(output); }

  test::TemporaryDirectory directory;
  std::filesystem::path input = directory.path() / "in";
  std::filesystem::path output = directory.path() / "out";
  test::SyntheticSequence files{input, 24, 18};
};

}  // namespace walr
