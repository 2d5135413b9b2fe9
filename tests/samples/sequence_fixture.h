#pragma once

#include <initializer_list>
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

}  // namespace walr::test
