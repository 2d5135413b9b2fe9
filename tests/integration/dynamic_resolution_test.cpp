// A rectangle of larger images that changes its size and position from frame to frame keeps its histories.
#include <cmath>
#include <limits>
#include <vector>

#include "passes/methods/accumulate.h"
#include "tests/integration/hosted_run.h"
#include "tests/passes/denoiser_run.h"
#include "tests/passes/reference/temporal_accumulation.h"
#include "tests/passes/stage_checks.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/passes/texel_codec.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::dynamic_resolution_test {
namespace {

using reference::forEachPixel;
using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kImage(66, 50);

/// The rectangle that is denoised.
struct Rectangle {
  glm::ivec2 size;
  glm::ivec2 offset;
};

constexpr Rectangle kUsual{{48, 36}, {5, 3}};

/// Dynamic resolution: a few percent larger or smaller, then the whole images, and back. Rounding changes the aspect
/// ratio.
Rectangle changing(std::uint32_t frame) {
  static const std::vector<Rectangle> kSteps{kUsual, {{51, 38}, {0, 0}}, {{46, 35}, {9, 7}}, {{66, 50}, {0, 0}}};
  return kSteps[frame / 2 % kSteps.size()];
}

Rectangle unchanging(std::uint32_t /*frame*/) {
  return kUsual;
}

/// The frames that a host renders into its rectangle.
struct Take {
  Scene scene = flatWall();
  Light light = smoothLight;
  Noise noise = Noise::Exponential;
  glm::dvec3 step{0.0};   ///< The camera's movement per frame.
  bool jittered = false;  ///< Samples are off the pixel centres; motion includes the jitter of both frames.
  bool objectIds = false;
  double roughness = 0.0;  ///< Above 0: the light is specular, and shows what is one unit away from the surface.
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
  const HostFrame rendered =
      renderFrame(take.scene, cameraOf(take, rectangle, frame), rectangle(frame).size, take.light, take.noise);
  return take.roughness > 0.0 ? asSpecular(rendered, 1.0, take.roughness) : rendered;
}

HostedRun::Options optionsOf(const Take& take) {
  HostedRun::Options options;
  options.offset = kUsual.offset;
  options.margin = kImage - kUsual.size;
  options.conventions.motion_jittered = take.jittered ? VK_TRUE : VK_FALSE;
  options.rememberedCamera = true;
  options.objectIds = take.objectIds;
  options.specular = take.roughness > 0.0;
  constexpr VkFormat kFloats = VK_FORMAT_R32G32B32A32_SFLOAT;
  options.formats = {kFloats, VK_FORMAT_R32_SFLOAT, kFloats, kFloats, kFloats};
  return options;
}

void fill(HostedRun& run, const HostFrame& frame, const Rectangle& rectangle) {
  const glm::vec4 nowhere(std::numeric_limits<float>::quiet_NaN());
  const auto hand = [&](const char* name, const Image<glm::dvec3>& image, double alpha = 0.0) {
    std::vector<glm::vec4> texels;
    for (const glm::dvec3& value : image.pixels()) texels.emplace_back(glm::vec3(value), float(alpha));
    run.fill(name, placed(texels, rectangle.size, run.imageSize(), rectangle.offset, nowhere));
  };
  hand("lighting", frame.lighting, frame.conventions.specular ? frame.lightAlpha[{0, 0}] : 0.0);
  if (frame.conventions.specular) {
    constexpr std::uint8_t kMirror = 0;
    run.fill("roughness", placed(encodeRoughness(frame), rectangle.size, run.imageSize(), rectangle.offset, kMirror));
  }
  hand("normal", frame.normal);
  hand("motion", frame.motion);
  hand("albedo", frame.albedo);
  if (frame.objectId.size() == rectangle.size) {
    constexpr std::uint32_t kOther = 0;  // The number of an object in the rectangle.
    run.fill("object_id", placed(frame.objectId.pixels(), rectangle.size, run.imageSize(), rectangle.offset, kOther));
  }
  run.fill("depth", placed(encodeFloats(frame.depth), rectangle.size, run.imageSize(), rectangle.offset, nowhere.x));
}

/// The part of an image inside a rectangle.
Image<glm::dvec4> cut(const std::vector<std::uint16_t>& texels, glm::ivec2 imageSize, const Rectangle& rectangle) {
  const Image<glm::dvec4> image = decodeHalves(texels, imageSize);
  Image<glm::dvec4> result(rectangle.size);
  forEachPixel(rectangle.size, [&](glm::ivec2 p) { result[p] = image[p + rectangle.offset]; });
  return result;
}

/// Denoises the frames of a take one after the other, each in its rectangle.
class Playback {
 public:
  Playback(const fg::test::TestDevice& device, const std::string& method, const Take& take, RectangleOf rectangle)
      : take_(&take), rectangle_(rectangle), run_(device, method.c_str(), kUsual.size, optionsOf(take)) {
    // With the paper's raw moments and untested history these tests would fail.
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

/// From this frame of `changing` on, every second frame has a new size.
constexpr std::uint32_t kFirstChange = 2;

bool changes(std::uint32_t frame) {
  return frame >= kFirstChange && changing(frame).size != changing(frame - 1).size;
}

/// Light is constant and changes in the last frame. This shows the history length of a pixel: with length `n`, the mean
/// covers 1 / (n + 1) of the way from the old value to the new one.
TEST_P(DynamicResolutionMethod, KeepsHistoryLengthAndLight) {
  if (GetParam() == "joint_bilateral")
    GTEST_SKIP() << "it accumulates after its filter, and clips history to the filtered light";
  constexpr std::uint32_t kFrames = 7;
  ASSERT_TRUE(changes(kFrames - 1));
  // Packed light can hold a seventh of the way.
  constexpr double kBefore = 1.0;
  constexpr double kAfter = 1.875;
  // Accumulation, filter, a second accumulation and the result are stored as halves, none of them twice as far from 1.
  constexpr double kRoundoff = 4.0 * 2.0 * reference::kHalfRoundoff;
  // Anti-aliasing clips history to a box around the new value. The box has at least this size, relative to light, so
  // the result may be off by as much. With packed light a third of the result is from this frame and rounded by less
  // than a step, and the box is larger.
  const bool packed = GetParam() == "walr";
  const double leastReach = packed ? 2.0 / 3.0 * 0x1p-6 : 4.0 / 2048.0;
  Take take{.noise = Noise::None};
  Playback playback(device(), GetParam(), take, changing);
  require(walr_set_setting(playback.denoiser(), "accumulation.max-history", "64"));
  if (packed) ignoreChangesOfLight(playback.denoiser());
  Image<glm::dvec4> result;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    take.light = [&](glm::dvec3, glm::dvec3) { return glm::dvec3(i + 1 < kFrames ? kBefore : kAfter); };
    result = playback.next();
    if (i + 1 == kFrames) break;
    forEachPixel(result.size(), [&](glm::ivec2 p) { ASSERT_NEAR(result[p].x, kBefore, kRoundoff) << i; });
  }
  // BMFR averages its fits once more, over five frames.
  const double averaged = GetParam() == "bmfr" ? 5.0 : 1.0;
  const double expected = kBefore + (kAfter - kBefore) / (kFrames * averaged);
  const double roundoff = kRoundoff + (packed ? reference::packedStep(expected, reference::kFilteredBits) : 0.0);
  forEachPixel(result.size(), [&](glm::ivec2 p) {
    ASSERT_NEAR(result[p].x, expected, roundoff + leastReach * expected) << p.x << " " << p.y;
  });
}

/// Errors in the first frames of each size: of a rectangle that changes its size, of one of constant size, and of one
/// that drops its history at each change.
struct ErrorsAtChanges {
  double changing = 0.0;
  double unchanging = 0.0;
  double dropping = 0.0;
};

ErrorsAtChanges errorsAtChanges(const fg::test::TestDevice& device, const std::string& method, const Take& take,
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
    if (!changes(i) || i < 6) continue;  // Not enough history yet.
    const HostFrame expected = render(truth, changing, i);
    errors.changing += surfaceError(changed, expected);
    errors.unchanging += surfaceError(unchanged, render(truth, unchanging, i));
    errors.dropping += surfaceError(dropped, expected);
  }
  return errors;
}

/// The error is clearly closer to that with constant size than to that without history.
void expectHistoryIsKept(const ErrorsAtChanges& errors) {
  EXPECT_LT(errors.changing, errors.unchanging + 0.25 * (errors.dropping - errors.unchanging));
  EXPECT_GT(errors.dropping, 1.25 * errors.unchanging) << "there was no history to lose";
}

TEST_P(DynamicResolutionMethod, ErrorEqualsThatOfARectangleOfConstantSize) {
  const Take take{.scene = sphere(), .step = {0.05, 0.03, -0.04}, .jittered = true};
  expectHistoryIsKept(errorsAtChanges(device(), GetParam(), take));
}

// Of a lobe whose history moves with the mirror image, and of one whose history moves with the surface.
TEST_F(DynamicResolution, ErrorOfSpecularLightEqualsThatOfARectangleOfConstantSize) {
  for (const double roughness : {0.2, 0.8}) {
    for (const char* method : {"walr", "svgf", "accumulate"}) {
      SCOPED_TRACE(std::string(method) + ", roughness " + std::to_string(roughness));
      const Take take{.scene = sphere(), .step = {0.05, 0.03, -0.04}, .jittered = true, .roughness = roughness};
      expectHistoryIsKept(errorsAtChanges(device(), method, take));
    }
  }
}

/// A scene of small objects with different ids, a third of a unit wide. A history that is read at a wrong position
/// belongs to another id and is rejected.
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

TEST_F(DynamicResolution, ReadsObjectIdsAtTheRightPosition) {
  const Take take{.scene = inPieces(sphere()), .step = {0.05, 0.03, -0.04}, .objectIds = true};
  for (const char* method : {"joint_bilateral", "walr"}) {
    SCOPED_TRACE(method);
    expectHistoryIsKept(errorsAtChanges(device(), method, take, kObjectIds));
  }
}

// A panel slides within a wall, and only object ids tell them apart. They are read from the rectangle; its surroundings
// have the ids of other objects.
TEST_F(DynamicResolution, ObjectIdsOfARectangleEqualThoseOfASeparateImage) {
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

/// The camera moves along a wall whose light is linear in position. Interpolation is exact, and an error in the
/// position of a read shows as a proportional error in the light.
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

/// Reach in pixels of the widest window, that of `joint_bilateral`.
constexpr int kReach = 17;

/// Keep the windows of spatial filters within `kReach` and independent of history. The windows of `flr` depend on the
/// deviation.
void boundWindows(const Playback& playback, const std::string& method) {
  if (method == "flr") require(walr_set_setting(playback.denoiser(), "regression.sigma", "2"));
}

TEST_P(DynamicResolutionMethod, ReadsTheHistoryAtTheRightPosition) {
  if (GetParam() == "walr") GTEST_SKIP() << "its windows grow with noise and history; walr_paper's do not";
  if (GetParam() == "flnr") GTEST_SKIP() << "its network sees the length of the history; flr does not";
  constexpr std::uint32_t kFrames = 11;
  const Take take = slidingAlongLinearLight();
  Playback playback(device(), GetParam(), take, changing);
  // Compare with a result without history, because a spatial filter has its own error at borders, which depends on
  // size.
  Playback alone(device(), GetParam(), take, changing);
  for (Playback* each : {&playback, &alone}) boundWindows(*each, GetParam());
  // Values below 4 round by 2^-10 when they are stored as halves: once in each of four stages. The mean rounds once per
  // frame and keeps a part of its earlier rounding errors.
  constexpr double kRoundoff = (4.0 + (kFrames + 1.0) / 2.0) * 0x1p-10;
  double worst = 0.0;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    const Image<glm::dvec4> result = playback.next();
    worst = std::max(worst, differenceInside(result, alone.next(WALR_FRAME_RESET_HISTORY), kReach));
  }
  EXPECT_LE(worst, kRoundoff);
  // The image's height covers 5 units of the wall. This is the change of light per pixel at the highest resolution; the
  // tolerance is below a fifth of it.
  constexpr double kPixel = 0.5 * 5.0 / 48.0;
  static_assert(kRoundoff < 0.2 * kPixel);
}

// In a still scene, the only displacement between frames is that of the change in size.
TEST_F(DynamicResolution, ReadsTheHistoryOfAStillSceneAtTheRightPosition) {
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
      // As above, with fewer frames.
      EXPECT_LE(differenceInside(playback.next(), truth, kReach), 8.0 * 0x1p-10) << method << ", " << i;
    }
  }
}

/// Messages that the linter has logged.
void keepWarning(void* user, WalrLogLevel level, const char* text) {
  if (level == WALR_LOG_WARNING) static_cast<std::vector<std::string>*>(user)->emplace_back(text);
}

TEST_F(DynamicResolution, TheLinterKeepsItsFindings) {
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

/// Variants of reprojection.
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

/// Compares temporal accumulation with the double-precision reference, with changing sizes and a camera that moves and
/// jitters. The reference of each frame starts from the device's history, so that errors do not accumulate.
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

/// The bits of the last of several frames, between which a host makes some change.
template <typename Between>
std::vector<std::uint16_t> lastOf(const fg::test::TestDevice& device, const Take& take, std::uint32_t framesInFlight,
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
  // Prepared sizes; sizes that no frame uses; sizes that are prepared but that no frame uses.
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

TEST_F(DynamicResolution, ResetDropsTheHistoryAtANewSizeAndNewSettingsKeepIt) {
  const Take take{.scene = sphere(), .step = {0.05, 0.03, -0.04}};
  constexpr std::uint32_t kCut = 6;
  ASSERT_TRUE(changes(kCut));
  // A method that does not depend on the frame number, which differs between the two runs.
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
}  // namespace walr::test::dynamic_resolution_test
