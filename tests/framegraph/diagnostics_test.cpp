#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "framegraph/compile.h"
#include "framegraph/diagnostic_codes.h"
#include "tests/framegraph/test_shaders.h"

namespace fg {
namespace {

using test::kColor;
using test::kSampled;
using test::recordNothing;

/// Serves every format that the table knows but one.
class LimitedModel final : public MemoryModel {
 public:
  explicit LimitedModel(VkFormat lacking) : lacking_(lacking) {}
  [[nodiscard]] MemoryRequirements texture(const TextureDesc& desc, VkImageUsageFlags usage) const override {
    return table_.texture(desc, usage);
  }
  [[nodiscard]] MemoryRequirements buffer(const BufferDesc& desc, VkBufferUsageFlags usage) const override {
    return table_.buffer(desc, usage);
  }
  [[nodiscard]] bool supports(VkFormat format, VkImageUsageFlags /*usage*/) const override {
    return format != lacking_;
  }
  [[nodiscard]] std::uint64_t bufferImageGranularity() const override { return 1; }

 private:
  VkFormat lacking_;
  TableMemoryModel table_;
};

constexpr std::array kFilterBindings = {
    ShaderBinding{"noisy", 0, 0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, true, false},
    ShaderBinding{"result", 0, 1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, false, true, VK_FORMAT_R16G16B16A16_SFLOAT},
    ShaderBinding{"frame", 0, 2, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, true, false, VK_FORMAT_UNDEFINED, 64}};
constexpr std::array kFilterConstants = {ShaderConstant{"kRadius", 0}};
/// A filter as reflection describes it.
constexpr Shader kFilter = {"filter", {}, kFilterBindings, kFilterConstants, 8, {8, 8, 1}};

class DiagnosticsTest : public ::testing::Test {
 protected:
  /// The texture that every case exports.
  Texture written(const char* name = "output") {
    const Texture texture = graph.texture(name, kColor);
    return graph.callback(std::string("write ") + name, recordNothing).store("o", texture);
  }
  void expect(std::string_view code, const std::string& pass, const std::string& resource, std::uint32_t line,
              const MemoryModel& memory = TableMemoryModel()) {
    const CompileResult result = compile(graph.desc(), memory);
    const auto found = std::ranges::find_if(result.diagnostics, [&](const Diagnostic& diagnostic) {
      return diagnostic.code == code && diagnostic.pass == pass && diagnostic.resource == resource &&
             diagnostic.where.line() == line;
    });
    EXPECT_NE(found, result.diagnostics.end()) << "wanted " << code << " in line " << line << ", got\n"
                                               << result.text();
  }
  /// A complete use of kFilter, from which cases leave out or change one thing.
  PassBuilder filter() {
    PassBuilder pass = graph.compute("filter", kFilter);
    const std::array<std::uint32_t, 2> constants = {};
    pass.constants(constants).specialize("kRadius", std::uint32_t{2}).dispatch(kColor.extent);
    return pass;
  }

  Graph graph;
};

TEST_F(DiagnosticsTest, InvalidHandle) {
  graph.callback("reader", recordNothing).load("i", Texture{});
  const auto line = __LINE__ - 1;
  expect(code::kInvalidHandle, "reader", "", line);
}

TEST_F(DiagnosticsTest, ReadNeverWritten) {
  const Texture texture = graph.texture("empty", kColor);
  graph.callback("reader", recordNothing).load("i", texture);
  const auto line = __LINE__ - 1;
  expect(code::kReadNeverWritten, "reader", "empty", line);
}

TEST_F(DiagnosticsTest, ReadOfALevelThatIsNeverWritten) {
  const Texture texture = graph.texture("pyramid", {VK_FORMAT_R32_SFLOAT, {64, 64}, 2});
  const Texture half = graph.callback("writer", recordNothing).access(texture, Access::StorageWrite, {0, 1, 0, 1});
  graph.callback("reader", recordNothing).access(half, Access::SampledRead, {1, 1, 0, 1});
  const auto line = __LINE__ - 1;
  expect(code::kReadNeverWritten, "reader", "pyramid", line);
}

TEST_F(DiagnosticsTest, CycleNamesItsPath) {
  auto a = graph.callback("a", recordNothing);
  const auto line = __LINE__ - 1;
  auto b = graph.callback("b", recordNothing);
  const Texture x = a.store("o", graph.texture("x", kColor));
  b.load("i", x);
  const Texture y = b.store("o", graph.texture("y", kColor));
  a.load("i", y);
  expect(code::kCycle, "a", "", line);
  EXPECT_NE(compile(graph.desc(), TableMemoryModel()).text().find("'a' -> 'b'"), std::string::npos);
}

TEST_F(DiagnosticsTest, StaleVersionRead) {
  const Texture old = written();
  const Texture updated = graph.callback("update", recordNothing).update("io", old);
  auto late = graph.callback("late", recordNothing);
  late.load("i", updated);
  late.load("old", old);
  const auto line = __LINE__ - 1;
  expect(code::kStaleVersionRead, "late", "output", line);
}

}  // namespace
}  // namespace fg
