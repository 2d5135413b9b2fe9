#include <cstring>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <span>
#include <stdexcept>

#include "framegraph/vulkan/error.h"
#include "tests/error_text.h"
#include "tests/samples/temporary_directory.h"
#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/graph_run.h"
#include "tests/vulkan/test_graphs.h"

namespace fg::test {
namespace {

using ExecutorTest = GpuTest;

TEST_F(ExecutorTest, ChainOfTransientsGivesTheSum) {
  Graph graph;
  const Texture out = chain(graph, 5, 6);
  GraphRun run(device(), graph);
  for (int i = 0; i < 3; ++i) {
    run.frame();
    EXPECT_EQ(run.texels<std::uint32_t>(out), filled(5 + 6));
  }
}

TEST_F(ExecutorTest, PingPongBetweenTwoTextures) {
  Graph graph;
  const Texture out = importOutput(graph, "out");
  Texture ping = fill(graph, "fill", graph.texture("ping", kTexture), 0);
  Texture pong = graph.texture("pong", kTexture);
  for (std::uint32_t i = 0; i < 5; ++i) {
    pong = add(graph, "iteration" + std::to_string(i), ping, pong, 1u << i);
    std::swap(ping, pong);
  }
  graph.exported(add(graph, "show", ping, out, 0), vk::kReadable);
  GraphRun run(device(), graph);
  run.frame();
  EXPECT_EQ(run.texels<std::uint32_t>(out), filled(31));
}

TEST_F(ExecutorTest, StorageReadAndInPlaceUpdate) {
  Graph graph;
  const Texture out = importOutput(graph, "out");
  Texture work = fill(graph, "fill", graph.texture("work", kTexture), 1);
  {
    auto pass = graph.compute("double", shaders::doubleInPlace);
    work = pass.update("image", work);
    pass.dispatch(kTexture.extent);
  }
  auto pass = graph.compute("copy", shaders::addFromStorage).load("source", work).constants(std::uint32_t{0});
  const Texture result = pass.store("target", out);
  pass.dispatch(kTexture.extent);
  graph.exported(result, vk::kReadable);
  GraphRun run(device(), graph);
  run.frame();
  auto expected = filled(1);
  for (std::uint32_t& texel : expected) texel *= 2;
  EXPECT_EQ(run.texels<std::uint32_t>(out), expected);
}

TEST_F(ExecutorTest, ReadsImportsAndWritesExports) {
  Graph graph;
  const Texture in = graph.import("in", kTexture, vk::kUploaded);
  const Texture out = importOutput(graph, "out");
  graph.exported(add(graph, "add", in, out, 1000), vk::kReadable);
  GraphRun run(device(), graph);
  std::vector<std::uint32_t> texels(constant(0).size());
  std::iota(texels.begin(), texels.end(), 7u);
  run.fill(in, texels);
  run.frame();
  for (std::uint32_t& texel : texels) texel += 1000;
  EXPECT_EQ(run.texels<std::uint32_t>(out), texels);
}

TEST_F(ExecutorTest, OwnsExportedTransients) {
  Graph graph;
  const Texture kept = fill(graph, "fill", graph.texture("kept", kTexture), 9);
  const ExternalState storageRead{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT,
                                  VK_IMAGE_LAYOUT_GENERAL};
  graph.exported(kept, storageRead);
  GraphRun first(device(), graph);
  first.frame();

  Graph reader;
  const Texture in = reader.import("in", kTexture, storageRead);
  const Texture out = importOutput(reader, "out");
  auto pass = reader.compute("copy", shaders::addFromStorage).load("source", in).constants(std::uint32_t{0});
  reader.exported(pass.store("target", out), vk::kReadable);
  pass.dispatch(kTexture.extent);
  GraphRun second(device(), reader);
  second.executor().bind(in, {first.executor().image(kept)});
  second.frame();
  EXPECT_EQ(second.texels<std::uint32_t>(out), filled(9));
}

struct UniformGraph {
  explicit UniformGraph(std::uint32_t factor, std::span<const std::byte> contents = {}) {
    const Texture target = importOutput(graph, "out");
    frame = contents.empty() ? graph.upload("frame", sizeof(Frame)) : graph.upload("frame", contents);
    auto pass = graph.compute("write", shaders::writeUniform).uniform("frame", frame).specialize("factor", factor);
    out = pass.store("target", target);
    pass.dispatch(kTexture.extent);
    graph.exported(out, vk::kReadable);
  }
  struct Frame {
    std::uint32_t pad = 0;
    std::uint32_t value = 0;
  };
  Graph graph;
  Buffer frame;
  Texture out;
};

TEST_F(ExecutorTest, EveryFrameInFlightSeesItsOwnUpload) {
  UniformGraph uniform(3);
  GraphRun run(device(), uniform.graph);
  std::vector<std::uint32_t> slots;
  for (std::uint32_t i = 0; i < 40; ++i) {
    run.executor().upload(uniform.frame, UniformGraph::Frame{0, i});
    slots.push_back(run.submitFrame());
    if (i % kFramesInFlight != kFramesInFlight - 1) continue;
    run.finish();
    for (std::uint32_t back = 0; back < kFramesInFlight; ++back) {
      EXPECT_EQ(run.texels<std::uint32_t>(uniform.out, slots[i - back]), constant(3 * (i - back)));
    }
  }
}

TEST_F(ExecutorTest, UploadedBytesStayUntilTheNextUpload) {
  UniformGraph uniform(1);
  GraphRun run(device(), uniform.graph);
  run.executor().upload(uniform.frame, UniformGraph::Frame{0, 77});
  for (int i = 0; i < 3; ++i) {
    run.frame();
    EXPECT_EQ(run.texels<std::uint32_t>(uniform.out), constant(77));
  }
}

TEST_F(ExecutorTest, UploadHoldsItsContentsUntilTheFirstUpload) {
  const UniformGraph::Frame contents{0, 55};
  UniformGraph uniform(1, std::as_bytes(std::span(&contents, 1)));
  GraphRun run(device(), uniform.graph);
  for (int i = 0; i < 3; ++i) {
    run.frame();
    EXPECT_EQ(run.texels<std::uint32_t>(uniform.out), constant(55));
  }
  run.executor().upload(uniform.frame, UniformGraph::Frame{0, 56});
  run.frame();
  EXPECT_EQ(run.texels<std::uint32_t>(uniform.out), constant(56));
}

TEST_F(ExecutorTest, UploadOfAnotherSizeIsRefusedByName) {
  UniformGraph uniform(1);
  GraphRun run(device(), uniform.graph);
  EXPECT_EQ(errorText([&] { run.executor().upload(uniform.frame, std::uint32_t{1}); }),
            "upload of 4 bytes into 'frame', which has 8");
}

TEST_F(ExecutorTest, IndirectDispatchReadsItsGroupCountsOnTheGpu) {
  Graph graph;
  const Texture out = importOutput(graph, "out");
  const Buffer arguments = groupCount(graph, "arguments", 2, 1);
  const Texture base = fill(graph, "fill", out, 1);
  auto twice = graph.compute("double", shaders::doubleInPlace);
  const Texture result = twice.update("image", base);
  twice.dispatchIndirect(arguments);
  graph.exported(result, vk::kReadable);
  GraphRun run(device(), graph);
  run.frame();
  auto expected = filled(1);
  for (std::uint32_t y = 0; y < 8; ++y) {
    for (std::uint32_t x = 0; x < 16; ++x) expected[y * kTexture.extent.width + x] *= 2;
  }
  EXPECT_EQ(run.texels<std::uint32_t>(out), expected);
}

TEST_F(ExecutorTest, AnAppendedConstantFollowsTheOthers) {
  Graph graph;
  const Buffer out = graph.import("out", BufferDesc{3 * sizeof(std::uint32_t)}, vk::kOverwritable);
  auto pass = graph.compute("count", shaders::groupCount).constants(std::uint32_t{7}).appendConstant(5);
  graph.exported(pass.store("arguments", out), vk::kReadable);
  pass.dispatch({1, 1});
  GraphRun run(device(), graph);
  run.frame();
  EXPECT_EQ(run.elements<std::uint32_t>(out, 0), (std::vector<std::uint32_t>{7, 5, 1}));
}

TEST_F(ExecutorTest, CallbackPassRecordsIntoTheFrame) {
  Graph graph;
  const Texture target = importOutput(graph, "out");
  const auto& functions = context().functions;
  Texture cleared;
  auto pass = graph.callback("clear", [&](const RecordContext& record) {
    const VkClearColorValue color = {.uint32 = {42, 0, 0, 0}};
    const VkImageSubresourceRange range = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    functions.vkCmdClearColorImage(record.commandBuffer, record.image(cleared), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                   &color, 1, &range);
  });
  cleared = pass.access(graph.texture("cleared", kTexture), Access::TransferWrite);
  graph.exported(add(graph, "add", cleared, target, 1), vk::kReadable);
  GraphRun run(device(), graph);
  run.frame();
  EXPECT_EQ(run.texels<std::uint32_t>(target), constant(43));
}

TEST_F(ExecutorTest, ACallbackThatNamesNoResourceIsAnError) {
  Graph graph;
  const Texture target = importOutput(graph, "out");
  auto pass = graph.callback("clear", [](const RecordContext& record) {
    EXPECT_THROW((void)record.image(Texture{}), std::out_of_range);
    EXPECT_THROW((void)record.view(Texture{}), std::out_of_range);
    EXPECT_THROW((void)record.buffer(Buffer{}), std::out_of_range);
  });
  const Texture nothing = pass.access(graph.texture("nothing", kTexture), Access::TransferWrite);
  graph.exported(add(graph, "add", nothing, target, 1), vk::kReadable);
  GraphRun run(device(), graph);
  run.frame();
}

TEST_F(ExecutorTest, ImportWithoutImageIsRefusedByName) {
  Graph graph;
  const Texture out = chain(graph, 0, 2);
  vk::Executor executor(context(), graph.desc(), compileFor(context(), graph));
  vk::FrameQueue queue(context(), device().queue());
  const vk::Frame frame = queue.begin();
  EXPECT_EQ(errorText<vk::Error>([&] { executor.record(frame.commandBuffer, frame.slot); }),
            "nothing is bound to import 'out': call Executor::bind before recording");
  EXPECT_THROW(executor.bind(out, {}), std::invalid_argument);
  EXPECT_THROW(executor.record(frame.commandBuffer, 2), std::out_of_range);
}

// Two frames in one command buffer, because synchronization validation looks at one command buffer at a time.
TEST_F(ExecutorTest, AnUploadWaitsUntilThePreviousFrameHasRead) {
  Graph graph;
  const Texture in = graph.import("in", kTexture, vk::kUploaded);
  graph.exported(add(graph, "add", in, importOutput(graph, "out"), 1), vk::kReadable);
  // In the state in which it was read, so that no barrier follows the read.
  graph.exported(in, {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                      VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
  GraphRun run(device(), graph);
  const vk::StagedImage image(context(), kTexture, run.executor().usage(in), vk::StagedImage::Direction::Upload,
                              kFramesInFlight, "in");
  run.executor().bind(in, image.external());
  vk::FrameQueue queue(context(), device().queue());
  const vk::Frame frame = queue.begin();
  image.recordUpload(frame.commandBuffer, 0);
  run.executor().record(frame.commandBuffer, frame.slot);
  image.recordUpload(frame.commandBuffer, 1);
  queue.submit(frame);
  queue.waitAll();
}

// Likewise. A graph that leaves the image out orders nothing between the copies.
TEST_F(ExecutorTest, AnUploadWaitsForTheOneBeforeIfNothingReadsIt) {
  const vk::StagedImage image(context(), kTexture, VK_IMAGE_USAGE_SAMPLED_BIT, vk::StagedImage::Direction::Upload,
                              kFramesInFlight, "in");
  vk::FrameQueue queue(context(), device().queue());
  const vk::Frame frame = queue.begin();
  image.recordUpload(frame.commandBuffer, 0);
  image.recordUpload(frame.commandBuffer, 1);
  queue.submit(frame);
  queue.waitAll();
}

/// The texels that a frame writes to a bound image of the host.
std::vector<std::uint32_t> frameInto(const vk::StagedImage& image, vk::Executor& executor, vk::FrameQueue& queue) {
  const vk::Frame frame = queue.begin();
  executor.record(frame.commandBuffer, frame.slot);
  image.recordReadback(frame.commandBuffer, frame.slot);
  queue.submit(frame);
  queue.waitAll();
  std::vector<std::uint32_t> texels(constant(0).size());
  std::memcpy(texels.data(), image.staging(frame.slot).data(), texels.size() * sizeof(texels[0]));
  return texels;
}

TEST_F(ExecutorTest, HostMayAlternateBetweenImages) {
  Graph graph;
  const Texture out = chain(graph, 0, 2);
  GraphRun run(device(), graph);
  using Direction = vk::StagedImage::Direction;
  std::vector<vk::StagedImage> images;
  for (int i = 0; i < 3; ++i) {
    images.emplace_back(context(), kTexture, run.executor().usage(out), Direction::Readback, kFramesInFlight, "turn");
  }
  vk::FrameQueue queue(context(), device().queue(), kFramesInFlight);
  for (std::size_t i = 0; i < 7; ++i) {
    const vk::StagedImage& image = images[i % images.size()];
    run.executor().bind(out, image.external());
    EXPECT_EQ(frameInto(image, run.executor(), queue), filled(2));
  }
  for (const vk::StagedImage& image : images) run.executor().forget(image.external());
}

// Vulkan may give an image the handle of one that is gone. A host that forgets the old one late keeps the new one.
TEST_F(ExecutorTest, ForgettingAnImageKeepsAnotherOneWithItsHandle) {
  Graph graph;
  const Texture out = chain(graph, 0, 2);
  GraphRun run(device(), graph);
  const vk::StagedImage image(context(), kTexture, run.executor().usage(out), vk::StagedImage::Direction::Readback,
                              kFramesInFlight, "again");
  const auto withIdentity = [&](std::uint64_t identity) {
    vk::ExternalImage external = image.external();
    external.identity = identity;
    return external;
  };
  run.executor().bind(out, withIdentity(2));
  run.executor().forget(withIdentity(1));
  vk::FrameQueue queue(context(), device().queue(), kFramesInFlight);
  EXPECT_EQ(frameInto(image, run.executor(), queue), filled(2));
  run.executor().forget(withIdentity(2));
  EXPECT_THROW(static_cast<void>(frameInto(image, run.executor(), queue)), vk::Error);
}

TEST_F(ExecutorTest, AnImportMayHaveMoreLevelsAndLayersThanWereDeclared) {
  Graph graph;
  const Texture out = chain(graph, 0, 2);
  GraphRun run(device(), graph);
  TextureDesc larger = kTexture;
  larger.mipLevels = 2;
  larger.arrayLayers = 3;
  const vk::StagedImage image(context(), larger, run.executor().usage(out), vk::StagedImage::Direction::Readback,
                              kFramesInFlight, "larger");
  run.executor().bind(out, image.external());
  vk::FrameQueue queue(context(), device().queue(), kFramesInFlight);
  EXPECT_EQ(frameInto(image, run.executor(), queue), filled(2));
  run.executor().forget(image.external());
}

TEST_F(ExecutorTest, HandlesAndSlotsThatItDoesNotHaveAreErrors) {
  Graph graph;
  chain(graph, 0, 2);
  GraphRun run(device(), graph, {.timestamps = true});
  vk::Executor& executor = run.executor();
  EXPECT_THROW((void)executor.usage(Texture{}), std::invalid_argument);
  EXPECT_THROW((void)executor.usage(Buffer{}), std::invalid_argument);
  EXPECT_THROW((void)executor.image(Texture{}), std::invalid_argument);
  EXPECT_THROW((void)executor.buffer(Buffer{}), std::invalid_argument);
  EXPECT_THROW(executor.resetHistory(History{}), std::invalid_argument);
  EXPECT_THROW((void)executor.historyStatus(History{}), std::invalid_argument);
  EXPECT_THROW((void)executor.passTimes(kFramesInFlight), std::out_of_range);
}

TEST_F(ExecutorTest, TimestampsNameEveryPass) {
  Graph graph;
  chain(graph, 0, 3);
  GraphRun run(device(), graph, {.timestamps = true});
  EXPECT_TRUE(run.executor().passTimes(0).empty()) << "nothing was recorded yet";
  run.frame();
  const auto times = run.executor().passTimes(0);
  ASSERT_EQ(times.size(), 4u);
  EXPECT_EQ(times.front().name, "fill");
  EXPECT_EQ(times.back().name, "last");
  double sum = 0.0;
  for (const vk::PassTime& time : times) {
    EXPECT_GE(time.milliseconds, 0.0) << time.name;
    sum += time.milliseconds;
  }
  EXPECT_GT(sum, 0.0);
  EXPECT_LT(sum, 10'000.0) << "four passes over 19 x 13 texels cannot take ten seconds";
}

TEST_F(ExecutorTest, APassLastsFromItsTimestampToTheNext) {
  vk::DeviceContext tampered = context();
  tampered.functions.vkGetQueryPoolResults = [](VkDevice /*device*/, VkQueryPool /*pool*/, std::uint32_t /*first*/,
                                                std::uint32_t count, std::size_t /*bytes*/, void* data,
                                                VkDeviceSize /*stride*/, VkQueryResultFlags /*flags*/) {
    for (std::uint64_t i = 0; i < count; ++i) static_cast<std::uint64_t*>(data)[i] = 1000 * i * i;
    return VK_SUCCESS;
  };
  Graph graph;
  chain(graph, 0, 3);
  GraphRun run({tampered, device().queue()}, graph, {.timestamps = true});
  run.frame();
  const auto times = run.executor().passTimes(0);
  ASSERT_EQ(times.size(), 4u);
  // Differences of squares are odd numbers.
  for (std::size_t i = 1; i < times.size(); ++i) {
    EXPECT_DOUBLE_EQ(times[i].milliseconds / times[0].milliseconds, 2.0 * double(i) + 1.0) << times[i].name;
  }
}

/// Names of the labels that were begun, and the number of those that were ended.
struct LabelLog {
  std::vector<std::string> begun;
  std::size_t ended = 0;
};
LabelLog labelLog;

TEST_F(ExecutorTest, EveryPassIsALabelledRegion) {
  vk::DeviceContext tampered = context();
  tampered.instance.vkCmdBeginDebugUtilsLabelEXT = [](VkCommandBuffer /*buffer*/, const VkDebugUtilsLabelEXT* label) {
    labelLog.begun.emplace_back(label->pLabelName);
  };
  tampered.instance.vkCmdEndDebugUtilsLabelEXT = [](VkCommandBuffer /*buffer*/) { ++labelLog.ended; };
  labelLog = {};
  Graph graph;
  chain(graph, 0, 3);
  GraphRun run({tampered, device().queue()}, graph);
  run.frame();
  EXPECT_EQ(labelLog.begun, (std::vector<std::string>{"fill", "add1", "add2", "last"}));
  EXPECT_EQ(labelLog.ended, labelLog.begun.size());
}

TEST_F(ExecutorTest, SameInputGivesTheSameBits) {
  CountingGraph counting;
  GraphRun first(device(), counting.graph);
  GraphRun second(device(), counting.graph);
  for (int i = 0; i < 4; ++i) {
    first.frame();
    second.frame();
    EXPECT_EQ(first.texels<std::uint32_t>(counting.count), second.texels<std::uint32_t>(counting.count));
  }
}

TEST_F(ExecutorTest, PlanOfAnotherDeviceIsRefusedByName) {
  Graph graph;
  chain(graph, 0, 3);
  Plan plan = compileFor(context(), graph);
  for (PlannedResource& resource : plan.resources) resource.size /= 2;
  expectError<vk::Error>([&] { const vk::Executor executor(context(), graph.desc(), plan); },
                         {"'link0' does not fit where the plan puts it"});
}

class PipelineCacheTest : public GpuTest {
 protected:
  void runWith(vk::PipelineCache& cache) const {
    Graph graph;
    const Texture out = chain(graph, 0, 2);
    GraphRun run(device(), graph, {.pipelineCache = cache.handle()});
    run.frame();
    EXPECT_EQ(run.texels<std::uint32_t>(out), filled(2));
  }
  const walr::test::TemporaryDirectory directory_;
  const std::filesystem::path file_ = directory_.path() / "pipeline_cache";
};

TEST_F(PipelineCacheTest, IsKeptInAFile) {
  vk::PipelineCache first(context(), file_);
  EXPECT_EQ(first.loadedBytes(), 0u);
  runWith(first);
  first.save();
  vk::PipelineCache second(context(), file_);
  // The rest is the hash of these bytes.
  EXPECT_EQ(second.loadedBytes(), std::filesystem::file_size(file_) - sizeof(std::uint64_t));
  runWith(second);
}

TEST_F(PipelineCacheTest, AFileWithOneWrongByteCountsAsEmpty) {
  vk::PipelineCache first(context(), file_);
  runWith(first);
  first.save();
  std::fstream file(file_, std::ios::binary | std::ios::in | std::ios::out);
  file.seekg(-1, std::ios::end);
  const char last = static_cast<char>(file.get());
  file.seekp(-1, std::ios::end);
  file.put(static_cast<char>(last ^ 1));
  file.close();
  vk::PipelineCache second(context(), file_);
  EXPECT_EQ(second.loadedBytes(), 0u);
  runWith(second);
}

TEST_F(PipelineCacheTest, DamagedFileCountsAsEmpty) {
  std::ofstream(file_) << "this is not a pipeline cache";
  vk::PipelineCache cache(context(), file_);
  EXPECT_EQ(cache.loadedBytes(), 0u);
  runWith(cache);
}

TEST_F(PipelineCacheTest, AFolderInThePlaceOfTheFileCountsAsEmptyAndIsNamed) {
  std::filesystem::create_directories(file_ / "inside");
  vk::PipelineCache cache(context(), file_);
  EXPECT_EQ(cache.loadedBytes(), 0u);
  runWith(cache);
  expectError<std::filesystem::filesystem_error>([&] { cache.save(); }, {file_.string()});
  const std::filesystem::directory_iterator left(directory_.path());
  EXPECT_EQ(std::distance(begin(left), end(left)), 1) << "a temporary file is left";
}

TEST_F(PipelineCacheTest, UnwritableFileIsNamed) {
  const std::filesystem::path nowhere = file_ / "no" / "such" / "folder";
  vk::PipelineCache cache(context(), nowhere);
  runWith(cache);
  expectError<std::filesystem::filesystem_error>([&] { cache.save(); }, {nowhere.string()});
}

}  // namespace
}  // namespace fg::test
