#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string_view>

#include "shaders/shaders.h"

namespace walr {
namespace {

// A choice that only decides which inputs are read, or how they are computed with, is a specialization constant and
// needs no module of its own; see fg::PassBuilder::unread. A choice of what is written, or of the format of an image,
// takes a module. Every module costs compile time in every build, bytes in every program that links the library, and an
// entry in the lists of shaders.
constexpr std::size_t kMostModules = 88;
constexpr std::size_t kMostBytes = 3'000'000;

TEST(ShaderModules, AreFew) {
  EXPECT_LE(std::size(shaders::kAll), kMostModules);
}

TEST(ShaderModules, AreSmall) {
  std::size_t bytes = 0;
  for (const fg::Shader* shader : shaders::kAll) bytes += shader->code.size_bytes();
  EXPECT_LE(bytes, kMostBytes);
  RecordProperty("bytes", static_cast<int>(bytes));
}

TEST(ShaderModules, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const fg::Shader* shader : shaders::kAll) EXPECT_TRUE(names.insert(shader->name).second) << shader->name;
}

TEST(ShaderModules, AreChosenByTheNamesOfTheirAxes) {
  EXPECT_EQ(shaders::temporalAccumulation({}).name, "temporal_accumulation");
  EXPECT_EQ(shaders::temporalAccumulation({.antilag = true}).name, "temporal_accumulation.antilag");
  EXPECT_EQ(shaders::temporalAccumulation({.taps = true, .packed = true}).name, "temporal_accumulation.taps.packed");
  EXPECT_EQ(shaders::temporalAntialiasingView({.kept = true}).name, "temporal_antialiasing.view.kept");
}

}  // namespace
}  // namespace walr
