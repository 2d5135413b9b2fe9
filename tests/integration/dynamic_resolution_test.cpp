// A rectangle of larger images that changes its size and its place from frame to frame: histories go on.
#include <cmath>
#include <limits>
#include <vector>

#include "passes/accumulate.h"
#include "tests/integration/hosted_run.h"
#include "tests/passes/denoiser_run.h"
#include "tests/passes/reference/temporal_accumulation.h"
#include "tests/passes/stage_checks.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/passes/texel_codec.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test {
namespace {

using reference::forEachPixel;
using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kImage(64, 48);

/// What is denoised of the images.
struct Rectangle {
  glm::ivec2 size;
  glm::ivec2 offset;
};

constexpr Rectangle kUsual{{48, 36}, {5, 3}};

/// Dynamic resolution: a few percent up or down, to all of the images, and back; the aspect ratio changes by rounding.
Rectangle changing(std::uint32_t frame) {
  static const std::vector<Rectangle> kSteps{kUsual, {{51, 38}, {0, 0}}, {{46, 35}, {9, 7}}, {{64, 48}, {0, 0}}};
  return kSteps[frame / 2 % kSteps.size()];
}

Rectangle unchanging(std::uint32_t /*frame*/) {
  return kUsual;
}

/// What a host renders into its rectangle.
struct Take {
  Scene scene = flatWall();
  Light light = smoothLight;
  Noise noise = Noise::Exponential;
  glm::dvec3 step{0.0};   ///< By which the camera moves each frame.
  bool jittered = false;  ///< Pixels are sampled off their centres, and motion is between the jittered pictures.
  bool objectIds = false;
};

using RectangleOf = Rectangle (*)(std::uint32_t frame);

FrameDescription cameraOf(const Take& take, RectangleOf rectangle, std::uint32_t frame) {
  const std::uint32_t before = frame > 0 ? frame - 1 : 0;
  const glm::ivec2 size = rectangle(frame).size;
  const glm::ivec2 previousSize = rectangle(before).size;
  FrameDescription camera = cameraAt(double(frame) * take.step, double(before) * take.step, size, frame);
  camera.previousProjection = cameraAt({}, {}, previousSize, before).projection;
  camera.previousExtent = {static_cast<std::uint32_t>(previousSize.x), static_cast<std::uint32_t>(previousSize.y)};
  const auto jitterOf = [&](std::uint32_t n) {
    return take.jittered ? glm::vec2(n % 2 == 0 ? 0.25F : -0.375F, n % 3 == 0 ? -0.3125F : 0.125F) : glm::vec2(0.0F);
  };
  camera.jitter = jitterOf(frame);
  camera.previousJitter = jitterOf(before);
  return camera;
}

HostFrame render(const Take& take, RectangleOf rectangle, std::uint32_t frame) {
  return renderFrame(take.scene, cameraOf(take, rectangle, frame), rectangle(frame).size, take.light, take.noise);
}

HostedRun::Options optionsOf(const Take& take) {
  HostedRun::Options options;
  options.offset = kUsual.offset;
  options.margin = kImage - kUsual.size;
  options.conventions.motion_jittered = take.jittered ? VK_TRUE : VK_FALSE;
  options.rememberedCamera = true;
  options.objectIds = take.objectIds;
  constexpr VkFormat kFloats = VK_FORMAT_R32G32B32A32_SFLOAT;
  options.formats = {kFloats, VK_FORMAT_R32_SFLOAT, kFloats, kFloats, kFloats};
  return options;
}

void fill(HostedRun& run, const HostFrame& frame, const Rectangle& rectangle) {
  const glm::vec4 nowhere(std::numeric_limits<float>::quiet_NaN());
  const auto hand = [&](const char* name, const Image<glm::dvec3>& image) {
    std::vector<glm::vec4> texels;
    for (const glm::dvec3& value : image.pixels()) texels.emplace_back(glm::vec3(value), 0.0F);
    run.fill(name, placed(texels, rectangle.size, run.imageSize(), rectangle.offset, nowhere));
  };
  hand("lighting", frame.lighting);
  hand("normal", frame.normal);
  hand("motion", frame.motion);
  hand("albedo", frame.albedo);
  if (frame.objectId.size() == rectangle.size) {
    constexpr std::uint32_t kOther = 0;  // The number of an object in the rectangle.
    run.fill("object_id", placed(frame.objectId.pixels(), rectangle.size, run.imageSize(), rectangle.offset, kOther));
  }
  run.fill("depth", placed(encodeFloats(frame.depth), rectangle.size, run.imageSize(), rectangle.offset, nowhere.x));
}

/// The rectangle's part of an image.
Image<glm::dvec4> cut(const std::vector<std::uint16_t>& texels, glm::ivec2 imageSize, const Rectangle& rectangle) {
  const Image<glm::dvec4> image = decodeHalves(texels, imageSize);
  Image<glm::dvec4> result(rectangle.size);
  forEachPixel(rectangle.size, [&](glm::ivec2 p) { result[p] = image[p + rectangle.offset]; });
  return result;
}

/// Denoises a take's frames in turn, in rectangles as they come.
class Playback {
 public:
  Playback(const fg::vk::Device& device, const std::string& method, const Take& take, RectangleOf rectangle)
      : take_(&take), rectangle_(rectangle), run_(device, method.c_str(), kUsual.size, optionsOf(take)) {
    // The paper's raw moments and its history without tests do not keep the promises made here.
    if (method == "walr_paper") require(walr_use_preset(denoiser(), "robust"));
  }

  [[nodiscard]] WalrDenoiser denoiser() const { return run_.denoiser(); }
  Image<glm::dvec4> next(std::uint32_t flags = 0) { return next(render(*take_, rectangle_, frame_), flags); }
  Image<glm::dvec4> next(const HostFrame& frame, std::uint32_t flags = 0) {
    const Rectangle rectangle = rectangle_(frame_);
    run_.moveRectangle(rectangle.size, rectangle.offset);
    fill(run_, frame, rectangle);
    return cut(run_.frame(cameraOf(*take_, rectangle_, frame_++), flags), kImage, rectangle);
  }

 private:
  const Take* take_;
  RectangleOf rectangle_;
  HostedRun run_;
  std::uint32_t frame_ = 0;
};

std::vector<std::string> methodsWithHistory() {
  std::vector<std::string> methods = denoiserNames();
  std::erase(methods, "none");
  return methods;
}

class DynamicResolution : public fg::test::GpuTest {};
class DynamicResolutionMethod : public DynamicResolution, public testing::WithParamInterface<std::string> {};
INSTANTIATE_TEST_SUITE_P(Methods, DynamicResolutionMethod, testing::ValuesIn(methodsWithHistory()));

/// Frames of `changing` from which on every other one is the first of its size.
constexpr std::uint32_t kFirstChange = 2;

bool changes(std::uint32_t frame) {
  return frame >= kFirstChange && changing(frame).size != changing(frame - 1).size;
}

/// Constant light that changes in the last frame tells how many samples are behind a pixel: with `n` before, the mean
/// has come from 1 by 1 / (n + 1) of the way to the new value.
TEST_P(DynamicResolutionMethod, NoSampleIsLostAndNoLight) {
  if (GetParam() == "joint_bilateral") GTEST_SKIP() << "it accumulates behind its filter, and clips history to that";
  constexpr std::uint32_t kFrames = 7;
  ASSERT_TRUE(changes(kFrames - 1));
  // A seventh of the way is what packed light can hold.
  constexpr double kBefore = 1.0;
  constexpr double kAfter = 1.875;
  // Accumulation, filter, a second accumulation and the result are stored as halves, none of them twice as far from 1.
  constexpr double kRoundoff = 4.0 * 2.0 * reference::kHalfRoundoff;
  // Anti-aliasing clips what differs by less than this, relative to light, into its least box. Of packed light the
  // result is a third this frame's, whose blocks leave it rounded by less than a step, and the box is larger.
  const bool packed = GetParam() == "walr";
  const double leastReach = packed ? 2.0 / 3.0 * 0x1p-6 : 4.0 / 2048.0;
  Take take{.noise = Noise::None};
  Playback playback(device(), GetParam(), take, changing);
  require(walr_set_setting(playback.denoiser(), "accumulation.max-history", "64"));
  Image<glm::dvec4> result;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    take.light = [&](glm::dvec3, glm::dvec3) { return glm::dvec3(i + 1 < kFrames ? kBefore : kAfter); };
    result = playback.next();
    if (i + 1 == kFrames) break;
    forEachPixel(result.size(), [&](glm::ivec2 p) { ASSERT_NEAR(result[p].x, kBefore, kRoundoff) << i; });
  }
  // BMFR averages its fits once more, five of them.
  const double averaged = GetParam() == "bmfr" ? 5.0 : 1.0;
  const double expected = kBefore + (kAfter - kBefore) / (kFrames * averaged);
  const double roundoff = kRoundoff + (packed ? reference::packedStep(expected, reference::kFilteredBits) : 0.0);
  forEachPixel(result.size(), [&](glm::ivec2 p) {
    ASSERT_NEAR(result[p].x, expected, roundoff + leastReach * expected) << p.x << " " << p.y;
  });
}

/// Errors in the first frames of a size, of a rectangle that changes it, one that never does, and one that drops its
/// history when it does.
struct ErrorsAtChanges {
  double changing = 0.0;
  double unchanging = 0.0;
  double dropping = 0.0;
};

ErrorsAtChanges errorsAtChanges(const fg::vk::Device& device, const std::string& method, const Take& take,
                                const char* switchedOn = nullptr) {
  constexpr std::uint32_t kFrames = 13;
  Playback change(device, method, take, changing);
  Playback same(device, method, take, unchanging);
  Playback drop(device, method, take, changing);
  for (Playback* each : {&change, &same, &drop}) {
    if (switchedOn != nullptr) require(walr_set_setting(each->denoiser(), switchedOn, "on"));
  }
  Take truth = take;
  truth.noise = Noise::None;
  ErrorsAtChanges errors;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    const Image<glm::dvec4> changed = change.next();
    const Image<glm::dvec4> unchanged = same.next();
    const Image<glm::dvec4> dropped = drop.next(changes(i) ? WALR_FRAME_RESET_HISTORY : 0);
    if (!changes(i) || i < 6) continue;  // Until some history is there to be lost.
    const HostFrame expected = render(truth, changing, i);
    errors.changing += surfaceError(changed, expected);
    errors.unchanging += surfaceError(unchanged, render(truth, unchanging, i));
    errors.dropping += surfaceError(dropped, expected);
  }
  return errors;
}

/// Clearly nearer to the one than to the other.
void expectHistoryGoesOn(const ErrorsAtChanges& errors) {
  EXPECT_LT(errors.changing, errors.unchanging + 0.25 * (errors.dropping - errors.unchanging));
  EXPECT_GT(errors.dropping, 1.25 * errors.unchanging) << "nothing was there to be lost";
}

TEST_P(DynamicResolutionMethod, ErrorIsThatOfARectangleThatNeverChanges) {
  const Take take{.scene = sphere(), .step = {0.05, 0.03, -0.04}, .jittered = true};
  expectHistoryGoesOn(errorsAtChanges(device(), GetParam(), take));
}

/// A scene in pieces with numbers of their own, a third of a unit across: a history that is not read in its place shows
/// another number, and is lost.
Scene inPieces(const Scene& scene) {
  return [scene](glm::dvec3 origin, glm::dvec3 direction) {
    std::optional<SceneHit> hit = scene(origin, direction);
    if (hit) {
      const glm::ivec3 piece(glm::floor(3.0 * (origin + hit->distance * direction)));
      hit->object = static_cast<std::uint32_t>(piece.x + 64 * piece.y + 4096 * piece.z) & 0xffffffU;
    }
    return hit;
  };
}

constexpr const char* kObjectIds = "antialiasing.object-ids";

TEST_F(DynamicResolution, TellsObjectsApartInTheirPlace) {
  const Take take{.scene = inPieces(sphere()), .step = {0.05, 0.03, -0.04}, .objectIds = true};
  for (const char* method : {"joint_bilateral", "walr"}) {
    SCOPED_TRACE(method);
    expectHistoryGoesOn(errorsAtChanges(device(), method, take, kObjectIds));
  }
}

// Only the numbers tell the panel from the wall that it slides in: they are read from the rectangle, and what is around
// it has those of other objects.
TEST_F(DynamicResolution, ARectanglesObjectsAreThoseOfAPictureOfItsOwn) {
  constexpr std::uint32_t kFrames = 5;
  Take take{.objectIds = true};
  for (const char* method : {"joint_bilateral", "walr"}) {
    const auto lastPicture = [&](bool rectangle, const char* tellApart) {
      HostedRun::Options options = optionsOf(take);
      if (!rectangle) options.offset = options.margin = glm::ivec2(0);
      const Rectangle at{kUsual.size, options.offset};
      HostedRun run(device(), method, kUsual.size, options);
      require(walr_set_setting(run.denoiser(), kObjectIds, tellApart));
      std::vector<glm::dvec4> last;
      for (std::uint32_t i = 0; i < kFrames; ++i) {
        take.scene = slidingPanel(i);
        fill(run, render(take, unchanging, i), at);
        last = cut(run.frame(cameraOf(take, unchanging, i)), run.imageSize(), at).pixels();
      }
      return last;
    };
    EXPECT_EQ(lastPicture(true, "on"), lastPicture(false, "on")) << method;
    EXPECT_NE(lastPicture(true, "on"), lastPicture(true, "off")) << method;
  }
}

/// A wall that the camera slides along, with light that is linear on it: interpolation takes nothing away, and what is
/// read beside the right place shows by how much.
Take slidingAlongLinearLight() {
  Take take{.noise = Noise::None, .step = {0.031, 0.017, 0.0}};
  take.scene = [](glm::dvec3 origin, glm::dvec3 direction) -> std::optional<SceneHit> {
    return SceneHit{.distance = (origin.z + 5.0) / -direction.z, .shadingNormal = {0.0, 0.0, 1.0}};
  };
  take.light = [](glm::dvec3 p, glm::dvec3) { return glm::dvec3(2.0 + 0.5 * p.x, 2.0 + 0.5 * p.y, 2.0); };
  return take;
}

/// Largest difference of red and green away from the borders.
double differenceInside(const Image<glm::dvec4>& a, const Image<glm::dvec4>& b, int border) {
  double worst = 0.0;
  forEachPixel(a.size(), [&](glm::ivec2 p) {
    for (int axis = 0; axis < 2; ++axis) {
      if (p[axis] < border || p[axis] >= a.size()[axis] - border) return;
    }
    for (int c = 0; c < 2; ++c) worst = std::max(worst, std::abs(a[p][c] - b[p][c]));
  });
  return worst;
}

/// Of the widest window, that of `joint_bilateral`.
constexpr int kReach = 17;

/// Keep the windows of spatial filters within `kReach`, and the same whatever the past: those of `flr` go by their
/// deviation.
void boundWindows(const Playback& playback, const std::string& method) {
  if (method == "flr") require(walr_set_setting(playback.denoiser(), "regression.sigma", "2"));
}

TEST_P(DynamicResolutionMethod, ReadsThePastInItsPlace) {
  if (GetParam() == "walr") GTEST_SKIP() << "its windows grow with noise and history; walr_paper's do not";
  constexpr std::uint32_t kFrames = 11;
  const Take take = slidingAlongLinearLight();
  Playback playback(device(), GetParam(), take, changing);
  // The same with no past: a spatial filter's own error at the borders, which size has a part in, is no matter here.
  Playback alone(device(), GetParam(), take, changing);
  for (Playback* each : {&playback, &alone}) boundWindows(*each, GetParam());
  // Values below 4 round by 2^-10 when they are stored as halves: once in each of four stages, and the mean, which
  // keeps the n-th part of what it erred by, once a frame.
  constexpr double kRoundoff = (4.0 + (kFrames + 1.0) / 2.0) * 0x1p-10;
  double worst = 0.0;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    const Image<glm::dvec4> result = playback.next();
    worst = std::max(worst, differenceInside(result, alone.next(WALR_FRAME_RESET_HISTORY), kReach));
  }
  EXPECT_LE(worst, kRoundoff);
  // The finest picture's pixels differ by 5 units of the wall over its height; that is a fifth of one.
  constexpr double kPixel = 0.5 * 5.0 / 48.0;
  static_assert(kRoundoff < 0.2 * kPixel);
}

// Nothing has to be looked for where nothing ever moves, but for the place of the same pixel at another size.
TEST_F(DynamicResolution, WhatStandsStillIsReadInItsPlace) {
  Take take = slidingAlongLinearLight();
  take.step = glm::dvec3(0.0);
  for (const char* method : {"accumulate", "walr_paper"}) {
    Playback playback(device(), method, take, changing);
    boundWindows(playback, method);
    for (const char* setting : {"scene.camera-motion", "scene.object-motion", "scene.jitter"}) {
      require(walr_set_setting(playback.denoiser(), setting, "off"));
    }
    for (std::uint32_t i = 0; i < 7; ++i) {
      Image<glm::dvec4> truth(changing(i).size);
      const HostFrame frame = render(take, changing, i);
      forEachPixel(truth.size(), [&](glm::ivec2 p) { truth[p] = glm::dvec4(frame.lighting[p], 1.0); });
      // As above, of fewer frames.
      EXPECT_LE(differenceInside(playback.next(), truth, kReach), 8.0 * 0x1p-10) << method << ", " << i;
    }
  }
}

/// What the linter has logged.
void keepWarning(void* user, WalrLogLevel level, const char* text) {
  if (level == WALR_LOG_WARNING) static_cast<std::vector<std::string>*>(user)->emplace_back(text);
}

TEST_F(DynamicResolution, TheLinterGoesOnWithWhatItHasSeen) {
  const Take take{.scene = sphere(), .step = {0.09, 0.03, -0.04}};
  for (const bool good : {true, false}) {
    std::vector<std::string> log;
    HostedRun::Options options = optionsOf(take);
    options.lint = true;
    options.conventions.motion_scale[0] = good ? 1.0F : -1.0F;
    options.log = keepWarning;
    options.logUser = &log;
    HostedRun run(device(), "walr", kUsual.size, options);
    for (std::uint32_t i = 0; i < 10; ++i) {
      run.moveRectangle(changing(i).size, changing(i).offset);
      fill(run, render(take, changing, i), changing(i));
      run.frame(cameraOf(take, changing, i));
    }
    EXPECT_EQ(log.size(), good ? 0U : 1U) << (log.empty() ? "" : log.back());
    std::uint32_t count = 0;
    require(walr_get_findings(run.denoiser(), &count, nullptr));
    EXPECT_EQ(count, log.size());
  }
}

/// How history is looked for.
struct Search {
  HistoryRejection rejection;
  HistoryFilter filter;
  bool objectsMove;
};

const char* nameOf(HistoryRejection rejection) {
  if (rejection == HistoryRejection::None) return "none";
  return rejection == HistoryRejection::Plane ? "plane" : "depth";
}
const char* nameOf(HistoryFilter filter) {
  return filter == HistoryFilter::Bilinear ? "bilinear" : "bicubic";
}

/// Temporal accumulation against the double-precision reference, through changes of size of a camera that moves and
/// jitters. Each frame's reference goes on from what the device left, so that errors do not add up.
TEST_F(DynamicResolution, AccumulatesAsTheDoublePrecisionReferenceDoes) {
  constexpr std::uint32_t kFrames = 9;
  for (const Search& search : {Search{HistoryRejection::Plane, HistoryFilter::Bilinear, true},
                               Search{HistoryRejection::Plane, HistoryFilter::Bicubic, false},
                               Search{HistoryRejection::Depth, HistoryFilter::Bilinear, false},
                               Search{HistoryRejection::None, HistoryFilter::Bilinear, true}}) {
    SCOPED_TRACE(std::string(nameOf(search.rejection)) + ", " + nameOf(search.filter) +
                 (search.objectsMove ? "" : ", from the camera"));
    const Take take{.scene = sphere(), .step = {0.05, 0.03, -0.04}, .jittered = true};
    Playback playback(device(), "accumulate", take, changing);
    AccumulateSettings settings;
    settings.accumulation.rejection = search.rejection;
    settings.accumulation.historyFilter = search.filter;
    const auto set = [&](const char* name, const char* value) {
      require(walr_set_setting(playback.denoiser(), name, value));
    };
    set("accumulation.rejection", nameOf(search.rejection));
    set("accumulation.history-filter", nameOf(search.filter));
    set("scene.object-motion", search.objectsMove ? "on" : "off");
    reference::AccumulationHistory history;
    int undecided = 0;
    int pixels = 0;
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      HostFrame frame = render(take, changing, i);
      frame.scene.objectMotion = search.objectsMove;
      const Image<glm::dvec4> result = playback.next(frame);
      const auto guides = prepareGuides(frame, reference::Storage::Quantised, settings.guides);
      const auto expected = accumulate(frame, guides, history, reference::Storage::Quantised, settings.accumulation);
      history = {.guides = guides, .accumulated = Image<glm::dvec4>(frame.size())};
      forEachPixel(frame.size(), [&](glm::ivec2 p) {
        const reference::Accumulated& pixel = expected[p];
        history.accumulated[p] = glm::dvec4(glm::dvec3(result[p]), pixel.samples);
        ++pixels;
        if (pixel.undecided) ++undecided;
        for (int c = 0; c < 3 && !pixel.undecided; ++c) {
          const double rounding = reference::kHalfRoundoff * std::abs(pixel.mean[c]) + 0x1p-25;
          ASSERT_NEAR(result[p][c], pixel.mean[c], pixel.error[c] + 2.0 * rounding)
              << i << ": " << p.x << " " << p.y << ", " << pixel.samples << " samples";
        }
      });
    }
    EXPECT_LT(undecided, kUndecidedShare * pixels);
  }
}

/// Bits of the last of some frames, between which a host does something.
template <typename Between>
std::vector<std::uint16_t> lastOf(const fg::vk::Device& device, const Take& take, std::uint32_t framesInFlight,
                                  std::uint32_t frames, bool wait, Between between) {
  HostedRun::Options options = optionsOf(take);
  options.framesInFlight = framesInFlight;
  HostedRun run(device, "walr", kUsual.size, options);
  for (std::uint32_t i = 0;; ++i) {
    // A new size in every frame.
    const RectangleOf rectangle = [](std::uint32_t frame) { return changing(2 * frame); };
    run.moveRectangle(rectangle(i).size, rectangle(i).offset);
    between(run, i);
    fill(run, render(take, rectangle, i), rectangle(i));
    const FrameDescription camera = cameraOf(take, rectangle, i);
    if (i + 1 == frames) return run.frame(camera);
    if (wait) {
      run.frame(camera);
    } else {
      run.submit(camera);
    }
  }
}

TEST_F(DynamicResolution, FramesInFlightKeepWhatTheyRead) {
  const Take take{.scene = sphere(), .step = {0.05, 0.03, -0.04}};
  constexpr std::uint32_t kFrames = 7;
  const auto nothing = [](HostedRun&, std::uint32_t) {};
  const std::vector<std::uint16_t> expected = lastOf(device(), take, 2, kFrames, true, nothing);
  for (const std::uint32_t framesInFlight : {1U, 2U, 3U}) {
    EXPECT_EQ(lastOf(device(), take, framesInFlight, kFrames, false, nothing), expected) << framesInFlight;
  }
  // Made ahead of time; sizes that no frame has; sizes for which something was made, and no frame.
  const auto prepared = [](HostedRun& run, std::uint32_t) { require(walr_prepare(run.denoiser())); };
  EXPECT_EQ(lastOf(device(), take, 2, kFrames, false, prepared), expected);
  const auto detour = [](HostedRun& run, std::uint32_t i) {
    const Rectangle now = changing(2 * i);
    run.moveRectangle({40, 30}, {0, 0});
    if (i % 2 == 0) require(walr_prepare(run.denoiser()));
    run.moveRectangle(now.size, now.offset);
  };
  EXPECT_EQ(lastOf(device(), take, 2, kFrames, false, detour), expected);
}

TEST_F(DynamicResolution, ACutForgetsThePastAtANewSizeAndNewSettingsDoNot) {
  const Take take{.scene = sphere(), .step = {0.05, 0.03, -0.04}};
  constexpr std::uint32_t kCut = 6;
  ASSERT_TRUE(changes(kCut));
  // A method that no frame's number has a part in, as the two have different ones.
  const auto lastAfter = [&](bool past, std::uint32_t flags, const char* setting) {
    HostedRun run(device(), "accumulate", kUsual.size, optionsOf(take));
    Image<glm::dvec4> last;
    for (std::uint32_t i = past ? 0 : kCut; i <= kCut; ++i) {
      run.moveRectangle(changing(i).size, changing(i).offset);
      if (i == kCut && setting != nullptr) require(walr_set_setting(run.denoiser(), setting, "7"));  // Of 7 frames.
      fill(run, render(take, changing, i), changing(i));
      last = cut(run.frame(cameraOf(take, changing, i), i == kCut ? flags : 0), kImage, changing(i));
    }
    return last.pixels();
  };
  constexpr const char* kSetting = "accumulation.max-history";
  EXPECT_NE(lastAfter(true, 0, nullptr), lastAfter(false, 0, nullptr));
  EXPECT_EQ(lastAfter(true, WALR_FRAME_RESET_HISTORY, nullptr), lastAfter(false, 0, nullptr));
  EXPECT_EQ(lastAfter(true, 0, kSetting), lastAfter(true, 0, nullptr));
}

}  // namespace
}  // namespace walr::test
