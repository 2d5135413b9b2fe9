// The sample host without a window: runs its frame on a device under synchronization validation, and compares the
// result with that of the CPU.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "framegraph/compile/compile.h"
#include "framegraph/vulkan/driver_memory_model.h"
#include "passes/methods/denoiser.h"
#include "samples/command_line/usage_error.h"
#include "samples/denoise/frame_output.h"
#include "samples/denoise/gpu_denoiser.h"
#include "samples/denoise/gpu_device.h"
#include "samples/host/headless.h"
#include "samples/host/live_frame.h"
#include "samples/host/renderer.h"
#include "samples/host/tracer.h"
#include "samples/image/exr.h"
#include "samples/image/half.h"
#include "samples/image/tone_map.h"
#include "tests/error_text.h"
#include "tests/samples/host_tracing.h"
#include "tests/samples/temporary_directory.h"
#include "tests/vulkan/function_hooks.h"

namespace walr::host {
namespace {

// The camera starts to move in frame 4; the visible objects stand still.
constexpr FrameRange kFrames{2, 7};

class HostTest : public HostDeviceTest {
 protected:
  std::vector<RenderedFrame> render(const Renderer::Options& options, const std::string& method = "walr",
                                    const Tracer::Options& tracerOptions = tracing()) {
    Tracer tracer(tracerOptions);
    const std::unique_ptr<Denoiser> denoiser = makeDenoiser(method);
    Renderer renderer(gpu, *denoiser, kExtent, options);
    Tracer::Request request;
    request.reference = options.view.needsReference();
    std::vector<RenderedFrame> frames;
    renderFrames(tracer, renderer, kFrames, request, [&](const RenderedFrame& frame) { frames.push_back(frame); });
    return frames;
  }
};

Renderer::Options readAll() {
  Renderer::Options options;
  options.readComposite = true;
  options.readDenoised = true;
  return options;
}

// The traced frames in the precision of the textures.
std::map<int, Frame> tracedFrames() {
  Tracer tracer(tracing());
  std::map<int, Frame> frames;
  const auto roundToHalf = [](Image& image) {
    for (float& value : image.values()) {
      value = toHalf(value);
    }
  };
  for (int number = kFrames.first; number <= kFrames.last; ++number) {
    Frame frame = tracer.trace({.number = number, .animationFrame = static_cast<double>(number)});
    for (Image* image : {&frame.indirect, &frame.direct, &frame.albedo, &frame.emission}) {
      roundToHalf(*image);
    }
    frames[number] = std::move(frame);
  }
  return frames;
}

// One unit in the last place of a half float: the largest rounding error of a store, whatever the device's rounding
// mode.
float halfStep(float value) {
  constexpr float kSmallest = 0x1p-24F;
  return std::max(std::abs(value) * 0x1p-10F, kSmallest);
}

std::uint32_t channel(std::uint32_t texel, int c) {
  return (texel >> (8U * static_cast<std::uint32_t>(c))) & 0xFFU;
}

void expectToneMapped(const RenderedFrame& frame, const Image& lit) {
  for (std::size_t i = 0; i < frame.display.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const float expected = 255.0F * encodeSrgb(toneMap(lit.pixel(i)[static_cast<std::size_t>(c)]));
      // The error of rounding to a byte, and half a step for an imprecise power function of the device.
      ASSERT_NEAR(static_cast<float>(channel(frame.display[i], c)), expected, 1.0F) << "pixel " << i;
    }
  }
}

TEST_F(HostTest, CompositeAndToneMapAreThoseOfTheProcessor) {
  const std::map<int, Frame> traced = tracedFrames();
  const std::vector<RenderedFrame> frames = render(readAll());
  ASSERT_EQ(frames.size(), traced.size());
  double light = 0.0;
  for (const RenderedFrame& frame : frames) {
    const Frame& inputs = traced.at(frame.number);
    const Image expected = composite(frame.denoised, inputs.direct, inputs.albedo, inputs.emission);
    for (std::size_t i = 0; i < expected.values().size(); ++i) {
      ASSERT_NEAR(frame.composite.values()[i], expected.values()[i], halfStep(expected.values()[i]))
          << "frame " << frame.number << ", value " << i;
      light += expected.values()[i];
    }
    expectToneMapped(frame, frame.composite);
  }
  EXPECT_GT(light, 0.0);
}

TEST_F(HostTest, DenoisesAsTheMethodAloneInItsGraph) {
  const std::vector<RenderedFrame> frames = render(readAll());
  const std::unique_ptr<Denoiser> method = makeDenoiser("walr");
  GpuDenoiser alone(gpu, *method, kExtent, projectLayout());
  Tracer tracer(tracing());
  for (const RenderedFrame& frame : frames) {
    const Tracer::Request request{.number = frame.number, .animationFrame = static_cast<double>(frame.number)};
    const DenoisedFrame expected = alone.denoise(packFrame(tracer.trace(request)));
    EXPECT_TRUE(std::ranges::equal(frame.denoised.values(), expected.indirect.values())) << "frame " << frame.number;
  }
}

TEST_F(HostTest, FramesInFlightDoNotChangeABit) {
  for (const char* const method : {"walr", "svgf"}) {
    Renderer::Options options = readAll();
    options.framesInFlight = 1;
    const std::vector<RenderedFrame> one = render(options, method);
    for (const std::uint32_t inFlight : {2U, 3U}) {
      options.framesInFlight = inFlight;
      const std::vector<RenderedFrame> several = render(options, method);
      ASSERT_EQ(several.size(), one.size());
      for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(several[i].number, one[i].number);
        EXPECT_EQ(several[i].display, one[i].display) << method << ", " << inFlight << " in flight, frame " << i;
        EXPECT_TRUE(std::ranges::equal(several[i].composite.values(), one[i].composite.values()));
      }
    }
  }
}

TEST_F(HostTest, RefusesMoreFramesThanMayBeInFlight) {
  Tracer tracer(tracing());
  const std::unique_ptr<Denoiser> method = makeDenoiser("none");
  Renderer renderer(gpu, *method, kExtent, {.framesInFlight = 1});
  const HostFrame frame = packHostFrame(tracer.trace({}));
  EXPECT_FALSE(renderer.finish().has_value());
  renderer.submit(frame);
  EXPECT_THROW(renderer.submit(frame), std::logic_error);
  EXPECT_TRUE(renderer.finish().has_value());
}

TEST_F(HostTest, SplitViewShowsNoisyDenoisedAndReference) {
  Renderer::Options options;
  const auto show = [&](HostView::Kind kind) {
    options.view.kind = kind;
    return render(options).back().display;
  };
  const auto noisy = show(HostView::Kind::Noisy);
  const auto denoised = show(HostView::Kind::Denoised);
  const auto reference = show(HostView::Kind::Reference);
  options.viewConstants = {.leftEdge = 20, .rightEdge = 50, .middleEdge = 0, .gain = 1.0F, .bias = 0.0F, .stops = 0.0F};
  const auto split = show(HostView::Kind::Split);
  EXPECT_NE(noisy, denoised);
  EXPECT_NE(denoised, reference);
  for (std::size_t i = 0; i < split.size(); ++i) {
    const int x = static_cast<int>(i % kExtent.width);
    const std::uint32_t shown = x < 20 ? noisy[i] : x < 50 ? denoised[i] : reference[i];
    EXPECT_EQ(split[i], x == 20 || x == 50 ? 0xFFFFFFFFU : shown) << "pixel " << i;
  }
}

// Both methods denoise the same rays, each as it does alone: beside `walr`, the same again, one that reads the numbers
// of objects, and those that share few passes or none with it.
TEST_F(HostTest, ComparisonShowsTwoMethodsEachAsItIsAlone) {
  Renderer::Options options;
  options.viewConstants.middleEdge = 30;
  const std::string left = "walr";
  const std::vector<RenderedFrame> ofLeft = render(options, left);
  for (const std::string right : {"walr", "joint_bilateral", "svgf", "none"}) {
    const std::unique_ptr<Denoiser> compared = makeDenoiser(right);
    options.view = {.kind = HostView::Kind::Compare, .compared = compared.get()};
    const std::vector<RenderedFrame> together = render(options, left);
    options.view = {};
    const std::vector<RenderedFrame> ofRight = right == left ? ofLeft : render(options, right);
    ASSERT_EQ(together.size(), ofRight.size());
    for (std::size_t n = 0; n < together.size(); ++n) {
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < together[n].display.size(); ++i) {
        const int x = static_cast<int>(i % kExtent.width);
        const std::uint32_t alone = x < 30 ? ofLeft[n].display[i] : ofRight[n].display[i];
        wrong += together[n].display[i] != (x == 30 ? 0xFFFFFFFFU : alone) ? 1 : 0;
      }
      EXPECT_EQ(wrong, 0U) << right << ", frame " << n;
    }
    // Else times of passes beside each other could not be told apart.
    const auto isRight = [](const fg::vk::PassTime& pass) { return pass.name.starts_with(kComparedPrefix); };
    const auto& times = together.back().passTimes;
    EXPECT_GE(std::ranges::count_if(times, isRight), 3) << right;
    EXPECT_EQ(std::find_if_not(std::ranges::find_if(times, isRight), times.end(), isRight)->name, "tone map") << right;
  }
}

// The tracer leaves out the pixels without a sample, takes other ones in the next frame and says which, and the graph
// denoises them as `walr denoise` does.
TEST_F(HostTest, SparseLightIsTracedAndDenoised) {
  Tracer::Options tracerOptions = tracing();
  tracerOptions.light = {.columns = 2, .rows = 2};
  Renderer::Options options = readAll();
  options.light = tracerOptions.light;
  const std::vector<RenderedFrame> rendered = render(options, "walr", tracerOptions);
  Tracer tracer(tracerOptions);
  const std::unique_ptr<Denoiser> walr = makeDenoiser("walr");
  Layout layout = projectLayout();
  layout.conventions.light = tracerOptions.light;
  GpuDenoiser denoiser(gpu, *walr, kExtent, layout);
  glm::ivec2 before = lightOffsetOfFrame(tracerOptions.light, kFrames.first);
  for (const RenderedFrame& shown : rendered) {
    const Frame frame = tracer.trace({.number = shown.number, .animationFrame = double(shown.number)});
    EXPECT_EQ(frame.lightOffset, lightOffsetOfFrame(tracerOptions.light, static_cast<std::uint32_t>(shown.number)));
    EXPECT_EQ(frame.previousLightOffset, before);
    before = frame.lightOffset;
    for (std::size_t i = 0; i < frame.indirect.pixelCount(); ++i) {
      const glm::ivec2 inGroup(i % kExtent.width % 2, i / kExtent.width % 2);
      if (inGroup == frame.lightOffset) continue;
      for (const float channel : frame.indirect.pixel(i)) ASSERT_EQ(channel, 0.0F) << "pixel " << i;
    }
    EXPECT_TRUE(std::ranges::equal(denoiser.run(packFrame(frame)).lights.front().values(), shown.denoised.values()));
  }
}

VkFormat formatOf(const fg::GraphDesc& graph, const std::string& texture) {
  const auto found = std::ranges::find(graph.resources, texture, &fg::ResourceDecl::name);
  return std::get<fg::TextureDesc>(found->desc).format;
}

// The pipeline of the view depends on the texture's format alone, so that one renderer for each format is enough.
TEST_F(HostTest, EveryTextureCanBeViewed) {
  const fg::vk::DeviceContext& context = gpu.device().context();
  std::set<VkFormat> rendered;
  for (const std::string& method : denoiserNames()) {
    const std::unique_ptr<Denoiser> denoiser = makeDenoiser(method);
    const HostGraph whole = declareHostGraph(context, *denoiser, kExtent, {}, {});
    const std::vector<std::string> textures = viewableTextures(whole.graph.desc());
    EXPECT_GE(textures.size(), 9U) << method;
    for (const std::string& texture : textures) {
      const HostView view{HostView::Kind::Texture, texture};
      const HostGraph host = declareHostGraph(context, *denoiser, kExtent, view, {});
      const auto pass = std::ranges::find(host.graph.desc().passes, std::string("inspect"), &fg::PassDecl::name);
      EXPECT_NE(pass, host.graph.desc().passes.end()) << texture;
      const fg::CompileResult compiled = fg::compile(host.graph.desc(), fg::vk::DriverMemoryModel(context));
      EXPECT_TRUE(compiled.ok()) << texture << ": " << compiled.text();
      if (rendered.insert(formatOf(host.graph.desc(), texture)).second) {
        const Renderer renderer(gpu, *denoiser, kExtent, {.view = view});
      }
    }
  }
  EXPECT_GE(rendered.size(), 5U);
}

TEST_F(HostTest, TextureViewShowsValuesScaledAndShifted) {
  Renderer::Options options;
  options.view = {HostView::Kind::Texture, "normal"};
  options.viewConstants = {.leftEdge = 0, .rightEdge = 0, .middleEdge = 0, .gain = 0.5F, .bias = 0.5F, .stops = 0.0F};
  const std::vector<RenderedFrame> frames = render(options, "none");
  Tracer tracer(tracing());
  for (const RenderedFrame& frame : frames) {
    const Frame traced = tracer.trace({.number = frame.number, .animationFrame = static_cast<double>(frame.number)});
    for (std::size_t i = 0; i < frame.display.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        const float expected = 255.0F * (0.5F * traced.normal.pixel(i)[static_cast<std::size_t>(c)] + 0.5F);
        // The errors of rounding to a byte, and of rounding the normal to a half float.
        ASSERT_NEAR(static_cast<float>(channel(frame.display[i], c)), expected, 0.6F);
      }
    }
  }
}

TEST_F(HostTest, ExposureScalesTheLitImageBeforeTheToneMap) {
  Renderer::Options options = readAll();
  options.viewConstants.stops = 1.5F;
  for (const RenderedFrame& frame : render(options)) {
    Image brighter = frame.composite;
    for (float& value : brighter.values()) value *= std::exp2(options.viewConstants.stops);
    expectToneMapped(frame, brighter);
  }
}

TEST_F(HostTest, UnknownTextureIsNamedWithThoseThereAre) {
  fg::test::expectError<UsageError>(
      [&] {
        render({.view = {HostView::Kind::Texture, "nothing"}});
      },
      {"'nothing'", "'albedo'"});
}

/// Runs a window's frame without the window.
class LiveFrameTest : public HostTest {
 protected:
  /// @param change  of the frame
  void record(const std::function<void(HostFrame&)>& change = {}) {
    HostFrame frame = packHostFrame(tracer.trace({.number = number, .animationFrame = double(number)}));
    if (change) change(frame);
    ++number;
    const fg::vk::Frame recorded = queue.begin();
    live.record(recorded, frame, {});
    queue.submit(recorded);
  }
  std::vector<std::string> findings() {
    std::vector<std::string> names;
    for (const LintFinding& finding : live.findings()) names.emplace_back(finding.name);
    return names;
  }
  std::vector<std::uint32_t> ages() {
    std::vector<std::uint32_t> ages;
    for (const fg::vk::HistoryStatus& status : live.histories()) ages.push_back(status.age);
    return ages;
  }
  std::vector<std::uint32_t> all(std::uint32_t age) { return std::vector<std::uint32_t>(live.histories().size(), age); }

  Tracer tracer{tracing()};
  int number = kFrames.first;
  ShownPicture picture{gpu, kExtent};
  LiveFrame live{gpu, picture, 2};
  fg::vk::FrameQueue queue{gpu.device().context(), gpu.device().queue(), 2};
};

TEST_F(LiveFrameTest, AConstantChangesWithoutAnythingMadeAndHistoryGrows) {
  const std::unique_ptr<Denoiser> method = makeDenoiser("walr");
  EXPECT_FALSE(live.update(*method, {}));
  live.declare(*method, {}, LiveFrame::Start::FromHistory);
  for (int i = 0; i < 3; ++i) record();
  ASSERT_FALSE(ages().empty());
  EXPECT_EQ(ages(), all(3));
  // The function table may be replaced by one that counts calls, because only tests write to it.
  auto& context = const_cast<fg::vk::DeviceContext&>(gpu.device().context());
  const fg::vk::DeviceFunctions real = context.functions;
  fg::test::hookCreation(context);
  fg::test::hookState = {};
  for (const char* const value : {"1.5", "2.5", "3.5"}) {
    method->set("blocks.growth-errors", value);
    EXPECT_TRUE(live.update(*method, {}));
    record();
  }
  EXPECT_EQ(fg::test::hookState.calls, 0U);
  context.functions = real;
  EXPECT_EQ(ages(), all(6));
}

TEST_F(LiveFrameTest, APreviousCameraThatIsThisOneIsToldInTenFrames) {
  const std::unique_ptr<Denoiser> method = makeDenoiser("none");
  for (const bool wrong : {false, true}) {
    live.declare(*method, {.lint = true}, LiveFrame::Start::Anew);
    number = kFrames.first;
    for (int i = 0; i < 10; ++i) {
      record([&](HostFrame& frame) {
        Camera& camera = frame.inputs.frame.camera;
        if (wrong) camera.previousView = camera.view;
      });
    }
    EXPECT_EQ(findings(), wrong ? std::vector<std::string>{"camera-still"} : std::vector<std::string>{});
  }
}

// A window that waits for the next frame checks the last one first, whose slot comes again.
TEST_F(LiveFrameTest, FramesAreCheckedInTheirOrder) {
  const std::unique_ptr<Denoiser> method = makeDenoiser("none");
  live.declare(*method, {.lint = true}, LiveFrame::Start::Anew);
  for (int i = 0; i < 5; ++i) {
    record();
    record();
    queue.submit(queue.begin());
    const fg::vk::Frame last = queue.begin();
    live.lint(last.slot);
    queue.submit(last);
  }
  EXPECT_EQ(findings(), std::vector<std::string>{});
}

// Frames of the previous graph are in flight at every change.
// Neither camera nor objects move in the first frames, so that motion is that of the change in size alone: none.
TEST_F(LiveFrameTest, HistoryGoesOnWhenTheSizeChanges) {
  const std::unique_ptr<Denoiser> method = makeDenoiser("walr");
  const std::unique_ptr<Denoiser> other = makeDenoiser("svgf");
  constexpr std::array kSizes{kExtent, fg::Extent{61, 34}, fg::Extent{36, 20}, kExtent};
  const std::array<HostView, 3> views{HostView{}, HostView{HostView::Kind::Texture, "normal"},
                                      HostView{.kind = HostView::Kind::Compare, .compared = other.get()}};
  number = 0;
  std::uint32_t age = 0;
  fg::Extent before = kExtent;
  for (std::size_t i = 0; i < kSizes.size(); ++i) {
    live.setExtent(kSizes.at(i));
    live.declare(*method, {}, LiveFrame::Start::FromHistory);
    const Tracer::Request request{.number = number++, .extent = kSizes.at(i)};
    const HostFrame frame = tracer.hostFrame(request);
    EXPECT_EQ(frame.extent, kSizes.at(i));
    EXPECT_EQ(frame.constants.previousPixelFromPixel,
              glm::vec2(before.width, before.height) / glm::vec2(kSizes.at(i).width, kSizes.at(i).height));
    for (const float motion : frame.inputs.frame.motion.values()) ASSERT_NEAR(motion, 0.0F, 1e-3F);
    const fg::vk::Frame recorded = queue.begin();
    live.record(recorded, frame, {});
    queue.submit(recorded);
    EXPECT_EQ(live.shown(), kSizes.at(i));
    EXPECT_EQ(ages(), all(++age));
    before = kSizes.at(i);
  }
  // Every view at a size below that of the picture.
  live.setExtent(kSizes[1]);
  for (const HostView& view : views) {
    live.declare(*method, view, LiveFrame::Start::FromHistory);
    const fg::vk::Frame recorded = queue.begin();
    live.record(recorded, tracer.hostFrame({.number = number++, .extent = kSizes[1]}), {});
    queue.submit(recorded);
  }
  queue.waitAll();
}

TEST_F(LiveFrameTest, AnotherSceneStartsWithoutHistory) {
  const std::unique_ptr<Denoiser> method = makeDenoiser("walr");
  live.declare(*method, {}, LiveFrame::Start::FromHistory);
  for (int i = 0; i < 3; ++i) record();
  queue.waitAll();
  live.changeScene(nullptr);
  tracer.show(tracer.read(WALR_SCENES "/turntable.gltf"));
  EXPECT_FALSE(live.declared());
  live.declare(*method, {}, LiveFrame::Start::FromHistory);
  record();
  EXPECT_EQ(ages(), all(1));
}

TEST_F(LiveFrameTest, AnotherGraphTakesOverBetweenFrames) {
  const std::unique_ptr<Denoiser> method = makeDenoiser("walr");
  live.declare(*method, {}, LiveFrame::Start::FromHistory);
  for (const char* const texture : {"albedo", "normal", "denoised", "lit"}) {
    for (int i = 0; i < 2; ++i) record();
    const HostView view{HostView::Kind::Texture, texture};
    EXPECT_FALSE(live.update(*method, view));
    // The second call replaces a graph that has recorded no frame.
    live.declare(*method, {HostView::Kind::Noisy}, LiveFrame::Start::FromHistory);
    live.declare(*method, view, LiveFrame::Start::FromHistory);
  }
  record();
  const std::unique_ptr<Denoiser> other = makeDenoiser("svgf");
  live.declare(*other, {}, LiveFrame::Start::Anew);
  EXPECT_EQ(ages(), all(0));
  record();
  EXPECT_EQ(ages(), all(1));
  EXPECT_THROW(live.declare(*other, {HostView::Kind::Texture, "nothing"}, LiveFrame::Start::FromHistory), UsageError);
  record();
  EXPECT_EQ(ages(), all(2));
}

TEST_F(HostTest, WritesPicturesThatReadBack) {
  const test::TemporaryDirectory folder;
  Renderer::Options options;
  options.readComposite = true;
  const RenderedFrame frame = render(options).back();
  writeRenderedFrame(frame, kExtent, folder.path());
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "frame_0007.png"));
  ExrReader file(folder.path() / "frame_0007.exr");
  Image lit(file.width(), file.height(), 3);
  file.read(std::vector<ExrReader::Target>{{"R", &lit, 0}, {"G", &lit, 1}, {"B", &lit, 2}});
  EXPECT_TRUE(std::ranges::equal(lit.values(), frame.composite.values()));
}

/// The box with its tiles turned into a mirror.
std::filesystem::path boxWithMirror(const test::TemporaryDirectory& folder) {
  nlohmann::json scene = nlohmann::json::parse(std::ifstream(WALR_SCENES "/box.gltf"));
  for (nlohmann::json& material : scene["materials"]) {
    if (material["name"] == "tiles") {
      material["pbrMetallicRoughness"] = {
          {"baseColorFactor", {0.9, 0.9, 0.9, 1.0}}, {"metallicFactor", 1.0}, {"roughnessFactor", 0.0}};
    }
  }
  const std::filesystem::path file = folder.path() / "mirror.gltf";
  std::ofstream(file) << scene;
  return file;
}

/// Root mean square error after the tone map over the masked pixels.
double shownError(const Image& indirect, const Frame& frame, const std::vector<bool>& mask) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (!mask[i]) {
      continue;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const float albedo = frame.albedo.pixel(i)[c];
      const double difference =
          toneMap(albedo * indirect.pixel(i)[c]) - toneMap(albedo * frame.reference->indirect.pixel(i)[c]);
      sum += difference * difference;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

/// Pixels of a mirror in which another surface is reflected.
std::vector<bool> mirrorMask(const Frame& own, const Frame& shown) {
  std::vector<bool> mirror(shown.albedo.pixelCount());
  for (std::size_t i = 0; i < mirror.size(); ++i) {
    mirror[i] = own.albedo.pixel(i)[1] == 0.0F && shown.albedo.pixel(i)[1] > 0.0F;
  }
  return mirror;
}

/// SVGF's result for some frames with replaced mirrors, and the last of these frames.
struct DenoisedMirror {
  Frame own;
  Frame shown;
  Image indirect;
};
DenoisedMirror denoiseMirror(const GpuDevice& gpu, Tracer::Options options) {
  options.referenceSamples = 64;
  Tracer firstHit(options);
  options.gbuffer = render::GBufferMode::BehindMirrors;
  Tracer replaced(options);
  const std::unique_ptr<Denoiser> svgf = makeDenoiser("svgf");
  GpuDenoiser denoiser(gpu, *svgf, kExtent, projectLayout());
  DenoisedMirror result;
  for (int number = kFrames.first; number <= kFrames.last; ++number) {
    const bool last = number == kFrames.last;
    result.own = firstHit.trace({.number = number, .animationFrame = double(number)});
    result.shown = replaced.trace({.number = number, .animationFrame = double(number), .reference = last});
    result.indirect = denoiser.run(packFrame(result.shown)).lights.front();
  }
  return result;
}

// In a mirror the denoiser gets depth and albedo of the reflected surface, which lies farther away than the mirror, and
// must remove noise there, too: half of the noise is what four samples per pixel would leave.
TEST_F(HostTest, WhatAMirrorShowsIsDenoised) {
  const test::TemporaryDirectory folder;
  Tracer::Options options = tracing();
  options.scene = boxWithMirror(folder);
  options.specular = true;
  const DenoisedMirror result = denoiseMirror(gpu, options);
  const std::vector<bool> mirror = mirrorMask(result.own, result.shown);
  ASSERT_GT(std::ranges::count(mirror, true), 200);
  for (std::size_t i = 0; i < mirror.size(); ++i) {
    const float shown = result.shown.depth.values()[i];
    const float own = result.own.depth.values()[i];
    ASSERT_TRUE(mirror[i] ? shown > own : shown >= own) << "pixel " << i;
  }
  EXPECT_LT(shownError(result.indirect, result.shown, mirror),
            0.5 * shownError(result.shown.indirect, result.shown, mirror));
}

}  // namespace
}  // namespace walr::host
