#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "framegraph/check/diagnostic_codes.h"
#include "framegraph/compile/compile.h"
#include "framegraph/declare/topology.h"
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
  /// @param line of the fault; that before the call where none is given
  void expect(std::string_view code, const std::string& pass, const std::string& resource,
              std::uint32_t line = __builtin_LINE() - 1, const MemoryModel& memory = TableMemoryModel()) {
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
  expect(code::kInvalidHandle, "reader", "");
}

TEST_F(DiagnosticsTest, ReadNeverWritten) {
  const Texture texture = graph.texture("empty", kColor);
  graph.callback("reader", recordNothing).load("i", texture);
  expect(code::kReadNeverWritten, "reader", "empty");
}

TEST_F(DiagnosticsTest, ReadOfALevelThatIsNeverWritten) {
  const Texture texture = graph.texture("pyramid", {VK_FORMAT_R32_SFLOAT, {64, 64}, 2});
  const Texture half = graph.callback("writer", recordNothing).access(texture, Access::StorageWrite, {0, 1, 0, 1});
  graph.callback("reader", recordNothing).access(half, Access::SampledRead, {1, 1, 0, 1});
  expect(code::kReadNeverWritten, "reader", "pyramid");
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
  expect(code::kStaleVersionRead, "late", "output");
}

TEST_F(DiagnosticsTest, TwoWriters) {
  const Texture texture = graph.texture("target", kColor);
  (void)graph.callback("first", recordNothing).store("o", texture);
  (void)graph.callback("second", recordNothing).store("o", texture);
  expect(code::kTwoWriters, "second", "target");
}

TEST_F(DiagnosticsTest, ReadAndWrittenWithoutSayingInPlace) {
  const Texture texture = written();
  auto pass = graph.callback("both", recordNothing);
  pass.load("i", texture);
  (void)pass.store("o", texture);
  expect(code::kReadAndWritten, "both", "output");
}

TEST_F(DiagnosticsTest, ReadAndWrittenInDisjointLevelsIsFine) {
  const Texture pyramid = graph.texture("pyramid", {VK_FORMAT_R32_SFLOAT, {64, 64}, 2});
  Texture level = graph.callback("base", recordNothing).access(pyramid, Access::StorageWrite, {0, 1, 0, 1});
  auto pass = graph.callback("reduce", recordNothing);
  pass.access(level, Access::SampledRead, {0, 1, 0, 1});
  level = pass.access(level, Access::StorageWrite, {1, 1, 0, 1});
  graph.exported(level, kSampled);
  const CompileResult result = compile(graph.desc(), TableMemoryModel());
  EXPECT_TRUE(result.diagnostics.empty()) << result.text();
}

TEST_F(DiagnosticsTest, FormatUnsupportedNamesTheFallback) {
  const Texture texture = graph.texture("narrow", {VK_FORMAT_B10G11R11_UFLOAT_PACK32, {8, 8}});
  const auto line = __LINE__ - 1;
  (void)graph.callback("writer", recordNothing).store("o", texture);
  const LimitedModel model(VK_FORMAT_B10G11R11_UFLOAT_PACK32);
  expect(code::kFormatUnsupported, "", "narrow", line, model);
  EXPECT_NE(compile(graph.desc(), model).text().find("R16G16B16A16_SFLOAT"), std::string::npos);
}

TEST_F(DiagnosticsTest, ExtentMismatchNamesTheProducer) {
  const Texture half = graph.texture("half", {kColor.format, {kColor.extent.width / 2, kColor.extent.height / 2}});
  const Texture written = graph.callback("downsample", recordNothing).store("o", half);
  auto pass = graph.callback("filter", recordNothing);
  pass.texels(kColor.extent).load("i", written);
  expect(code::kExtentMismatch, "filter", "half");
  EXPECT_NE(compile(graph.desc(), TableMemoryModel()).text().find("written by 'downsample'"), std::string::npos);
}

TEST_F(DiagnosticsTest, AMipLevelOfTheRightExtentIsFine) {
  const Texture pyramid =
      graph.texture("pyramid", {kColor.format, {2 * kColor.extent.width, 2 * kColor.extent.height}, 2});
  auto pass = graph.callback("filter", recordNothing);
  pass.texels(kColor.extent).sideEffects();
  pass.access(pyramid, Access::StorageWrite, {1, 1, 0, 1});
  EXPECT_TRUE(compile(graph.desc(), TableMemoryModel()).ok());
}

TEST_F(DiagnosticsTest, ExtentMismatch) {
  auto pass = graph.callback("draw", recordNothing);
  pass.access(graph.texture("color", kColor), Access::ColorWrite);
  pass.access(graph.texture("depth", {VK_FORMAT_D32_SFLOAT, {8, 8}}), Access::DepthWrite);
  expect(code::kExtentMismatch, "draw", "depth");
}

TEST_F(DiagnosticsTest, ImportWithoutState) {
  const Texture texture = graph.import("host", kColor, {});
  graph.callback("reader", recordNothing).load("i", texture);
  expect(code::kImportWithoutState, "reader", "host");
}

TEST_F(DiagnosticsTest, ExportNeverWritten) {
  graph.exported(graph.texture("empty", kColor), kSampled);
  expect(code::kExportNeverWritten, "", "empty");
}

TEST_F(DiagnosticsTest, ExportOverwritten) {
  const Texture texture = written();
  (void)graph.callback("later", recordNothing).store("o", texture);
  graph.exported(texture, kSampled);
  expect(code::kExportOverwritten, "", "output");
}

TEST_F(DiagnosticsTest, ExportedTwice) {
  const Texture texture = written();
  graph.exported(texture, kSampled);
  graph.exported(texture, test::kTransferSource);
  expect(code::kExportedTwice, "", "output");
}

TEST_F(DiagnosticsTest, ExportWithoutLayout) {
  graph.exported(written(), {});
  expect(code::kExportWithoutLayout, "", "output");
}

TEST_F(DiagnosticsTest, HistoryNeverWritten) {
  const History history = graph.history("past", kColor);
  const auto line = __LINE__ - 1;
  graph.callback("reader", recordNothing).load("i", history.previous).sideEffects();
  expect(code::kHistoryNeverWritten, "", "past.previous", line);
}

TEST_F(DiagnosticsTest, ExportedHistoryNeverWritten) {
  const History history = graph.history("past", kColor);
  const auto line = __LINE__ - 1;
  graph.exported(history.previous, kSampled);
  expect(code::kHistoryNeverWritten, "", "past.previous", line);
}

TEST_F(DiagnosticsTest, HistoryWrittenTwice) {
  const History history = graph.history("past", kColor);
  const auto line = __LINE__ - 1;
  const Texture once = graph.callback("first", recordNothing).store("o", history.current);
  (void)graph.callback("second", recordNothing).store("o", once);
  expect(code::kHistoryWrittenTwice, "", "past.current", line);
}

TEST_F(DiagnosticsTest, HistoryOfTwoDifferentImages) {
  (void)graph.history("past", kColor);
  GraphDesc changed = graph.desc();
  std::get<TextureDesc>(changed.resources[changed.histories[0].previous].desc).extent = {16, 8};
  const std::vector<Diagnostic> found = diagnose(Topology(changed), TableMemoryModel());
  const auto about = std::ranges::find(found, code::kHistoryMismatch, &Diagnostic::code);
  ASSERT_NE(about, found.end());
  EXPECT_EQ(about->resource, "past.current");
}

TEST_F(DiagnosticsTest, BindingNotInShader) {
  auto pass = filter();
  pass.sample("noise", written());
  expect(code::kBindingNotInShader, "filter", "output");
}

TEST_F(DiagnosticsTest, AccessOfAShaderWithoutABinding) {
  auto pass = filter();
  static_cast<void>(pass.access(written(), Access::SampledRead));
  expect(code::kBindingNotInShader, "filter", "output");
}

TEST_F(DiagnosticsTest, BindingNotDeclared) {
  PassBuilder pass = graph.compute("filter", kFilter);
  const auto line = __LINE__ - 1;
  pass.dispatch(kColor.extent);
  expect(code::kBindingNotDeclared, "filter", "", line);
}

TEST_F(DiagnosticsTest, BindingWithAnotherAccess) {
  auto pass = filter();
  pass.load("noisy", written());
  expect(code::kBindingAccess, "filter", "output");
}

TEST_F(DiagnosticsTest, BindingWithAnotherFormat) {
  auto pass = filter();
  (void)pass.store("result", graph.texture("thin", {VK_FORMAT_R32_SFLOAT, kColor.extent}));
  expect(code::kBindingFormat, "filter", "thin");
}

TEST_F(DiagnosticsTest, BindingTwice) {
  auto pass = filter();
  pass.sample("noisy", written("one"));
  pass.sample("noisy", written("two"));
  expect(code::kBindingTwice, "filter", "two");
}

TEST_F(DiagnosticsTest, UnreadTextureThatThePassDoesNotSampleOtherwise) {
  auto pass = filter();
  pass.unread("noisy", written());
  expect(code::kUnreadStandIn, "filter", "output");
}

TEST_F(DiagnosticsTest, UnreadBufferThatThePassDoesNotLoadOtherwise) {
  const Buffer sums = graph.callback("make", recordNothing).store("out", graph.buffer("sums", {64}));
  graph.callback("late", recordNothing).unread("bound", sums);
  expect(code::kUnreadStandIn, "late", "sums");
}

TEST_F(DiagnosticsTest, UnreadTextureOfAnotherVersion) {
  const Texture old = written();
  const Texture updated = graph.callback("update", recordNothing).update("io", old);
  auto pass = graph.callback("late", recordNothing);
  pass.sample("read", updated).unread("bound", old);
  expect(code::kUnreadStandIn, "late", "output");
}

TEST_F(DiagnosticsTest, BufferTooSmall) {
  auto pass = filter();
  pass.uniform("frame", graph.upload("constants", 32));
  expect(code::kBufferTooSmall, "filter", "constants");
}

TEST_F(DiagnosticsTest, PushConstantSize) {
  PassBuilder pass = graph.compute("filter", kFilter);
  const auto line = __LINE__ - 1;
  pass.constants(std::uint32_t{1});
  expect(code::kPushConstantSize, "filter", "", line);
}

TEST_F(DiagnosticsTest, UnknownSpecializationConstant) {
  PassBuilder pass = graph.compute("filter", kFilter);
  const auto line = __LINE__ - 1;
  pass.specialize("kWidth", std::uint32_t{1});
  expect(code::kUnknownConstant, "filter", "", line);
}

TEST_F(DiagnosticsTest, SpecializationConstantNotSet) {
  (void)graph.compute("filter", kFilter);
  expect(code::kConstantNotSet, "filter", "");
}

TEST_F(DiagnosticsTest, HistoryAgeOutsideThePushConstants) {
  const History history = graph.history("past", kColor);
  PassBuilder pass = graph.compute("filter", kFilter);
  const auto line = __LINE__ - 1;
  pass.constants(std::uint64_t{0}).historyAge(history, 8);
  expect(code::kHistoryAge, "filter", "", line);
}

TEST_F(DiagnosticsTest, HistoryAgeOfAnotherGraph) {
  Graph other;
  (void)other.history("past", kColor);
  const History foreign = other.history("present", kColor);
  (void)graph.history("past", kColor);
  PassBuilder pass = graph.compute("filter", kFilter);
  const auto line = __LINE__ - 1;
  pass.constants(std::uint64_t{0}).historyAge(foreign, 4);
  expect(code::kHistoryAge, "filter", "", line);
  const std::string text = compile(graph.desc(), TableMemoryModel()).text();
  EXPECT_NE(text.find("a history of another graph"), std::string::npos) << text;
}

TEST_F(DiagnosticsTest, HistoryAgeAtAnOffsetThatIsNoMultipleOfFour) {
  const History history = graph.history("past", kColor);
  PassBuilder pass = graph.compute("filter", kFilter);
  const auto line = __LINE__ - 1;
  pass.constants(std::uint64_t{0}).historyAge(history, 2);
  expect(code::kHistoryAge, "filter", "", line);
}

TEST_F(DiagnosticsTest, DuplicatePassName) {
  graph.callback("twin", recordNothing).sideEffects();
  graph.callback("twin", recordNothing).sideEffects();
  expect(code::kDuplicateName, "twin", "");
}

TEST_F(DiagnosticsTest, DuplicateResourceName) {
  (void)graph.texture("twin", kColor);
  (void)graph.texture("twin", kColor);
  expect(code::kDuplicateName, "", "twin");
}

TEST_F(DiagnosticsTest, EmptyExtent) {
  (void)graph.texture("flat", {VK_FORMAT_R32_SFLOAT, {64, 0}});
  expect(code::kEmptyExtent, "", "flat");
}

TEST_F(DiagnosticsTest, SizesThatNoDeviceHas) {
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
  const std::vector<TextureDesc> textures{
      {VK_FORMAT_R16G16B16A16_SFLOAT, {1U << 31, 1U << 31}},
      {VK_FORMAT_R8_UNORM, {3'037'000'500, 3'037'000'500}},
      {.format = VK_FORMAT_R8_UNORM, .extent = {4, 4}, .arrayLayers = kMost},
      {.format = VK_FORMAT_R8_UNORM, .extent = {4, 4}, .mipLevels = kMost, .arrayLayers = 4},
      {.format = VK_FORMAT_R8_UNORM, .extent = {4, 4}, .mipLevels = 4},
  };
  for (const TextureDesc& texture : textures) {
    graph = Graph();
    const Texture huge = graph.texture("huge", texture);
    const auto line = __LINE__ - 1;
    graph.exported(graph.callback("write", recordNothing).store("o", huge), kSampled);
    expect(code::kTooLarge, "", "huge", line);
  }
  graph = Graph();
  (void)graph.buffer("huge", {std::numeric_limits<std::uint64_t>::max()});
  expect(code::kTooLarge, "", "huge");
}

TEST_F(DiagnosticsTest, EmptyDispatch) {
  (void)graph.compute("idle", kFilter);
  expect(code::kEmptyDispatch, "idle", "");
}

TEST_F(DiagnosticsTest, SubresourceOutOfRange) {
  graph.callback("reader", recordNothing).access(written(), Access::SampledRead, {1, 1, 0, 1});
  expect(code::kSubresourceRange, "reader", "output");
}

TEST_F(DiagnosticsTest, PassWithoutEffectIsAWarning) {
  auto pass = graph.callback("vain", recordNothing);
  const auto line = __LINE__ - 1;
  (void)pass.store("o", graph.texture("unseen", kColor));
  expect(code::kPassWithoutEffect, "vain", "", line);
  EXPECT_TRUE(compile(graph.desc(), TableMemoryModel()).ok());
}

TEST_F(DiagnosticsTest, AccessOfTheWrongKind) {
  graph.callback("reader", recordNothing).access(graph.upload("bytes", 64), Access::ColorWrite);
  expect(code::kAccessKind, "reader", "bytes");
}

TEST_F(DiagnosticsTest, ReadOnlyResourceWritten) {
  const History history = graph.history("past", kColor);
  (void)graph.callback("writer", recordNothing).store("o", history.previous);
  expect(code::kReadOnlyWritten, "writer", "past.previous");
}

TEST_F(DiagnosticsTest, IndirectArgumentsPastTheEndOrNoMultipleOfFour) {
  for (const std::uint64_t offset : {8U, 2U}) {
    SCOPED_TRACE(offset);
    graph = Graph();
    const Buffer arguments = graph.upload("arguments", 16);
    PassBuilder pass = graph.compute("filter", kFilter);
    const auto line = __LINE__ - 1;
    pass.dispatchIndirect(arguments, offset);
    expect(code::kIndirectArguments, "filter", "arguments", line);
  }
}

TEST_F(DiagnosticsTest, TwoLayoutsOfPartsOfAHistoryInOnePass) {
  TextureDesc desc = kColor;
  desc.mipLevels = 2;
  const History history = graph.history("past", desc);
  graph.callback("writer", recordNothing).access(history.current, Access::StorageWrite);
  auto pass = graph.callback("reader", recordNothing);
  pass.sideEffects();
  pass.access(history.previous, Access::SampledRead, {0, 1, 0, 1});
  pass.access(history.previous, Access::StorageRead, {1, 1, 0, 1});
  expect(code::kTwoLayouts, "reader", "past.previous");
}

TEST_F(DiagnosticsTest, TwoLayoutsInOnePass) {
  const Texture texture = written();
  auto pass = graph.callback("reader", recordNothing);
  pass.sample("a", texture);
  pass.load("b", texture);
  expect(code::kTwoLayouts, "reader", "output");
}

TEST_F(DiagnosticsTest, AllErrorsAreFoundAtOnce) {
  (void)graph.texture("flat", {VK_FORMAT_R32_SFLOAT, {64, 0}});
  graph.exported(written(), {});
  (void)graph.compute("idle", kFilter);
  const CompileResult result = compile(graph.desc(), TableMemoryModel());
  for (const std::string_view wanted : {code::kEmptyExtent, code::kExportWithoutLayout, code::kEmptyDispatch,
                                        code::kBindingNotDeclared, code::kConstantNotSet, code::kPushConstantSize}) {
    EXPECT_NE(std::ranges::find(result.diagnostics, wanted, &Diagnostic::code), result.diagnostics.end()) << wanted;
  }
  EXPECT_TRUE(result.plan.passes.empty());
}

TEST_F(DiagnosticsTest, ACompleteFilterHasNone) {
  auto pass = filter();
  pass.sample("noisy", written("noise")).uniform("frame", graph.upload("constants", 64));
  graph.exported(pass.store("result", graph.texture("filtered", kColor)), kSampled);
  const CompileResult result = compile(graph.desc(), TableMemoryModel());
  EXPECT_TRUE(result.diagnostics.empty()) << result.text();
}

}  // namespace
}  // namespace fg
