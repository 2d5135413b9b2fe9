#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include <gtest/gtest.h>

#include "samples/errors.h"
#include "samples/sequence/sequence.h"
#include "tests/error_text.h"
#include "tests/samples/synthetic_sequence.h"
#include "tests/samples/temporary_directory.h"

namespace walr::test {

/// A folder for a synthetic sequence, and what reading it gives.
class SequenceFixture : public testing::Test {
 protected:
  explicit SequenceFixture(int width = 6, int height = 4) : files(directory.path(), width, height) {}

  [[nodiscard]] Sequence open(SequenceOptions options = {}) const { return {files.folder(), std::move(options)}; }
  void expectRefused(std::initializer_list<std::string_view> parts, const SequenceOptions& options = {}) const {
    fg::test::expectError<InputError>([&] { static_cast<void>(open(options)); }, parts);
  }

  TemporaryDirectory directory;
  SyntheticSequence files;
};

/// One value in all pixels of a plane of three colours.
inline void addColours(Channels& channels, const std::string& plane, std::array<float, 3> values) {
  for (std::size_t c = 0; c < 3; ++c) {
    Image& image = channels[plane + "." + "RGB"[c]] = Image(6, 4, 1);
    std::ranges::fill(image.values(), values[c]);
  }
}

}  // namespace walr::test
