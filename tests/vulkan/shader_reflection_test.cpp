#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "framegraph/tools/reflect.h"
#include "tests/vulkan/shaders.h"

namespace fg {

static bool operator==(const ShaderBinding& a, const ShaderBinding& b) {
  return a.name == b.name && a.set == b.set && a.binding == b.binding && a.type == b.type && a.reads == b.reads &&
         a.writes == b.writes && a.format == b.format && a.blockSize == b.blockSize;
}

static std::ostream& operator<<(std::ostream& out, const ShaderBinding& b) {
  return out << b.name << " at " << b.set << '.' << b.binding << ", type " << b.type << ", reads " << b.reads
             << ", writes " << b.writes << ", format " << b.format << ", block of " << b.blockSize;
}

namespace {

constexpr ShaderBinding kExpected[] = {
    {"separate", 0, 0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, true, false},
    {"combined", 0, 1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, true, false},
    {"source", 0, 2, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, true, false, VK_FORMAT_R32_SFLOAT},
    {"target", 0, 3, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, false, true, VK_FORMAT_R16G16B16A16_SFLOAT},
    {"inPlace", 0, 4, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, true, true, VK_FORMAT_R32_UINT},
    {"frame", 0, 5, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, true, false, VK_FORMAT_UNDEFINED, 64 + 8},
    {"Arguments", 0, 6, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, true, false},
    {"result", 0, 7, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, false, true},
    {"totals", 0, 8, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, true, true},
    {"assigned", 0, 9, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, true, false},
};

TEST(ShaderReflection, TellsWhatTheShaderReallyBinds) {
  const Shader& shader = test::shaders::reflected;
  EXPECT_EQ(shader.name, "reflected");
  ASSERT_FALSE(shader.code.empty());
  EXPECT_EQ(shader.code.front(), 0x07230203u) << "SPIR-V's magic number";
  ASSERT_EQ(shader.bindings.size(), std::size(kExpected)) << "a binding that is declared and never used is left out";
  for (std::size_t i = 0; i < std::size(kExpected); ++i) EXPECT_EQ(shader.bindings[i], kExpected[i]);
  EXPECT_EQ(shader.pushConstantSize, 16u + 4u);
  EXPECT_EQ(shader.localSize[0], 8u);
  EXPECT_EQ(shader.localSize[1], 4u);
  EXPECT_EQ(shader.localSize[2], 2u);
}

TEST(ShaderReflection, RefusesASamplerWithoutATexture) {
  std::ifstream file(SEPARATE_SAMPLER, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
  std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
  ASSERT_FALSE(words.empty());
  try {
    (void)tools::reflect(words);
    FAIL() << "it was not refused";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), "binding 'nearest' is a sampler without a texture: declare a sampler2D");
  }
}

TEST(ShaderReflection, LeavesNamesOutOfTheModule) {
#ifndef NDEBUG
  GTEST_SKIP() << "builds for debugging keep them";
#endif
  constexpr std::uint32_t kOpName = 5;
  constexpr std::size_t kHeaderWords = 5;
  const auto code = test::shaders::reflected.code;
  for (std::size_t at = kHeaderWords; at < code.size(); at += code[at] >> 16) {
    ASSERT_NE(code[at] >> 16, 0U) << "an instruction without a length, at word " << at;
    EXPECT_NE(code[at] & 0xffffU, kOpName) << "at word " << at;
  }
}

TEST(ShaderReflection, OrdersSpecializationConstantsById) {
  const auto constants = test::shaders::reflected.constants;
  ASSERT_EQ(constants.size(), 2u);
  EXPECT_EQ(constants[0].name, "sigma");
  EXPECT_EQ(constants[0].id, 1u);
  EXPECT_EQ(constants[1].name, "iterations");
  EXPECT_EQ(constants[1].id, 3u);
}

TEST(ShaderReflection, VariantsAreShadersOfTheirOwn) {
  const Shader& variant = test::shaders::reflectedWideGroups;
  EXPECT_EQ(variant.name, "reflected.wide-groups");
  EXPECT_EQ(variant.localSize[0], 32u);
  EXPECT_EQ(variant.bindings.size(), std::size(kExpected));
}

}  // namespace
}  // namespace fg
