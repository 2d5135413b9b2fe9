#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string_view>

#include "shaders/shaders.h"

namespace walr {
namespace {

// A choice that only decides which inputs are read is a specialization constant and needs no module of its own; see
// fg::PassBuilder::unread. When these limits were set there were 87 modules of 2.1 MB, after 220 of 6.8 MB; formats of
// the result, guides joined with accumulation, and residuals took seven more, light direction one, because it writes an
// image that the reconstruction does not have, and FLNR nine: its network four, and the regression on more guides six,
// while one of FLR's became needless. Every module costs compile time in every build, bytes in every program that links
// the library, and an entry in the lists of shaders.
constexpr std::size_t kMostModules = 89;
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
