#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string_view>
#include <tuple>

#include "shaders/shaders.h"

namespace walr {
namespace {

// A choice that only decides which inputs are read, or how they are computed with, is a specialization constant and
// needs no module of its own; see fg::PassBuilder::unread. A choice of what is written or kept in shared memory, or of
// the format of an image, takes a module. Every module costs compile time in every build, bytes in every program that
// links the library, and an entry in the lists of shaders. Specular light has modules of its own, so that diffuse light
// does not pay for it.
constexpr std::size_t kMostModules = 107;
constexpr std::size_t kMostBytes = 3'545'000;

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

// A pipeline takes layout and specialization from the shader that a pass declares, whichever of the two it runs.
TEST(ShaderModules, HaveTheSameInterfaceInHalves) {
  const auto bindingOf = [](const fg::ShaderBinding& b) {
    return std::tuple(b.name, b.set, b.binding, b.type, b.reads, b.writes, b.format, b.blockSize);
  };
  const auto constantOf = [](const fg::ShaderConstant& c) { return std::tuple(c.name, c.id); };
  std::size_t count = 0;
  for (const fg::Shader* shader : shaders::kAll) {
    if (shader->inHalves == nullptr) continue;
    const fg::Shader& halves = *shader->inHalves;
    ++count;
    EXPECT_TRUE(std::ranges::equal(shader->bindings, halves.bindings, {}, bindingOf, bindingOf)) << shader->name;
    EXPECT_TRUE(std::ranges::equal(shader->constants, halves.constants, {}, constantOf, constantOf)) << shader->name;
    EXPECT_EQ(shader->pushConstantSize, halves.pushConstantSize) << shader->name;
    EXPECT_TRUE(std::ranges::equal(shader->localSize, halves.localSize)) << shader->name;
  }
  EXPECT_EQ(count, 1U);
}

TEST(ShaderModules, AreChosenByTheNamesOfTheirAxes) {
  EXPECT_EQ(shaders::temporalAccumulation({}).name, "temporal_accumulation");
  EXPECT_EQ(shaders::temporalAccumulation({.antilag = true}).name, "temporal_accumulation.antilag");
  EXPECT_EQ(shaders::temporalAccumulation({.taps = true, .packed = true}).name, "temporal_accumulation.taps.packed");
  EXPECT_EQ(shaders::temporalAntialiasingView({.kept = true}).name, "temporal_antialiasing.view.kept");
}

}  // namespace
}  // namespace walr
